#pragma once
/// Periodic orbits, stable or not: Newton's method from a guess, what an orbit is, and a search for many.
#include <algorithm>
#include <complex>
#include <functional>
#include <memory>
#include <optional>

#include "slapstick/flow/stage.hpp"
#include "slapstick/model/family.hpp"
#include "slapstick/orbit/itinerary.hpp"

namespace slapstick::orbit {

class Problem;  // the equations of a family's orbits

/// @throws InputError as the family and System
[[nodiscard]] std::shared_ptr<const Problem> pose(const Family& family, const std::vector<double>& values);

/// Where the energy of a cycle comes from and goes, in the model's units. `input` - all sinks = 0 but for rounding.
struct Energy {
  double input = 0.0;            ///< by forces and belts
  double damping = 0.0;          ///< in dampers, the damping matrix and compliant stops
  std::vector<double> friction;  ///< in each friction contact
  std::vector<double> impacts;   ///< in each stop, by the first of those that are struck together
  [[nodiscard]] double balance() const;
};

/// How near a cycle comes to changing its events: the least value that a guard of one kind and contact takes along it, where it is not a zero
/// that belongs to an event; and at its reversals the force that keeps it from sticking.
struct Margin {
  mode::GuardKind kind = mode::GuardKind::gap;
  int contact = 0;
  double value = 0.0;
  bool reversal =
      false;  ///< by how much the holding force exceeds static friction where the contact's slip changes its sense without stick
};

/// No multiplier is 1.
[[nodiscard]] inline bool isolated(const std::vector<std::complex<double>>& multipliers) {
  return std::ranges::none_of(multipliers, [](auto mu) { return std::abs(mu - 1.0) < 1e-10; });
}

struct Solution {
  Orbit orbit;
  /// Of the return map at fixed time, largest modulus first; those of directions that stick or a closed stop annihilates are exactly zero. The
  /// multiplier 1 of each rigid translation, and without forcing the one of the motion along itself, are left out.
  std::vector<std::complex<double>> multipliers;
  std::string label;     ///< "1-1-II"; without forcing "free-1-II"
  long impacts = 0;      ///< per cycle; meaningless with complete chatter
  bool chatter = false;  ///< complete
  bool sticking = false;
  double cycle = 0.0;         ///< period of the orbit, time units
  bool is_motion = false;     ///< the certified simulator does the same
  std::string why;            ///< .. or does not
  std::vector<double> drift;  ///< along rigid translations, by coordinate, per cycle; empty without such

  /// False for one of a family at the same parameters, as of a mass that sticks anywhere in an interval.
  [[nodiscard]] bool isolated() const { return orbit::isolated(multipliers); }
  [[nodiscard]] bool stable() const { return multipliers.empty() || std::abs(multipliers.front()) < 1.0; }
};

/// What an orbit that solves its equations is. With a System of its own parameters it is verified; null: is_motion is left false.
[[nodiscard]] Solution describe(const Problem& problem, Orbit orbit, const System* system);

/// Newton's method at fixed parameters from an approximate orbit; the sequence of events is the guess's.
/// @param besides  orbits that it shall not come to (deflation); those of other shapes are of no effect
/// @returns empty if it does not converge
[[nodiscard]] std::optional<Orbit> refine(const Problem& problem, Orbit guess, const std::vector<Orbit>& besides = {});

/// An event of an orbit, with the state just before it.
struct EventOfOrbit {
  EventKind kind = EventKind::impact;
  int contact = 0;  ///< System::contact_name
  double t = 0.0;   ///< as Orbit::t
  double w = 0.0;   ///< relative velocity of the contact's pair just before
  State before;     ///< user's coordinates
  mode::ContactStates after;
};

/// The orbit's state at the first instant of phase 0 (without forcing: just after event 0), user's coordinates: what a simulation starts from. Of an
/// unstable orbit its rounding grows by the multipliers.
[[nodiscard]] State at_phase_zero(const Problem& problem, const Orbit& orbit);

/// In order, from the end of the first leg on; none for an orbit without events.
[[nodiscard]] std::vector<EventOfOrbit> events(const Problem& problem, const Orbit& orbit);

[[nodiscard]] Energy energy(const Problem& problem, const Orbit& orbit);
[[nodiscard]] std::vector<Margin> margins(const Problem& problem, const Orbit& orbit);

struct SearchOptions {
  int most_n = 1;                  ///< forcing periods per cycle, all up to this; ignored without forcing
  std::optional<int> only_n = {};  ///< .. or this only
  int starts = 64;                 ///< motions that are looked through for near returns
  int periods = 200;               ///< length of each
  std::uint32_t seed = 1;
  double spread = 1.0;  ///< starts are this many times the size of the first motion around it
  const std::atomic<bool>* stop = nullptr;
  std::function<void(int starts)> progress = {};
  std::function<bool(const Solution&)> enough = {};  ///< ends the search with the first orbit for which it is true
};

/// Looks for orbits: from motions that start at `state` and around it, every near return is refined. No proof of completeness.
/// @returns distinct orbits that are motions, by n and impacts
[[nodiscard]] std::vector<Solution> search(const Problem& problem, const System& system, const State& state,
                                           const SearchOptions& options);

/// The orbit that the motion from `state` settles on after so many periods, if Newton's method from there finds one.
/// @param n  forcing periods per cycle; 0: the least up to 64 for which the motion nearly returns
[[nodiscard]] std::optional<Solution> settle(const Problem& problem, const System& system, const State& state,
                                             long transient, int n, const std::atomic<bool>* stop = nullptr);
/// The same from where a motion of the problem's own parameters stands.
[[nodiscard]] std::optional<Solution> settle(const Problem& problem, Motion motion, long transient, int n,
                                             const std::atomic<bool>* stop = nullptr);

}  // namespace slapstick::orbit
