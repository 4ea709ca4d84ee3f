/// Analyses pixels of a map: from a start to what the motion is.
#include "sweep/map_pixel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "base/floating_point.hpp"
#include "base/ranges.hpp"
#include "flow/contact_state.hpp"
#include "orbit/starts.hpp"
#include "section/settling.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/stage.hpp"
#include "sweep/attractors.hpp"
#include "sweep/diagram_point.hpp"
#include "sweep/lane_pixels.hpp"

namespace slapstick::sweep {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// `classify` gives a rate to what has one; the rest is 0 there.
bool has_exponent(const Classification& found) {
  if (found.n > 0 || !found.eigenvalues.empty()) return true;
  if (found.attractor == Attractor::equilibrium) return found.sticking;
  return found.exponent != 0.0 || found.exponent_error != 0.0;
}

Finding finding_of(const Classification& found, const PixelTask& task) {
  Finding finding{.pixel = task.number, .direction = task.direction};
  finding.attractor = found.attractor;
  finding.doubt = found.doubt;
  finding.chatter = found.chatter;
  finding.sticking = found.sticking;
  finding.n = found.n;
  finding.p = static_cast<std::int32_t>(std::min<long>(found.p, std::numeric_limits<std::int32_t>::max()));
  finding.exponent = has_exponent(found) ? found.exponent : unknown;
  finding.multiplier = found.multipliers.empty() ? std::complex<double>(unknown, unknown) : found.multipliers.front();
  return finding;
}

/// One pixel while it is analysed.
class Analysis {
 public:
  /// @param known  null: none
  Analysis(const MapProblem& problem, const PixelTask& task, const KnownCycles* known)
      : problem_(problem), task_(task), known_(known) {
    pixel_.number = task.number;
    pixel_.direction = task.direction;
  }

  /// @returns nothing if it was cancelled
  std::optional<Pixel> operator()() {
    return attempt([&] { run(); });
  }

  /// The same of what lanes have found.
  std::optional<Pixel> of(LaneFinding&& lane) {
    return attempt([&] {
      if (keeps_state()) pixel_.carried = lane.found.state;
      if (lane.system == nullptr && !problem_.of.empty())
        lane.system = std::make_unique<System>(model_at(problem_, task_));
      keep(lane.system.get(), lane.found, 1);
    });
  }

 private:
  template <class Body>
  std::optional<Pixel> attempt(const Body& body) {
    try {
      body();
    } catch (const NumericalError& error) {
      fail(error.what());
    } catch (const InputError& error) {
      fail(error.what());
    }
    if (interrupted_) return std::nullopt;
    return std::move(pixel_);
  }

  void run() {
    const System system(model_at(problem_, task_));
    const State start = start_of(problem_, task_, system.model());
    if (problem_.start == MapStart::random) return run_all(system, start);
    const Classification* known = known_ != nullptr && known_->size() > 0 ? comes_to(system, start) : nullptr;
    const Classification found = known != nullptr ? *known : classified(system, start);
    if (interrupted_) return;
    if (keeps_state()) pixel_.carried = found.state;
    keep(&system, found, 1);
  }

  /// The known cycle that the motion comes to within the periods of `quick`; null: none. One that is beside none after
  /// half of them is not waited for.
  const Classification* comes_to(const System& system, const State& start) {
    KnownCycles::Watch watch(*known_);
    Motion motion(system, start);
    try {
      for (int period = 1; period <= problem_.periods; ++period) {
        if (2 * period > problem_.periods && !watch.beside()) return nullptr;
        interrupted_ = interrupted_ || !run_to(motion, {period, 0.0}, problem_.cancel, [] {});
        if (interrupted_) return nullptr;
        if (const Classification* found = watch.see(flow::contact_state(motion))) return found;
      }
    } catch (const NumericalError&) {  // what is asked next says it
    }
    return nullptr;
  }

  Classification classified(const System& system, const State& start) {
    ClassifyOptions options = problem_.classify;
    options.cancel = problem_.cancel;
    options.progress = {};
    Classification found = problem_.level == Level::quick ? classify_quickly(system, start, problem_.periods, options)
                                                          : classify(system, start, options);
    interrupted_ = interrupted_ || found.interrupted;
    return found;
  }

  /// Every attractor, with the number of starts that lead there; one with more starts goes first, of equals the one
  /// that was found first.
  void run_all(const System& system, const State& start) {
    struct Known {
      Classification found;
      int starts;
    };
    std::vector<Known> all;
    Attractors known(system);
    const flow::Translations translations(system);
    const orbit::Starts starts(translations, Motion(system, start), problem_.cancel);
    std::mt19937 random(static_cast<std::mt19937::result_type>(problem_.seed));
    for (int k = 0; k < problem_.starts && !interrupted_; ++k) {
      const State one = k == 0 ? start : flow::user_state(system, starts.draw(random, 1.0));
      Classification found = classified(system, one);
      if (interrupted_) return;
      known.reach(one);
      const int place = known.find(found.attractor, found.label, found.state);
      if (place >= 0) {
        ++all[static_cast<std::size_t>(place)].starts;
      } else {
        (void)known.add(found);
        all.push_back({std::move(found), 1});
      }
    }
    std::stable_sort(all.begin(), all.end(), [](const Known& a, const Known& b) { return a.starts > b.starts; });
    for (const Known& one : all) keep(&system, one.found, one.starts);
  }

  [[nodiscard]] bool keeps_state() const { return problem_.start == MapStart::carry || problem_.keep_states; }

  /// @param system  null if nothing is measured
  void keep(const System* system, const Classification& found, int starts) {
    Finding finding = finding_of(found, task_);
    finding.starts = starts;
    pixel_.found.push_back(finding);
    if (!problem_.of.empty()) measure_values(*system, found);
  }

  /// A measure that fails is NaN: the class is known all the same.
  void measure_values(const System& system, const Classification& found) {
    const bool cycle = found.n > 0;
    try {
      const double periods = cycle ? found.period / system.period() : problem_.measured_periods;
      const Measured measured =
          measure(Motion(system, found.state), Instant{}.plus(periods), problem_.of, problem_.cancel);
      interrupted_ = interrupted_ || !measured.complete;
      for (std::size_t k = 0; k < problem_.of.size(); ++k)
        pixel_.values.push_back(statistic(measured.of[k], problem_.statistics[k]));
    } catch (const NumericalError&) {
      pixel_.values.insert(pixel_.values.end(), problem_.of.size(), unknown);
    }
  }

  void fail(const char* why) {
    pixel_.failure = why;
    pixel_.carried = task_.start;
    Finding finding{.pixel = task_.number, .direction = task_.direction, .failed = true};
    finding.exponent = unknown;
    finding.multiplier = {unknown, unknown};
    pixel_.found = {finding};
    pixel_.values.assign(problem_.of.size(), unknown);
  }

  const MapProblem& problem_;
  const PixelTask& task_;
  const KnownCycles* known_;
  Pixel pixel_;
  bool interrupted_ = false;
};

}  // namespace

Model model_at(const MapProblem& problem, const PixelTask& task) {
  return problem.model_at(problem.x_at(task.number), problem.y_at(task.number));
}

State start_of(const MapProblem& problem, const PixelTask& task, const Model& model) {
  const auto own = [&] { return problem.start_at(problem.x_at(task.number), problem.y_at(task.number)); };
  if (task.start.empty()) return own();
  State state = task.start;
  undo_rounding(model, state);
  try {
    validate(model, state);
    return state;
  } catch (const InputError&) {
    return own();
  }
}

std::vector<Pixel> analyse(const MapProblem& problem, std::span<const PixelTask> tasks, const KnownCycles* known) {
  std::vector<std::optional<Pixel>> pixels(tasks.size());
  if (runs_in_lanes(problem))
    run_quick_in_lanes(problem, tasks, known, [&](std::size_t i, LaneFinding&& lane) {
      pixels[i] = Analysis(problem, tasks[i], known).of(std::move(lane));
    });
  for (std::size_t i = 0; i < tasks.size() && !stopped(problem.cancel); ++i)
    if (!pixels[i]) pixels[i] = Analysis(problem, tasks[i], known)();
  std::vector<Pixel> done;
  for (std::optional<Pixel>& pixel : pixels)
    if (pixel) done.push_back(std::move(*pixel));
  return done;
}

}  // namespace slapstick::sweep
