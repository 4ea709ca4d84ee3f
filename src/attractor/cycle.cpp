/// Runs a motion period by period, counts its events, and records one cycle.
#include "attractor/cycle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "flow/compiled_system.hpp"
#include "flow/saltation.hpp"

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

bool holds_still(const Motion& motion, ModeId mode) {
  return mode::rests(motion.system().compiled().mode(mode).states());
}

/// How often each kind of change of mode happens; as orbit::returns counts the legs of an orbit.
class Changes {
 public:
  explicit Changes(const Motion& motion) : segments_(motion.counters().segments) {}

  /// After each event.
  void note(const Motion& motion) {
    const Event& event = motion.event();
    const bool same_instant = motion.counters().segments == segments_;
    segments_ = motion.counters().segments;
    const bool changes = event.kind == EventKind::chatter || motion.segment().mode != motion.mode_id();
    if (same_instant || event.kind == EventKind::graze || (!changes && motion.strikes().empty())) return;
    ++counts_[{motion.segment().mode, event.kind, event.contact}];
  }
  [[nodiscard]] int of_the_rarest() const {
    int least = 0;
    for (const auto& [kind, count] : counts_) least = least == 0 ? count : std::min(least, count);
    return least;
  }

 private:
  long segments_;
  std::map<std::tuple<ModeId, EventKind, int>, int> counts_;
};

}  // namespace

void record_cycle(const System& system, const State& state, double duration, const StopChoice& stops, Stop stop,
                  Classification& out) {
  Motion motion(system, state);
  std::vector<double> times, speeds;
  double still = 0.0;
  Changes changes(motion);
  const bool driven = section::driven(system);
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
  run_to(motion, Instant{}.plus(duration), stop, [&] {
    const Event& event = motion.event();
    spend(event.time);
    changes.note(motion);
    if (event.kind == EventKind::chatter && stops.holds(event.contact)) out.chatter = Chatter::complete;
    if (!stops.is_point(event)) return;
    const std::span<const double> before = motion.before();
    const double phase = driven ? event.time.fraction : event.time.since({}) / duration;
    out.impacts.push_back({phase, event.w, event.contact, State(before.begin(), before.end())});
    note_impact();
  });
  spend(motion.time());
  run_to(motion, Instant{}.plus(2.0 * duration), stop, [&] {  // a second cycle: a burst may run across its start
    if (stops.is_point(motion.event())) note_impact();
  });
  out.n = driven ? static_cast<int>(duration) : changes.of_the_rarest();
  out.period = duration * system.period();
  out.p = static_cast<long>(out.impacts.size());
  out.sticking_fraction = still / duration;
  out.sticking = still > 0.0;
  if (out.chatter == Chatter::none && has_burst(times, speeds)) out.chatter = Chatter::incomplete;
  out.label = class_label(out.attractor, out.n, out.p, out.sticking, out.chatter, driven);
}

namespace {

/// Have all events of a cycle a derivative?
bool differentiable(const System& system, const State& state, double duration, Stop stop) {
  Motion motion(system, state);
  bool all = true;
  run_to(motion, Instant{}.plus(duration), stop, [&] { all = all && flow::differentiable(motion.engine()); });
  return all;
}

}  // namespace

void describe(const System& system, const section::Cycle& cycle, const State& state, const ClassifyOptions& options,
              Classification& out) {
  out.attractor = cycle.neutral ? Attractor::family : Attractor::periodic;
  out.family = cycle.family;
  out.doubt = Doubt::none;
  out.approach = cycle.approach;
  record_cycle(system, state, cycle.duration, options.stops, options.cancel, out);
  out.return_distance = cycle.return_distance;
  out.multipliers = cycle.multipliers;
  if (!cycle.multipliers.empty()) out.exponent = std::log(std::abs(cycle.multipliers.front())) / cycle.duration;
  if (differentiable(system, state, cycle.duration, options.cancel)) return;
  out.multipliers.clear();
  out.exponent = std::numeric_limits<double>::quiet_NaN();
}

}  // namespace slapstick::attractor
