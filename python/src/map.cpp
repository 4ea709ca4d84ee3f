/// Charts over two parameters: what the motion is at every pixel, as columns.
#include <nanobind/stl/tuple.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "arrays.hpp"
#include "bind.hpp"
#include "chosen.hpp"
#include "map_wish.hpp"
#include "names.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/chart/curves.hpp"
#include "watch.hpp"

namespace slapstick::python {
namespace {

/// A row for each finding; words as numbers of lists of names.
struct Map {
  explicit Map(chart::Chart of) : chart(std::move(of)) {}

  chart::Chart chart;  ///< without what belongs to the call
  sweep::Map found;
  std::vector<std::int32_t> pixel, n, starts;
  std::vector<double> p, exponent, multiplier_re, multiplier_im;
  std::vector<std::uint8_t> sticking, computed;
  Words label, attractor{{}, {}}, chatter, doubt, direction{{"up", "down"}, {}};
  std::vector<std::vector<double>> measured;
  std::vector<std::tuple<int, std::string>> failures;  ///< pixel, reason
  bool complete = true;
};

void add_word(Words& words, std::string_view word) {
  for (std::size_t i = 0; i < words.names.size(); ++i)
    if (words.names[i] == word) return words.codes.push_back(static_cast<std::int32_t>(i));
  words.names.emplace_back(word);
  words.codes.push_back(static_cast<std::int32_t>(words.names.size() - 1));
}

void add(Map& into, const sweep::Map& map, const sweep::Finding& found) {
  into.pixel.push_back(found.pixel);
  into.n.push_back(found.n);
  into.starts.push_back(found.starts);
  const double none = std::numeric_limits<double>::quiet_NaN(), all = std::numeric_limits<double>::infinity();
  into.p.push_back(found.n == 0 ? none : found.chatter == Chatter::complete ? all : found.p);
  into.exponent.push_back(found.exponent);
  into.multiplier_re.push_back(found.multiplier.real());
  into.multiplier_im.push_back(found.multiplier.imag());
  into.sticking.push_back(found.sticking ? 1 : 0);
  into.computed.push_back(found.filled ? 0 : 1);
  add_word(into.label, found.label(map.driven));
  add_word(into.attractor, found.failed ? "failed" : name(found.attractor));
  add_word(into.chatter, name(found.chatter));
  add_word(into.doubt, name(found.doubt));
  into.direction.codes.push_back(found.direction == sweep::Direction::up ? 0 : 1);
  for (std::size_t k = 0; k < map.width; ++k) into.measured[k].push_back(map.values_of(found)[k]);
}

sweep::MapProblem problem_of(const Wish& wish, const Model& model) {
  sweep::MapProblem problem;
  problem.x = axis_of(wish.x);
  problem.y = axis_of(wish.y);
  analyse_as(wish, model, problem);
  problem.start = one_of<sweep::MapStart>(
      "rule", wish.rule,
      {{"reset", sweep::MapStart::reset}, {"carry", sweep::MapStart::carry}, {"random", sweep::MapStart::random}});
  problem.direction = one_of<sweep::Direction>(
      "direction", wish.direction,
      {{"up", sweep::Direction::up}, {"down", sweep::Direction::down}, {"both", sweep::Direction::both}});
  problem.starts = wish.starts;
  problem.seed = wish.seed;
  problem.measured_periods = wish.measured_periods;
  problem.of = wish.of;
  problem.statistics = wish.statistics;
  problem.shard = wish.shard;
  problem.shards = wish.shards;
  problem.refine = wish.refine;
  return problem;
}

/// A start as stores say it.
std::string words_of(const std::optional<Start>& start, const Model& model) {
  if (!start) return {};
  if (const auto* named = std::get_if<Overrides>(&*start)) return chart::state_words(*named);
  const State& state = std::get<State>(*start);
  const std::vector<std::string> names = state_names(model);
  Overrides named;
  for (std::size_t i = 0; i < std::min(names.size(), state.size()); ++i) named[names[i]] = state[i];
  return chart::state_words(named);
}

std::unique_ptr<Map> map(const ModelDefinition& definition, const Overrides& fixed, const std::optional<Start>& start,
                         const Wish& wish, nb::object progress) {
  const auto at = [fixed, x_name = wish.x_name, y_name = wish.y_name](double x, double y) {
    Overrides all = fixed;
    all[x_name] = x;
    all[y_name] = y;
    return all;
  };
  for (const double x : {std::get<0>(wish.x), std::get<1>(wish.x)})  // what can be known to be wrong before the work
    for (const double y : {std::get<0>(wish.y), std::get<1>(wish.y)})
      static_cast<void>(start_of(definition, at(x, y), start));
  const Model model = build(definition, at(std::get<0>(wish.x), std::get<0>(wish.y)));
  auto into = std::make_unique<Map>(chart::Chart{definition, fixed, wish.x_name, wish.y_name, words_of(start, model),
                                                 wish.stops, problem_of(wish, model)});
  into->chart.problem.model_at = [definition, at](double x, double y) { return build(definition, at(x, y)); };
  into->chart.problem.start_at = [definition, at, start](double x, double y) {
    return start_of(definition, at(x, y), start);
  };
  chart::Chart chart = into->chart;
  sweep::MapProblem& problem = chart.problem;
  Watch watch(std::move(progress));
  problem.cancel = watch.cancel();
  problem.progress = [&](long done, long) { watch.note(static_cast<double>(done)); };
  into->measured.resize(wish.of.size());
  watch.run_aside([&] {
    into->found = wish.store.empty() ? sweep::run_map(problem) : chart::stored_map(chart, wish.store, wish.resume);
    const sweep::Map& found = into->found;
    for (std::size_t i = 0; i < found.rows(); ++i) add(*into, found, found.row(i));
    for (const auto& [place, why] : found.failures) into->failures.emplace_back(place.second, why);
  });
  into->complete = watch.finish(true);
  return into;
}

chart::Curves curves(const Map& map, int most, nb::object progress) {
  Watch watch(std::move(progress));
  chart::Curves found;
  watch.run_aside([&] { found = chart::find_curves(map.chart, map.found, most, watch.cancel()); });
  watch.finish(false);
  return found;
}

void bind_curves(nb::module_& module) {
  nb::class_<chart::FoundCurve>(module, "ChartCurve", "A bifurcation curve behind a boundary of a chart.")
      .def_prop_ro("type", [](const chart::FoundCurve& self) { return std::string(name(self.type)); })
      .def_ro("from_class", &chart::FoundCurve::from)
      .def_ro("to_class", &chart::FoundCurve::to)
      .def_prop_ro("x", [](chart::FoundCurve& self) { return column(self.x); })
      .def_prop_ro("y", [](chart::FoundCurve& self) { return column(self.y); })
      .def_ro("edges", &chart::FoundCurve::edges)
      .def_ro("differ", &chart::FoundCurve::differ)
      .def_ro("alike", &chart::FoundCurve::alike);
  nb::class_<chart::Curves>(module, "ChartCurves", "The bifurcation curves of a chart.")
      .def_ro("curves", &chart::Curves::curves)
      .def_ro("edges", &chart::Curves::edges)
      .def_ro("explained", &chart::Curves::explained)
      .def_ro("without", &chart::Curves::without);
}

void bind_found(nb::module_& module) {
  nb::class_<Map>(module, "Map", "What the motion is at every pixel of a chart: a row for each finding.")
      .def_prop_ro("pixel", [](Map& self) { return column(self.pixel); })
      .def_prop_ro("n", [](Map& self) { return column(self.n); })
      .def_prop_ro("p", [](Map& self) { return column(self.p); })
      .def_prop_ro("starts", [](Map& self) { return column(self.starts); })
      .def_prop_ro("sticking", [](Map& self) { return column(self.sticking); })
      .def_prop_ro("computed", [](Map& self) { return column(self.computed); })
      .def("curves", &curves, "most"_a, "progress"_a.none())
      .def_prop_ro("exponent", [](Map& self) { return column(self.exponent); })
      .def_prop_ro("multiplier_re", [](Map& self) { return column(self.multiplier_re); })
      .def_prop_ro("multiplier_im", [](Map& self) { return column(self.multiplier_im); })
      .def_prop_ro("label_codes", [](Map& self) { return column(self.label.codes); })
      .def_prop_ro("label_names", [](const Map& self) { return self.label.names; })
      .def_prop_ro("attractor_codes", [](Map& self) { return column(self.attractor.codes); })
      .def_prop_ro("attractor_names", [](const Map& self) { return self.attractor.names; })
      .def_prop_ro("chatter_codes", [](Map& self) { return column(self.chatter.codes); })
      .def_prop_ro("chatter_names", [](const Map& self) { return self.chatter.names; })
      .def_prop_ro("doubt_codes", [](Map& self) { return column(self.doubt.codes); })
      .def_prop_ro("doubt_names", [](const Map& self) { return self.doubt.names; })
      .def_prop_ro("direction_codes", [](Map& self) { return column(self.direction.codes); })
      .def(
          "measured", [](Map& self, std::size_t k) { return column(self.measured.at(k)); }, "k"_a)
      .def_ro("failures", &Map::failures)
      .def_ro("complete", &Map::complete);
}

void bind_map_wish(nb::module_& module) {
  nb::class_<Wish>(module, "MapWish", "What a chart is asked for.")
      .def(nb::init<>())
      .def_rw("x_name", &Wish::x_name)
      .def_rw("y_name", &Wish::y_name)
      .def_rw("x", &Wish::x)
      .def_rw("y", &Wish::y)
      .def_rw("level", &Wish::level)
      .def_rw("rule", &Wish::rule)
      .def_rw("direction", &Wish::direction)
      .def_rw("periods", &Wish::periods)
      .def_rw("starts", &Wish::starts)
      .def_rw("seed", &Wish::seed)
      .def_rw("most_n", &Wish::most_n)
      .def_rw("transient", &Wish::transient)
      .def_rw("most_periods", &Wish::most_periods)
      .def_rw("exponent_periods", &Wish::exponent_periods)
      .def_rw("measured_periods", &Wish::measured_periods)
      .def_rw("stops", &Wish::stops)
      .def_rw("of", &Wish::of)
      .def_rw("statistics", &Wish::statistics)
      .def_rw("shard", &Wish::shard)
      .def_rw("shards", &Wish::shards)
      .def_rw("threads", &Wish::threads)
      .def_rw("refine", &Wish::refine)
      .def_rw("store", &Wish::store)
      .def_rw("resume", &Wish::resume);
}

}  // namespace

void bind_map(nb::module_& module) {
  bind_curves(module);
  bind_found(module);
  bind_map_wish(module);
  module.def("map", &map, "definition"_a, "fixed"_a, "start"_a.none(), "wish"_a, "progress"_a.none());
}

}  // namespace slapstick::python
