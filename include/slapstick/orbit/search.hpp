#pragma once
/// Which periodic orbit is meant, and looking for it: the one that a motion settles on, and a search from many motions.
///
///     OrbitChoice choice;                 // the 1-1 orbits without stick that are unstable
///     choice.n = 1, choice.p = 1, choice.sticking = false, choice.stable = false;
///     const Chosen chosen = choose(*problem, system, state, choice);
///     if (chosen.orbit) ..; else chosen.settled and chosen.search say what was tried
///
/// Everything here may be called from several threads, each with a Problem and a System of its own or shared. The same
/// arguments give the same bits as long as no deadline (`until`) ends the work; where one did, the results say so.
#include <chrono>

#include "slapstick/orbit/periodic_orbit.hpp"

namespace slapstick::orbit {

using Deadline = std::chrono::steady_clock::time_point;

/// Conditions on an orbit; those that are left empty admit any.
struct OrbitChoice {
  std::optional<int> n;          ///< forcing periods per cycle; of a free motion `returns`
  std::optional<long> p;         ///< impacts per cycle, and no complete chatter
  std::optional<bool> chatter;   ///< complete: p is infinite
  std::optional<bool> sticking;  ///< class n-p-II, or n-p-I
  std::optional<bool> stable;
  /// Its own mirror image, or its own, half a period later (of a free motion half a cycle; src/orbit/same_motion.hpp).
  std::optional<bool> symmetric;
  std::optional<State>
      nearest;  ///< an order: of the orbits that are found, the one with the least `distance` from this

  /// Does an orbit meet the conditions?
  [[nodiscard]] bool admits(const Problem& problem, const Solution& solution) const;
  /// No condition and no order: what a motion settles on is meant.
  [[nodiscard]] bool none() const;
};

/// How far an orbit is from a state, at the nearest of its instants of phase 0 and modulo translations, in the norm of
/// kinetic energy:
///     |(dx, dv)|^2 = omega^2 dx^T M dx + dv^T M dv
/// Of a free motion at the nearest of 64 instants of each leg; omega is then that of the cycle.
[[nodiscard]] double distance(const Problem& problem, const Orbit& orbit, const State& state);

/// Is an orbit its own image half a forcing period later, mirrored or not? Of a free motion half a cycle later,
/// mirrored.
[[nodiscard]] bool symmetric(const Problem& problem, const Orbit& orbit);

struct SettleOptions {
  long transient = 500;       ///< forcing periods (returns of a free motion) that are left out first
  int most_periods = 20'000;  ///< .. and how many are then looked through for a return, as `classify` does
  int most_n = 64;            ///< longest cycle, forcing periods or returns
  const std::atomic<bool>* stop = nullptr;
  std::optional<Deadline> until = {};
};

enum class SettleEnd : std::uint8_t {
  orbit,     ///< an orbit is found
  no_cycle,  ///< the motion does not come back to itself
  rest,      ///< .. because a free motion has no more events
  no_orbit,  ///< the motion settles on a cycle whose equations were not solved, or that the simulator does not confirm
  time,
  stopped
};

struct Settled {
  std::optional<Solution> orbit;
  SettleEnd end = SettleEnd::no_cycle;
  int n = 0;         ///< of the cycle, where there is one
  long periods = 0;  ///< that the motion was followed
};

/// The orbit that the motion from `state` settles on: the cycle that `classify` names (both ask section::Settling),
/// solved and verified. One of a family stays the member that it is.
/// @throws InputError if the state is no state of the model; NumericalError as Motion::advance
[[nodiscard]] Settled settle(const Problem& problem, const System& system, const State& state,
                             const SettleOptions& options = {});

/// Newton's method from where a motion of the problem's own parameters stands after so much time: for an orbit whose
/// motion is known to be near.
/// @param n forcing periods per cycle; 0: the least up to 64 for which the motion nearly returns
[[nodiscard]] std::optional<Solution> orbit_near(const Problem& problem, Motion motion, long transient, int n,
                                                 const std::atomic<bool>* stop = nullptr);

struct SearchOptions {
  int most_n = 1;                  ///< forcing periods per cycle, all up to this; of free motions `returns`
  std::optional<int> only_n = {};  ///< .. or this only
  int starts = 64;                 ///< motions that are looked through for near returns
  int periods = 200;               ///< length of each; of free motions events, twice as many
  std::uint32_t seed = 1;
  /// Starts are about this many times the ranges of the first motion around its mean; of free motions up to eight times
  /// more or less, because they may have come to rest.
  double spread = 1.0;
  const std::atomic<bool>* stop = nullptr;
  std::optional<Deadline> until = {};
  std::function<void(int starts)> progress = {};
  std::function<bool(const Solution&)> enough = {};  ///< ends the search with the first orbit for which it is true
};

enum class SearchEnd : std::uint8_t {
  all_starts,  ///< every motion was looked through
  enough,
  time,  ///< `until` came first: another machine may find more, or less
  stopped
};

/// What a search tried. newton_runs = diverged + known + shorter + no_motions + found.
struct SearchReport {
  SearchEnd end = SearchEnd::all_starts;
  int motions = 0;     ///< looked through
  int broken_off = 0;  ///< .. of these, those that could not be followed to their end
  long returns = 0;    ///< near returns
  long newton_runs = 0;
  long diverged = 0;    ///< Newton's method found no orbit
  long known = 0;       ///< .. one that was found before, or another member of its family
  long shorter = 0;     ///< .. a shorter one several times over
  long no_motions = 0;  ///< .. one that the simulator does not confirm
  long found = 0;
  long other = 0;  ///< of the found, those that the choice does not admit (choose)
};

struct SearchResult {
  std::vector<Solution> orbits;  ///< distinct, motions all, by n and impacts
  SearchReport report;
};

/// Looks for orbits. The first motion starts at `state` at phase 0, and Newton's method is tried from there in any
/// case; the others start at random phases and admissible states around the mean of the first. Every near return is
/// refined. No proof of completeness. A family (Solution::family) is listed once, by the first member that is found.
[[nodiscard]] SearchResult search(const Problem& problem, const System& system, const State& state,
                                  const SearchOptions& options);

/// What was chosen, and what was tried for it.
struct Chosen {
  std::optional<Solution> orbit;
  Settled settled;
  bool settles = false;                ///< the motion settles on the orbit
  std::optional<SearchReport> search;  ///< none: there was none
  std::vector<Solution> others;        ///< found, but not chosen
};

/// The orbit that is meant: without a transient the one that `state` lies on, to 1e-3 of its size, stable or not; else
/// the one that the motion settles on, if it is admitted; else what a search finds first. With
/// `nearest` the search goes to its end, and the least distance wins.
[[nodiscard]] Chosen choose(const Problem& problem, const System& system, const State& state, const OrbitChoice& choice,
                            const SettleOptions& settling = {}, SearchOptions searching = {});

}  // namespace slapstick::orbit
