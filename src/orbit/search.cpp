#include <algorithm>
#include <cmath>
#include <random>

#include "attractor/cycle.hpp"
#include "orbit/cyclic.hpp"
#include "orbit/extent.hpp"
#include "orbit/path.hpp"
#include "orbit/record.hpp"
#include "orbit/same_motion.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/orbit/periodic_orbit.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::VectorXd;

constexpr double near_return = 0.25;  ///< relative distance of a state to its image from which Newton's method is tried
constexpr double same_orbit = 1e-6;   ///< relative distance of two orbits' states at one event
constexpr double settled = 1e-3;      ///< relative distance of a motion from the orbit that it has settled on
constexpr int longest_cycle = 64;
constexpr int from_one_guess = 4;  ///< orbits at most

/// Are two cycles the same, begun at another event or in another period?
bool same_from_some_event(const Extent& extent, const Orbit& a, const Orbit& b) {
  return from_some_event(a, b, [&](std::size_t shift) {
    return extent.distance(a.x[0], b.x[shift]) <= same_orbit &&
           (a.shape.n == 0 || std::abs(std::remainder(a.t[0] - b.t[shift], 1.0)) < same_orbit);
  });
}

/// Is it one of these? Equal legs tell soonest. Others may be the same motion: how many impacts of a chatter are legs of their own is a matter of where
/// it was recorded.
bool known(const Problem& problem, const std::vector<Orbit>& found, const Orbit& orbit) {
  const Extent extent(problem, orbit);
  const auto alike = [&](const Orbit& other) {
    return other.shape.n == orbit.shape.n && same_from_some_event(extent, orbit, other);
  };
  const auto same = [&](const Orbit& other) { return apart(problem, orbit, other) < same_orbit; };
  return std::ranges::any_of(found, alike) || std::ranges::any_of(found, same);
}

/// Is it a shorter cycle several times over?
bool is_multiple(const Problem& problem, const Orbit& orbit) {
  const std::optional<std::size_t> part = repeats(problem, orbit, same_orbit);
  if (part && orbit.shape.n % static_cast<int>(orbit.legs() / *part) == 0) return true;
  for (int periods = 1; 2 * periods <= orbit.shape.n; ++periods)
    if (orbit.shape.n % periods == 0 && apart_from_later(problem, orbit, periods) < same_orbit) return true;
  return false;
}

/// An orbit from where a motion stands, if there is one whose state is within so much of the motion's.
std::optional<Solution> orbit_from(const Problem& problem, const System& system, const Motion& motion, int n,
                                   double within, const std::atomic<bool>* stop) {
  const std::optional<Orbit> guess = record(motion, n, stop);
  if (!guess) return std::nullopt;
  Orbit start = *guess;
  start.values = problem.values();
  std::optional<Orbit> orbit = refine(problem, start);
  if (orbit && repeats(problem, *orbit, same_orbit)) orbit = refine(problem, once(problem, *orbit, same_orbit));
  if (!orbit || Extent(problem, *orbit).distance(orbit->x[0], start.x[0]) > within) return std::nullopt;
  Solution solution = describe(problem, *orbit, &system);
  if (!solution.is_motion) return std::nullopt;
  return solution;
}

/// Runs a motion from phase 0 and tries every near return.
class Hunt {
 public:
  Hunt(const Problem& problem, const System& system, const SearchOptions& options)
      : problem_(problem), system_(system), options_(options) {}

  void run(const State& start) {
    Motion motion(system_, start);
    std::vector<VectorXd> states;
    std::vector<Motion> at;
    for (int k = 0; k < options_.periods && !enough_ && !stopped(options_.stop); ++k) {
      states.push_back(attractor::contact_state(motion));
      at.push_back(motion);
      if (at.size() > static_cast<std::size_t>(longest_cycle) + 1) at.erase(at.begin());
      run_to(motion, {k + 1, 0.0}, options_.stop, [] {});
      try_returns(states, at, attractor::contact_state(motion));
    }
  }

  std::vector<Solution> found() && { return std::move(found_); }
  [[nodiscard]] bool enough() const { return enough_; }
  [[nodiscard]] VectorXd size() const { return size_; }

 private:
  void try_returns(const std::vector<VectorXd>& states, const std::vector<Motion>& at, const VectorXd& now) {
    if (size_.size() == 0) size_ = VectorXd::Zero(now.size());
    size_ = size_.cwiseMax(now.cwiseAbs());
    const int most = options_.only_n.value_or(options_.most_n);
    for (int n = options_.only_n.value_or(1); n <= most && n <= static_cast<int>(states.size()); ++n) {
      const VectorXd& before = states[states.size() - static_cast<std::size_t>(n)];
      if ((now - before).norm() > near_return * size_.norm()) continue;
      if (auto guess = record(at[at.size() - static_cast<std::size_t>(n)], n, options_.stop)) refine_all(*guess);
    }
  }

  /// The orbits that Newton's method comes to from a guess: each new one is taken out, and the guess used again.
  void refine_all(Orbit guess) {
    guess.values = problem_.values();
    for (int i = 0; i < from_one_guess && !enough_; ++i) {
      const std::optional<Orbit> orbit = refine(problem_, guess, i == 0 ? std::vector<Orbit>{} : seen_);
      if (!orbit || known(problem_, seen_, *orbit)) return;
      add(*orbit);
    }
  }

  void add(const Orbit& orbit) {
    seen_.push_back(orbit);
    if (is_multiple(problem_, orbit)) return;
    Solution solution = describe(problem_, orbit, &system_);
    if (!solution.is_motion) return;
    enough_ = options_.enough && options_.enough(solution);
    found_.push_back(std::move(solution));
  }

  const Problem& problem_;
  const System& system_;
  const SearchOptions& options_;
  VectorXd size_;
  std::vector<Orbit> seen_;  ///< all that solve their equations, motions or not
  std::vector<Solution> found_;
  bool enough_ = false;
};

}  // namespace

std::vector<Solution> search(const Problem& problem, const System& system, const State& state,
                             const SearchOptions& options) {
  Hunt hunt(problem, system, options);
  std::mt19937 random(options.seed);
  std::normal_distribution<double> normal;
  for (int i = 0; i < options.starts && !hunt.enough() && !stopped(options.stop); ++i) {
    State start = state;
    if (i > 0) {
      Eigen::VectorXd x = hunt.size();
      for (double& number : x) number *= options.spread * normal(random);
      start = attractor::user_state(system, x);
    }
    try {
      hunt.run(start);
    } catch (const InputError&) {  // a start behind a stop
    } catch (const NumericalError&) {
    }
    if (options.progress) options.progress(i + 1);
  }
  std::vector<Solution> found = std::move(hunt).found();
  std::ranges::stable_sort(found, {}, [](const Solution& s) {
    return std::pair(s.orbit.shape.n, s.chatter ? std::numeric_limits<long>::max() : s.impacts);
  });
  return found;
}

std::optional<Solution> settle(const Problem& problem, const System& system, const State& state, long transient, int n,
                               const std::atomic<bool>* stop) {
  return settle(problem, Motion(system, state), transient, n, stop);
}

std::optional<Solution> settle(const Problem& problem, Motion motion, long transient, int n,
                               const std::atomic<bool>* stop) {
  const System& system = motion.system();
  if (!run_to(motion, {motion.time().period + transient, 0.0}, stop, [] {})) return std::nullopt;
  if (n != 0 || !system.model().forced()) return orbit_from(problem, system, motion, n, settled, stop);
  // Newton's method on many periods is dear: it is tried where the motion has come nearer to its start than ever.
  constexpr double returned = 0.02, nearer = 0.5;
  double nearest = INFINITY;
  Motion ahead = motion;
  const VectorXd start = attractor::contact_state(motion);
  double size = start.norm();
  for (int cycle = 1; cycle <= longest_cycle; ++cycle) {
    if (!run_to(ahead, {motion.time().period + cycle, motion.time().fraction}, stop, [] {})) return std::nullopt;
    VectorXd away = attractor::contact_state(ahead) - start;
    problem.translations().take_out(away);
    size = std::max(size, attractor::contact_state(ahead).norm());
    if (away.norm() > returned * size || away.norm() >= nearer * nearest) continue;
    nearest = away.norm();
    auto found = orbit_from(problem, system, motion, cycle, settled, stop);
    if (found || stopped(stop)) return found;
  }
  return std::nullopt;
}

}  // namespace slapstick::orbit
