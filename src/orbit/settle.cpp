/// The orbit that a motion settles on: the cycle of its return map, or the one that it nearly closes, solved and
/// verified.
#include <cmath>

#include "flow/contact_state.hpp"
#include "orbit/continuum.hpp"
#include "orbit/extent.hpp"
#include "orbit/known_orbits.hpp"
#include "orbit/record.hpp"
#include "section/settling.hpp"
#include "slapstick/orbit/search.hpp"

namespace slapstick::orbit {
namespace {

constexpr double settled_within = 1e-3;  ///< relative distance of a motion from the orbit that it has settled on

/// An orbit from where a motion stands, if there is one whose state is within so much of the motion's.
std::optional<Solution> orbit_from(const Problem& problem, const Motion& motion, int n, double within,
                                   const std::atomic<bool>* stop) {
  const std::optional<Orbit> guess = record(motion, n, stop);
  if (!guess) return std::nullopt;
  Orbit start = *guess;
  start.values = problem.values();
  std::optional<Orbit> orbit = refine_in_place(problem, start);
  if (orbit && times_over(problem, *orbit, same_orbit) > 1)
    orbit = refine_in_place(problem, once(problem, *orbit, same_orbit));
  if (!orbit || Extent(problem, *orbit).distance(orbit->x[0], start.x[0]) > within) return std::nullopt;
  Solution solution = describe(problem, *orbit, &motion.system());
  if (!solution.is_motion) return std::nullopt;
  return solution;
}

/// From a cycle of the stroboscopic map: once round first, so that the motion has left what its start in the user's
/// coordinates may have added by rounding, as a slip that ends at once.
std::optional<Solution> orbit_of_cycle(const Problem& problem, const section::Settling& settling,
                                       const section::Cycle& cycle, const SettleOptions& options) {
  const System& system = settling.translations().system();
  Motion motion(system, settling.moved_to_start_cell(flow::user_state(system, cycle.x)));
  if (!run_to(motion, Instant{}.plus(cycle.duration), options.stop, [] {})) return std::nullopt;
  auto found = orbit_from(problem, motion, problem.free() ? 0 : cycle.n, settled_within, options.stop);
  // At the end of a continuum the orbits beside it have other events: these equations have a double root there.
  const bool at_end = found && cycle.family > 0 && found->family == 0;
  return at_end ? std::nullopt : std::move(found);
}

}  // namespace

Settled settle(const Problem& problem, const System& system, const State& state, const SettleOptions& options) {
  section::Settling settling(system, state,
                             {.most_periods = options.most_periods,
                              .most_n = options.most_n,
                              .by_clock = !problem.free(),
                              .stop = options.stop,
                              .until = options.until});
  settling.discard(options.transient);
  Settled result;
  std::optional<section::Cycle> cycle;
  while (!cycle && !settling.exhausted() && !settling.cancelled()) cycle = settling.next_round();
  result.periods = settling.periods();
  if (cycle) {
    result.n = cycle->n;
    result.orbit = orbit_of_cycle(problem, settling, *cycle, options);
    result.end = result.orbit ? SettleEnd::orbit : SettleEnd::no_orbit;
  } else if (settling.out_of_time()) {
    result.end = SettleEnd::time;
  } else if (problem.free() && !settling.ended() && !settling.cancelled()) {
    // Where events come so often that no section is met alike, the legs of the motion itself may close.
    const State home = settling.moved_to_start_cell(settling.state());
    result.orbit = orbit_from(problem, Motion(system, home), 0, settled_within, options.stop);
    result.end = result.orbit ? SettleEnd::orbit : SettleEnd::no_cycle;
  } else if (settling.ended()) {
    result.end = SettleEnd::rest;
  }
  if (stopped(options.stop)) result.end = SettleEnd::stopped;
  return result;
}

std::optional<Solution> orbit_near(const Problem& problem, Motion motion, long transient, int n,
                                   const std::atomic<bool>* stop) {
  if (!run_to(motion, {motion.time().period + transient, 0.0}, stop, [] {})) return std::nullopt;
  if (n != 0 || problem.free()) return orbit_from(problem, motion, n, settled_within, stop);
  // Newton's method on many periods is dear: it is tried where the motion has come nearer to its start than ever.
  constexpr int longest_cycle = 64;
  constexpr double returned = 0.02, nearer = 0.5;
  double nearest = INFINITY;
  Motion ahead = motion;
  const Eigen::VectorXd start = flow::contact_state(motion);
  double size = start.norm();
  for (int cycle = 1; cycle <= longest_cycle; ++cycle) {
    if (!run_to(ahead, {motion.time().period + cycle, motion.time().fraction}, stop, [] {})) return std::nullopt;
    Eigen::VectorXd away = flow::contact_state(ahead) - start;
    problem.translations().take_out(away);
    size = std::max(size, flow::contact_state(ahead).norm());
    if (away.norm() > returned * size || away.norm() >= nearer * nearest) continue;
    nearest = away.norm();
    auto found = orbit_from(problem, motion, cycle, settled_within, stop);
    if (found || stopped(stop)) return found;
  }
  return std::nullopt;
}

}  // namespace slapstick::orbit
