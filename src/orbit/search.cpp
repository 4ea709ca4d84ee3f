/// The search for orbits: near returns of many motions, each refined by Newton's method.
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "base/ranges.hpp"
#include "flow/contact_state.hpp"
#include "orbit/continuum.hpp"
#include "orbit/extent.hpp"
#include "orbit/known_orbits.hpp"
#include "orbit/record.hpp"
#include "orbit/starts.hpp"
#include "section/flights.hpp"
#include "section/return_map.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/natural_modes.hpp"
#include "slapstick/orbit/search.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::VectorXd;

constexpr double near_return =
    0.25;  ///< distance of a state to its image, in units of the motion's size, from which Newton's method is tried
constexpr double same_state = 1e-9;  ///< .. below which a motion has become periodic: it shows nothing new any more
constexpr int from_one_guess = 4;    ///< orbits at most

/// Is it a shorter cycle several times over?
bool is_multiple(const Problem& problem, const Orbit& orbit) {
  if (times_over(problem, orbit, same_orbit) > 1) return true;
  for (int periods = 1; 2 * periods <= orbit.shape.n; ++periods)
    if (orbit.shape.n % periods == 0 && apart_from_later(problem, orbit, periods) < same_orbit) return true;
  return false;
}

/// When returns after n periods are next tried: ever more rarely while they lead to nothing new.
struct Patience {
  int next = 0, fruitless = 0;
  void note(int now, bool something_new) {
    fruitless = something_new ? 0 : fruitless + 1;
    next = now + 1 + fruitless / 2;
  }
};

/// Looks through motions one after another.
class Hunt {
 public:
  Hunt(const Problem& problem, const System& system, const SearchOptions& options)
      : problem_(problem),
        system_(system),
        options_(options),
        known_(problem),
        least_n_(options.only_n.value_or(1)),
        most_n_(options.only_n.value_or(options.most_n)) {}

  /// @param size   of displacements and velocities
  /// @param nearby  the motion's start itself is a guess
  void run(Motion motion, const VectorXd& size, bool nearby);
  /// The same of a free motion: from event to event.
  void run_free(Motion motion, const VectorXd& size);

  [[nodiscard]] bool over() const {
    return enough_ || stopped(options_.stop) || (options_.until && std::chrono::steady_clock::now() >= *options_.until);
  }
  [[nodiscard]] SearchEnd end() const {
    return enough_ ? SearchEnd::enough : stopped(options_.stop) ? SearchEnd::stopped : SearchEnd::time;
  }

  std::vector<Solution> found;
  SearchReport report;

 private:
  bool try_return(const Motion& from, int n);
  bool try_returns(const std::vector<Seen>& events, const VectorXd& size, std::vector<Patience>& patience);
  bool refine_all(Orbit guess);
  bool add(const Orbit& orbit);

  const Problem& problem_;
  const System& system_;
  const SearchOptions& options_;
  KnownOrbits known_;  ///< all that solve their equations, motions or not
  int least_n_, most_n_;
  bool enough_ = false;
};

void Hunt::run(Motion motion, const VectorXd& size, bool nearby) {
  const double phase = motion.time().fraction;
  std::vector<VectorXd> states;
  std::vector<Motion> at;
  std::vector<Patience> patience(static_cast<std::size_t>(most_n_) + 1);
  for (int k = 0; k <= options_.periods && !over(); ++k) {
    at.push_back(motion);
    if (at.size() > static_cast<std::size_t>(most_n_) + 1) at.erase(at.begin());
    states.push_back(flow::contact_state(motion));
    problem_.translations().take_out(states.back());
    for (int n = least_n_; n <= most_n_ && n <= k && !over(); ++n) {
      const double returned = section::distance(states.back(), states[static_cast<std::size_t>(k - n)], size);
      const bool first = nearby && k == n;
      if (!first && !(returned <= near_return)) continue;
      Patience& turn = patience[static_cast<std::size_t>(n)];
      const bool periodic = returned <= same_state;
      if (k >= turn.next || periodic) {
        ++report.returns;
        turn.note(k, try_return(at[at.size() - 1 - static_cast<std::size_t>(n)], n));
      }
      if (periodic) return;
    }
    if (k < options_.periods) run_to(motion, {k + 1, phase}, options_.stop, [] {});
  }
}

namespace {

constexpr std::size_t most_legs = 64;  ///< of a free cycle that is looked for

/// What the states at the events range over, one number for displacements and one for velocities, no less than `size`.
VectorXd sizes_of(const std::vector<Seen>& events, VectorXd size) {
  VectorXd low = events.front().x, high = low;
  for (const Seen& event : events) {
    low = low.cwiseMin(event.x);
    high = high.cwiseMax(event.x);
  }
  const auto n = size.size() / 2;
  size.head(n) = size.head(n).cwiseMax((high - low).head(n).maxCoeff());
  size.tail(n) = size.tail(n).cwiseMax((high - low).tail(n).maxCoeff());
  return size;
}

}  // namespace

void Hunt::run_free(Motion motion, const VectorXd& size) {
  std::vector<Seen> events;
  std::vector<Patience> patience(most_legs + 1);
  const Instant end = motion.time().plus(section::patience(system_));
  EventReader reader(motion, 0, options_.stop);
  for (int k = 0; k < 2 * options_.periods && !over(); ++k) {
    auto seen = reader.next(end);
    if (!seen) return;
    problem_.translations().take_out(seen->x);
    events.push_back(std::move(*seen));
    if (try_returns(events, sizes_of(events, size), patience)) return;
  }
}

/// From the last event back to earlier ones of the same kind. @returns whether the motion has become periodic
bool Hunt::try_returns(const std::vector<Seen>& events, const VectorXd& size, std::vector<Patience>& patience) {
  const std::size_t last = events.size() - 1;
  for (std::size_t legs = 1; legs <= std::min(last, most_legs) && !over(); ++legs) {
    const Seen& before = events[last - legs];
    if (!(before.leg == events[last].leg)) continue;
    const double returned = section::distance(events[last].x, before.x, size);
    if (!(returned <= near_return)) continue;
    const std::vector<Seen> cycle(events.end() - static_cast<std::ptrdiff_t>(legs) - 1, events.end());
    const Orbit guess = orbit_of(cycle, legs, 0);
    if (const int n = returns(guess.shape); n < least_n_ || n > most_n_) continue;
    const bool periodic = returned <= same_state;
    Patience& turn = patience[legs];
    if (static_cast<int>(last) >= turn.next || periodic) {
      ++report.returns;
      turn.note(static_cast<int>(last), refine_all(guess));
    }
    if (periodic) return true;
  }
  return false;
}

bool Hunt::try_return(const Motion& from, int n) {
  const std::optional<Orbit> guess = record(from, n, options_.stop);
  return guess && refine_all(*guess);
}

/// The orbits that Newton's method comes to from a guess: each new one is taken out, and the guess used again. @returns
/// whether one is new
bool Hunt::refine_all(Orbit guess) {
  guess.values = problem_.values();
  bool something_new = false;
  for (int i = 0; i < from_one_guess && !over(); ++i) {
    ++report.newton_runs;
    const auto orbit = refine_in_place(problem_, guess, i == 0 ? std::vector<Orbit>{} : known_.orbits());
    if (!orbit) {
      ++report.diverged;
      return something_new;
    }
    if (known_.has(*orbit)) {
      ++report.known;
      return something_new;
    }
    something_new = true;
    if (!add(*orbit)) return something_new;
  }
  return something_new;
}

/// @returns whether it is worth while to look beside it
bool Hunt::add(const Orbit& orbit) {
  known_.add(orbit);
  if (is_multiple(problem_, orbit)) {
    ++report.shorter;
    return true;
  }
  Solution solution = describe(problem_, orbit, &system_);
  if (!solution.is_motion) {
    ++report.no_motions;
    return true;
  }
  const auto of_same_family = [&](const Solution& other) {
    return other.family > 0 && in_one_family(problem_, other.orbit, orbit);
  };
  if (solution.family > 0 && ranges::any_of(found, of_same_family)) {
    ++report.known;
    return false;
  }
  ++report.found;
  enough_ = options_.enough && options_.enough(solution);
  found.push_back(std::move(solution));
  return found.back().isolated();
}

Motion random_start(const System& system, const Starts& starts, std::mt19937& random, double spread) {
  const double phase = std::uniform_real_distribution<double>(0.0, 1.0)(random);
  return Motion(system, flow::user_state(system, starts.draw(random, spread)), Instant{}.plus(phase));
}

/// Somewhere near the mean, or far away: what a free motion is like at first may be next to rest.
Motion free_start(const System& system, const Starts& starts, std::mt19937& random, double spread) {
  const double wider = std::exp2(std::uniform_real_distribution<double>(-3.0, 3.0)(random));
  return {system, flow::user_state(system, starts.draw(random, wider * spread))};
}

/// What stands for a period of a free motion, in periods of the clock: that of its slowest oscillation without contact.
std::optional<double> free_unit(const Problem& problem, const System& system, const State& state) {
  if (!problem.free()) return std::nullopt;
  for (const NaturalMode& mode : natural_modes(system, sliding_states(system, state)))
    if (mode.oscillates()) return 2.0 * std::numbers::pi / (mode.frequency * system.period());
  return 1.0;
}

}  // namespace

SearchResult search(const Problem& problem, const System& system, const State& state, const SearchOptions& options) {
  Hunt hunt(problem, system, options);
  std::mt19937 random(options.seed);
  const Motion first(system, state);
  const Starts starts(problem.translations(), first, options.stop, free_unit(problem, system, state));
  SearchReport& report = hunt.report;
  while (report.motions < options.starts && !hunt.over()) {
    try {
      const bool nearby = report.motions == 0;
      if (problem.free())
        hunt.run_free(nearby ? first : free_start(system, starts, random, options.spread), starts.sizes());
      else
        hunt.run(nearby ? first : random_start(system, starts, random, options.spread), starts.sizes(), nearby);
    } catch (const InputError&) {  // an overlap by rounding
      ++report.broken_off;
    } catch (const NumericalError&) {
      ++report.broken_off;
    }
    ++report.motions;
    if (options.progress) options.progress(report.motions);
  }
  if (hunt.over()) report.end = hunt.end();
  ranges::stable_sort(hunt.found, {}, [](const Solution& s) {
    const Itinerary& shape = s.orbit.shape;
    return std::pair(shape.n > 0 ? shape.n : returns(shape), s.chatter ? std::numeric_limits<long>::max() : s.impacts);
  });
  return {std::move(hunt.found), report};
}

}  // namespace slapstick::orbit
