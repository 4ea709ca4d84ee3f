/// Which of the orbits of a model is meant: conditions, an order, and the way from the cheapest source of orbits to the
/// dearest.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/ranges.hpp"
#include "flow/compiled_system.hpp"
#include "mode/assembly.hpp"
#include "orbit/continuum.hpp"
#include "orbit/known_orbits.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/orbit/search.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::VectorXd;

/// The contact state of a user's state, modulo translations.
VectorXd representative(const Problem& problem, const State& state) {
  const mode::Frame& frame = problem.base().compiled().frame();
  VectorXd X = VectorXd::Zero(frame.size()), x(2 * frame.n);
  frame.enter(state.data(), X.data());
  x << X.head(frame.n), X.segment(frame.d, frame.n);
  problem.translations().take_out(x);
  return x;
}

/// Contact states of an orbit at equal parts of its legs, modulo translations.
std::vector<VectorXd> along(const Problem& problem, const Orbit& orbit) {
  constexpr int looks = 64;
  const ModeSet set(constant_family(problem.family().model(orbit.values)), {});
  std::vector<VectorXd> states;
  for (std::size_t leg = 0; leg < orbit.legs(); ++leg)
    for (int k = 0; k < looks; ++k) {
      states.push_back(contact_state(set, state_within(set, orbit, leg, orbit.duration(leg) * k / looks)));
      problem.translations().take_out(states.back());
    }
  return states;
}

}  // namespace

bool OrbitChoice::admits(const Problem& problem, const Solution& solution) const {
  const Itinerary& shape = solution.orbit.shape;
  if (n && (shape.n > 0 ? shape.n : returns(shape)) != *n) return false;
  if (chatter && solution.chatter != *chatter) return false;
  if (p && (solution.chatter || solution.impacts != *p)) return false;
  if (sticking && solution.sticking != *sticking) return false;
  if (stable && solution.stable() != *stable) return false;
  return !symmetric || orbit::symmetric(problem, solution.orbit) == *symmetric;
}

bool OrbitChoice::none() const { return !n && !p && !chatter && !sticking && !stable && !symmetric && !nearest; }

double distance(const Problem& problem, const Orbit& orbit, const State& state) {
  const mode::Frame& frame = problem.base().compiled().frame();
  const double cycle = orbit.shape.n > 0 ? 1.0 : orbit.t.back() - orbit.t.front();
  const double omega = 2.0 * std::numbers::pi / (cycle * problem.base().period());
  const Eigen::MatrixXd mass =
      frame.W_inverse.transpose() * mode::mass_matrix(problem.base().model()) * frame.W_inverse;
  const VectorXd from = representative(problem, state);
  std::vector<VectorXd> states;
  for (int period = 0; period < orbit.shape.n; ++period)
    states.push_back(representative(problem, at_phase_zero(problem, orbit, period)));
  if (orbit.shape.n == 0) states = along(problem, orbit);
  double least = INFINITY;
  for (const VectorXd& state_of_orbit : states) {
    const VectorXd away = state_of_orbit - from;
    const VectorXd dp = omega * away.head(frame.n), du = away.tail(frame.n);
    least = std::min(least, std::sqrt(dp.dot(mass * dp) + du.dot(mass * du)));
  }
  return least;
}

bool symmetric(const Problem& problem, const Orbit& orbit) { return apart_from_own_image(problem, orbit) < same_orbit; }

namespace {

/// Where the orbit that is wanted is among those that were found; their number if it is not.
std::size_t wanted(const Problem& problem, const OrbitChoice& choice, const std::vector<Solution>& found) {
  std::size_t best = found.size();
  double least = INFINITY;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!choice.admits(problem, found[i])) continue;
    const double away = choice.nearest ? distance(problem, found[i].orbit, *choice.nearest) : 0.0;
    if (best < found.size() && away >= least) continue;
    best = i;
    least = away;
  }
  return best;
}

/// Chooses among what the motion settles on and what a search found.
void choose_among(const Problem& problem, const OrbitChoice& choice, std::vector<Solution> found, Chosen& result) {
  const std::optional<Solution>& settled = result.settled.orbit;
  if (settled) {
    KnownOrbits free(problem);
    if (settled->orbit.shape.n == 0) free.add(settled->orbit);
    std::erase_if(found, [&](const Solution& one) {
      return free.has(one.orbit) || apart(problem, settled->orbit, one.orbit) < same_orbit ||
             (one.family > 0 && settled->family > 0 && in_one_family(problem, settled->orbit, one.orbit));
    });
    found.insert(found.begin(), *settled);
  }
  const std::size_t which = wanted(problem, choice, found);
  if (which < found.size()) {
    result.orbit = std::move(found[which]);
    found.erase(found.begin() + static_cast<std::ptrdiff_t>(which));
    result.settles = settled && which == 0;
  }
  result.others = std::move(found);
}

/// Without a transient the state itself is what is asked about: an orbit that it lies on, stable or not, if it is
/// one that is meant.
bool choose_at(const Problem& problem, const System& system, const State& state, const OrbitChoice& choice,
               const SettleOptions& options, Chosen& result) {
  if (options.transient > 0 || choice.nearest) return false;
  const int n = problem.free() ? 0 : choice.n.value_or(0);
  std::optional<Solution> found = orbit_near(problem, Motion(system, state), 0, n, options.stop);
  if (!found || !choice.admits(problem, *found)) return false;
  result.settles = found->stable();
  result.orbit = std::move(found);
  return true;
}

}  // namespace

Chosen choose(const Problem& problem, const System& system, const State& state, const OrbitChoice& choice,
              const SettleOptions& settling, SearchOptions searching) {
  Chosen result;
  if (choose_at(problem, system, state, choice, settling, result)) return result;
  result.settled = settle(problem, system, state, settling);
  const std::optional<Solution>& settled = result.settled.orbit;
  const bool admitted = settled && choice.admits(problem, *settled) && !choice.nearest;
  if (admitted || choice.none() || stopped(settling.stop)) {
    choose_among(problem, choice, {}, result);
    return result;
  }
  if (choice.n) searching.only_n = choice.n;
  if (!choice.nearest) searching.enough = [&](const Solution& found) { return choice.admits(problem, found); };
  SearchResult found = search(problem, system, state, searching);
  found.report.other =
      ranges::count_if(found.orbits, [&](const Solution& one) { return !choice.admits(problem, one); });
  result.search = found.report;
  choose_among(problem, choice, std::move(found.orbits), result);
  return result;
}

}  // namespace slapstick::orbit
