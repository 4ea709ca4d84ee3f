/// Campaign `orbit`: stable orbits of the paper's system, period after period; the impact comes at the same phase with
/// the same state.
#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "campaign.hpp"
#include "progress.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/motion.hpp"
#include "slapstick/io/model_file.hpp"

namespace campaign {
namespace {

using namespace slapstick;

struct Drift {
  long periods = 0;
  double phase = 0.0, state = 0.0;          ///< largest deviation from the first impact's, ever
  double end_phase = 0.0, end_state = 0.0;  ///< that of the last impact
};

/// The orbit has one impact in each period: impact n comes n periods after the first.
Drift follow(double omega, const Options& options, app::Progress& progress, long before) {
  constexpr long transient = 5000;
  const System system(load_model("vibro-impact").build({{"omega", omega}}));
  Motion motion(system, {-0.5, 0.0, 0.0, 0.0});
  while (motion.advance({transient, 0.0}) == Outcome::event) {
  }
  Drift drift;
  double phase = 0.0;
  std::int64_t period = 0;
  State first;
  for (long impacts = 0; impacts <= options.count && (impacts % 4096 != 0 || !options.stopped());) {
    if (motion.advance(motion.time().plus(10.0)) != Outcome::event)
      throw NumericalError("the orbit has no more impacts");
    if (motion.event().kind != EventKind::impact) continue;
    const State state = motion.state();
    if (impacts == 0) first = state, phase = motion.time().fraction, period = motion.time().period;
    drift.end_phase = static_cast<double>(motion.time().period - period - impacts) + (motion.time().fraction - phase);
    drift.end_state = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i)
      drift.end_state = std::max(drift.end_state, std::abs(state[i] - first[i]));
    drift.phase = std::max(drift.phase, std::abs(drift.end_phase));
    drift.state = std::max(drift.state, drift.end_state);
    drift.periods = impacts++;
    if (impacts % 65536 == 0) progress.update(static_cast<double>(before + impacts));
  }
  return drift;
}

}  // namespace

Report run_orbit(const Options& options) {
  constexpr double frequencies[] = {2.2, 1.5};
  app::Progress progress("periods", 2.0 * static_cast<double>(options.count), options.progress);
  Report report;
  report.passed = true;
  long before = 0;
  for (const double omega : frequencies) {
    const Drift drift = follow(omega, options, progress, before);
    Json json = Json::object();
    json.set("periods", drift.periods).set("largest_state_drift", drift.state).set("largest_phase_drift", drift.phase);
    json.set("final_state_drift", drift.end_state).set("final_phase_drift", drift.end_phase);
    report.figures.set("omega " + shown(omega), json);
    report.passed = report.passed && drift.state <= 1e-12 && drift.phase <= 1e-12;
    report.done = before == 0 ? drift.periods : std::min(report.done, drift.periods);
    before += options.count;
  }
  return report;
}

}  // namespace campaign
