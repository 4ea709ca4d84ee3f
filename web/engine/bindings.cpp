/// The engine as the page's workers see it: jobs as objects, results as numbers in this module's memory or as JSON.
///
/// Every function that may fail gives {"error": ..} in place of its result; exceptions do not leave the module.
#include <emscripten/bind.h>

#include <memory>

#include "analysis.hpp"
#include "bits/report.hpp"
#include "branch_study.hpp"
#include "card.hpp"
#include "chart_job.hpp"
#include "diagram_job.hpp"
#include "motion_job.hpp"
#include "section_job.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::web {
namespace {

using emscripten::typed_memory_view;
using emscripten::val;

/// The page's {source, set, start}.
Choice choice_of(const val& model) {
  Overrides set;
  const val given = model["set"];
  for (const auto& name : emscripten::vecFromJSArray<std::string>(val::global("Object").call<val>("keys", given)))
    set[name] = given[name].as<double>();
  return Choice::of(model["source"].as<std::string>(), std::move(set),
                    emscripten::convertJSArrayToNumberVector<double>(model["start"]));
}

Json error_of(const char* kind, const std::string& place, const std::string& message) {
  Json error = Json::object();
  error.set("kind", kind).set("place", place).set("message", message);
  return Json::object().set("error", std::move(error));
}

/// The text of make()'s object, or of the error that it ends with.
template <class Make>
std::string attempt(const Make& make) {
  try {
    return make().dump(-1);
  } catch (const InputError& error) {
    return error_of("input", error.place(), error.message()).dump(-1);
  } catch (const NumericalError& error) {
    return error_of("numerics", "", error.what()).dump(-1);
  } catch (const StorageError& error) {
    return error_of("input", "", error.what()).dump(-1);
  } catch (const std::exception& error) {
    return error_of("bug", "", error.what()).dump(-1);
  }
}

/// The engine's one running job.
class Session {
 public:
  std::string card(val model) {
    return attempt([&] { return card_of(choice_of(model)); });
  }
  std::string models() {
    return attempt([] { return list_of_models(); });
  }
  std::string blank(const std::string& name) {
    return attempt([&] { return Json::object().set("text", new_model(name)); });
  }
  std::string classify(val model, int periods) {
    return attempt([&] { return classify_motion(choice_of(model), periods); });
  }
  std::string spectrum(val model, const std::string& quantity, double highest_order) {
    return attempt([&] { return spectrum_of(choice_of(model), quantity, highest_order); });
  }
  std::string branch(val model, val wish) {
    return attempt([&] {
      study_.reset();
      const BranchWish how{.parameter = wish["parameter"].as<std::string>(),
                           .from = wish["from"].as<double>(),
                           .to = wish["to"].as<double>(),
                           .shown = wish["shown"].as<std::string>(),
                           .at = wish["at"].as<std::string>()};
      study_ = std::make_unique<BranchStudy>(choice_of(model), how, [](long points) {
        val::global("globalThis").call<void>("followed", static_cast<int>(points));
      });
      return study_->branches(0);
    });
  }
  std::string born(int branch, int special) {
    return attempt(
        [&] { return study().follow_born(static_cast<std::size_t>(branch), static_cast<std::size_t>(special)); });
  }
  std::string curve(int branch, int special, val wish) {
    return attempt([&] {
      return study().curve(static_cast<std::size_t>(branch), static_cast<std::size_t>(special),
                           {.second = wish["second"].as<std::string>(),
                            .from = wish["from"].as<double>(),
                            .to = wish["to"].as<double>(),
                            .second_from = wish["secondFrom"].as<double>(),
                            .second_to = wish["secondTo"].as<double>()});
    });
  }
  std::string bits() {
    return attempt([] {
      Json lines = Json::list();
      for (const std::string& line : report_of_bits()) lines.push(line);
      return Json::object().set("lines", std::move(lines));
    });
  }

  std::string begin_motion(val model, val wish) {
    return begin<MotionJob>(model, MotionWish{.transient = wish["transient"].as<int>(),
                                              .periods = wish["periods"].as<int>(),
                                              .samples = wish["samples"].as<int>(),
                                              .of = wish["of"].as<std::string>()});
  }
  std::string begin_diagram(val model, val wish) {
    return begin<DiagramJob>(model, DiagramWish{.parameter = wish["parameter"].as<std::string>(),
                                                .from = wish["from"].as<double>(),
                                                .to = wish["to"].as<double>(),
                                                .count = wish["count"].as<int>(),
                                                .transient = wish["transient"].as<int>(),
                                                .points = wish["points"].as<int>(),
                                                .down = wish["down"].as<bool>(),
                                                .shown = wish["shown"].as<std::string>(),
                                                .at = wish["at"].as<std::string>()});
  }
  std::string begin_section(val model, val wish) {
    return begin<SectionJob>(model, SectionWish{.at = wish["at"].as<std::string>(),
                                                .transient = wish["transient"].as<int>(),
                                                .points = wish["points"].as<int>(),
                                                .phase = wish["phase"].as<double>()});
  }
  std::string begin_chart(val model, val wish) {
    return begin<ChartJob>(model, ChartWish{.x = wish["x"].as<std::string>(),
                                            .y = wish["y"].as<std::string>(),
                                            .x_from = wish["xFrom"].as<double>(),
                                            .x_to = wish["xTo"].as<double>(),
                                            .y_from = wish["yFrom"].as<double>(),
                                            .y_to = wish["yTo"].as<double>(),
                                            .columns = wish["columns"].as<int>(),
                                            .rows = wish["rows"].as<int>(),
                                            .pixels = emscripten::convertJSArrayToNumberVector<int>(wish["pixels"]),
                                            .periods = wish["periods"].as<int>()});
  }

  bool advance(double milliseconds) { return job_ == nullptr || job_->advance(milliseconds); }
  val rows() { return view(job_->rows()); }
  val events() { return view(job_->events()); }
  int width() const { return job_->width(); }
  int event_width() const { return job_->event_width(); }
  std::string failure() const {
    const auto* const diagram = dynamic_cast<const DiagramJob*>(job_.get());
    return diagram != nullptr && job_->failure().empty() ? diagram->note() : job_->failure();
  }
  void go_on() {
    if (auto* const motion = dynamic_cast<MotionJob*>(job_.get())) motion->go_on();
  }

 private:
  template <class Any, class Wish>
  std::string begin(const val& model, const Wish& wish) {
    return attempt([&] {
      job_.reset();
      job_ = std::make_unique<Any>(choice_of(model), wish);
      return Json::object();
    });
  }
  static val view(const std::vector<double>& numbers) { return val(typed_memory_view(numbers.size(), numbers.data())); }

  BranchStudy& study() {
    if (study_ == nullptr) throw InputError("there is no branch: follow one first");
    return *study_;
  }

  std::unique_ptr<Job> job_;
  std::unique_ptr<BranchStudy> study_;  ///< of the last branch that was asked for
};

}  // namespace

EMSCRIPTEN_BINDINGS(slapstick) {
  emscripten::class_<Session>("Session")
      .constructor<>()
      .function("card", &Session::card)
      .function("models", &Session::models)
      .function("blank", &Session::blank)
      .function("classify", &Session::classify)
      .function("spectrum", &Session::spectrum)
      .function("branch", &Session::branch)
      .function("born", &Session::born)
      .function("curve", &Session::curve)
      .function("bits", &Session::bits)
      .function("beginMotion", &Session::begin_motion)
      .function("beginDiagram", &Session::begin_diagram)
      .function("beginSection", &Session::begin_section)
      .function("beginChart", &Session::begin_chart)
      .function("advance", &Session::advance)
      .function("rows", &Session::rows)
      .function("events", &Session::events)
      .function("width", &Session::width)
      .function("eventWidth", &Session::event_width)
      .function("failure", &Session::failure)
      .function("goOn", &Session::go_on);
}

}  // namespace slapstick::web
