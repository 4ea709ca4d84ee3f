#pragma once
/// Periodic orbits, stable or not: Newton's method from a guess, and what an orbit is. slapstick/orbit/search.hpp looks
/// for them.
///
/// A `Problem` is the equations of a family's orbits; it is const, and threads may share it. Orbits are data. States
/// that a user wants come from `at_phase_zero` and `events`. Newton's method costs the linearised flow of every leg a
/// step, a verification a new System and one cycle of a Motion.
/// Source: docs/developers/architecture.md, section 9; Leine and Nijmeijer (2004) for multipliers through events.
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

/// How near a cycle comes to changing its events: the least value that a guard of one kind and contact takes along it,
/// where it is not a zero that belongs to an event; and at its reversals the force that keeps it from sticking.
struct Margin {
  mode::GuardKind kind = mode::GuardKind::gap;
  int contact = 0;
  double value = 0.0;
  /// by how much the holding force exceeds static friction where the contact's slip changes its sense without stick
  bool reversal = false;
};

/// No multiplier is 1.
[[nodiscard]] inline bool isolated(const std::vector<std::complex<double>>& multipliers) {
  return std::none_of(multipliers.begin(), multipliers.end(), [](auto mu) { return std::abs(mu - 1.0) < 1e-10; });
}

struct Solution {
  Orbit orbit;
  /// Of the return map at fixed time, largest modulus first; those of directions that stick or a closed stop
  /// annihilates are exactly zero. The multiplier 1 of each rigid translation, and without forcing the one of the
  /// motion along itself, are left out. Empty where the map has no derivative (`differentiable(orbit.shape)`).
  std::vector<std::complex<double>> multipliers;
  std::string label;     ///< "1-1-II"; without forcing "free-1-II"
  long impacts = 0;      ///< per cycle; meaningless with complete chatter
  bool chatter = false;  ///< complete
  bool sticking = false;
  int sticks = 0;             ///< how often a friction contact comes to stick in a cycle
  int reversals = 0;          ///< .. or goes on slipping in the other sense
  int chatters = 0;           ///< complete ones
  double cycle = 0.0;         ///< period of the orbit, time units
  bool is_motion = false;     ///< the certified simulator does the same
  std::string why;            ///< .. or does not
  std::vector<double> drift;  ///< along rigid translations, by coordinate, per cycle; empty without such

  /// Of how many dimensions is the continuum of orbits at the same parameters that this is a member of? 0: it is
  /// isolated. A mass that sticks anywhere in an interval is one of a family of one dimension, with a multiplier 1 that
  /// leads along it (src/orbit/continuum.hpp).
  int family = 0;

  [[nodiscard]] bool isolated() const { return family == 0; }
  /// The largest modulus of the multipliers without those, nearest to 1, that lead along the family; 0 without any.
  [[nodiscard]] double largest_across() const;
  /// All multipliers are known, and inside the unit circle except those that lead along the family: a motion beside it
  /// settles on a member.
  [[nodiscard]] bool stable() const;
};

/// The class of an orbit, from its events: "1-1-II"; without forcing "free-1-II".
[[nodiscard]] std::string class_name(const Orbit& orbit);

/// What an orbit that solves its equations is. With a System of its own parameters it is verified; null: is_motion is
/// left false.
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

/// The orbit's state at the first instant of phase 0 (without forcing: just after event 0), user's coordinates: what a
/// simulation starts from. Of an unstable orbit its rounding grows by the multipliers.
/// @param period  0 .. n - 1: at that phase 0 after the first
[[nodiscard]] State at_phase_zero(const Problem& problem, const Orbit& orbit, int period = 0);

/// In order, from the end of the first leg on; none for an orbit without events.
[[nodiscard]] std::vector<EventOfOrbit> events(const Problem& problem, const Orbit& orbit);

/// The least and the largest value over a cycle, exact to rounding.
struct Range {
  double least = 0.0, most = 0.0;
};
/// Of the displacements x_1 .. x_n and then of the velocities v_1 .. v_n of the model's coordinates, both sides of
/// every impact included. A displacement that drifts counts from where the cycle begins.
[[nodiscard]] std::vector<Range> ranges(const Problem& problem, const Orbit& orbit);

[[nodiscard]] std::vector<Margin> margins(const Problem& problem, const Orbit& orbit);

}  // namespace slapstick::orbit
