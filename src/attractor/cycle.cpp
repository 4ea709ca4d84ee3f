/// Runs a motion period by period, counts its events, and records one cycle.
#include "attractor/cycle.hpp"

#include <algorithm>
#include <cmath>

#include "flow/compiled_system.hpp"

namespace slapstick::attractor {

bool has_burst(const std::vector<double>& times, const std::vector<double>& speeds) {
  int shrinking = 1;
  for (std::size_t i = 2; i < times.size(); ++i) {
    const bool sooner = times[i] - times[i - 1] < times[i - 1] - times[i - 2];
    shrinking = sooner && speeds[i] < speeds[i - 1] && speeds[i - 1] < speeds[i - 2] ? shrinking + 1 : 1;
    if (shrinking >= 3) return true;  // four impacts: three flights and speeds in a row
  }
  return false;
}

namespace {

/// "1-1-II", "2-inf-II".
std::string cycle_label(const Classification& c) {
  const std::string p = c.chatter == Chatter::complete ? "inf" : std::to_string(c.p);
  return std::to_string(c.n) + "-" + p + (c.sticking ? "-II" : "-I");
}

bool holds_still(const Motion& motion, ModeId mode) {
  const mode::ContactStates& states = motion.system().compiled().mode(mode).states();
  for (mode::FrictionState s : states.frictions) {
    if (s == mode::FrictionState::stick) return true;
  }
  for (mode::StopState s : states.stops) {
    if (s == mode::StopState::closed) return true;
  }
  return false;
}

}  // namespace

void record_cycle(const System& system, const State& state, int n, const StopChoice& stops, Stop stop,
                  Classification& out) {
  Motion motion(system, state);
  std::vector<double> times, speeds;
  double still = 0.0;
  out.n = n;
  out.state = state;
  out.impacts.clear();
  out.chatter = Chatter::none;
  // Between two events, and between a cut and an event, the mode is one.
  ModeId mode = motion.mode_id();
  Instant seen = motion.time();
  const auto spend = [&](Instant now) {
    if (holds_still(motion, mode)) still += now.since(seen);
    seen = now;
    mode = motion.mode_id();
  };
  const auto note_impact = [&] {
    times.push_back(motion.event().time.since({}));
    speeds.push_back(motion.event().w);
  };
  run_to(motion, {n, 0.0}, stop, [&] {
    const Event& event = motion.event();
    spend(event.time);
    if (event.kind == EventKind::chatter && stops.holds(event.contact)) out.chatter = Chatter::complete;
    if (!stops.is_point(event)) return;
    const std::span<const double> before = motion.before();
    out.impacts.push_back({event.time.fraction, event.w, event.contact, State(before.begin(), before.end())});
    note_impact();
  });
  spend(motion.time());
  run_to(motion, {2 * n, 0.0}, stop, [&] {  // a second cycle: a burst may run across its start
    if (stops.is_point(motion.event())) note_impact();
  });
  out.p = static_cast<long>(out.impacts.size());
  out.sticking_fraction = still / n;
  out.sticking = still > 0.0;
  if (out.chatter == Chatter::none && has_burst(times, speeds)) out.chatter = Chatter::incomplete;
  out.label = cycle_label(out);
}

}  // namespace slapstick::attractor
