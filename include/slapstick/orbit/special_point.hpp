#pragma once
/// Points of a branch at which something changes: what happens, where, and what becomes of the branch there. All of it
/// is data: enumerations and numbers; sentences are made by continuation/sentences.hpp.
#include <optional>
#include <string_view>
#include <vector>

#include "slapstick/orbit/periodic_orbit.hpp"

namespace slapstick::orbit {

/// Named as AUTO and MATCONT name them where they have a name: the first four leave the events as they are, the others
/// change them.
enum class SpecialType : std::uint8_t {
  LP,  ///< fold: the branch turns back in the parameter
  PD,  ///< period doubling: a multiplier -1
  NS,  ///< torus (Neimark-Sacker): a pair of multipliers e^{+-2 pi i rho}
  BP,  ///< branch point: branches cross, a symmetry breaks
  GR,  ///< graze: a stop is touched, or an impact's speed has gone to zero
  SL,  ///< sliding: stick is gained or lost
  CH,  ///< onset of a complete chatter
  CO   ///< two events meet
};
[[nodiscard]] std::string_view name(SpecialType type);
/// Is it one of GR, SL, CH, CO?
[[nodiscard]] constexpr bool changes_events(SpecialType type) { return type >= SpecialType::GR; }

/// What happens at a special point.
enum class Occurrence : std::uint8_t {
  fold,             ///< LP
  doubling,         ///< PD: a doubled orbit begins
  end_of_doubled,   ///< PD, seen from the doubled orbit: the branch leaves the shorter orbit that doubles
  torus,            ///< NS
  crossing,         ///< BP
  broken_symmetry,  ///< BP: the two sides of the crossing branch are images of one another
  margin,           ///< GR, SL, CH, CO: a margin of the orbit is used up, `SpecialPoint::margin`
  release,          ///< CH: a contact that has rested lets go, into a complete chatter
  onset,            ///< CH: infinitely many changes gather, each with an impact more
  death             ///< SL, CO: legs shrink to nothing together
};
[[nodiscard]] std::string_view name(Occurrence occurrence);

/// Which margin: a smooth function that is positive for a motion (docs/developers/architecture.md, section 9).
struct UsedMargin {
  enum class Kind : std::uint8_t {
    least,     ///< the least value of a guard along a leg
    speed,     ///< how fast the guard that ends a leg falls through zero; of a gap: the speed of the impact
    duration,  ///< a leg's length
    /// by how much the holding force exceeds static friction at a reversal, or what holds a contact where a point of a
    /// signal lets it go
    no_stick
  };
  Kind kind = Kind::least;
  std::size_t leg = 0;                           ///< of `SpecialPoint::solution.orbit`
  mode::GuardKind guard = mode::GuardKind::gap;  ///< kind least, speed: whose value; duration: what ends the leg
  int contact = 0;                               ///< of the guard, among contacts of its kind
  bool at_start = false;                         ///< kind least: the least value lies at the leg's start
};
[[nodiscard]] std::string_view name(UsedMargin::Kind kind);

/// How the sliding of a friction contact changes (di Bernardo et al. 2008, section 8.2).
enum class Sliding : std::uint8_t {
  unchanged,  ///< or not to be told
  crossing,   ///< a stick between two slips of opposite senses comes or goes
  grazing,    ///< a stick, or a reversal and back, within a slip
  switching,  ///< a reversal before a stick, or after it
  adding      ///< a slip within a stick
};
[[nodiscard]] std::string_view name(Sliding sliding);

/// What becomes of a branch at a special point.
enum class Passage : std::uint8_t {
  same_events,   ///< LP, PD, NS, BP: the branch goes on with the events that it has
  persistence,   ///< the branch goes on with other events, in the same sense of the parameter
  fold,          ///< .. or back: a non-smooth fold
  jump,          ///< no orbit goes on: the motion leaves, `SpecialPoint::jump`
  family,        ///< the orbits beyond are isolated no more: one of a family
  cascade,       ///< one of infinitely many changes that gather at the onset of a chatter
  merges,        ///< the orbit becomes a shorter one, run through more than once
  equilibrium,   ///< the orbit shrinks to a state of rest, at a corner of a characteristic
  symmetric,     ///< the orbit becomes its own image: beyond it are the images of the branch's orbits
  retraced,      ///< the branch turns back onto its own orbits
  not_followed,  ///< the events change, and the caller wanted them to stay
  unknown        ///< no orbit was found beyond: a jump, or a failure of the search
};
[[nodiscard]] std::string_view name(Passage passage);
/// Does the branch go on beyond a change of events, as one branch?
[[nodiscard]] constexpr bool goes_on(Passage passage) {
  return passage == Passage::persistence || passage == Passage::fold;
}

/// Where the motion goes in a jump.
struct Jump {
  enum class Kind : std::uint8_t {
    settles,  ///< on the orbit of class `label`
    wanders,  ///< on no periodic orbit within `cycles` cycles
    departs   ///< of an unstable orbit: motions to either side differ within a cycle, however near they are
  };
  Kind kind = Kind::departs;
  std::string label;  ///< "1-2-I"
  long cycles = 0;
};
[[nodiscard]] std::string_view name(Jump::Kind kind);

/// The first coefficient beyond the linear terms: LP a, PD c, NS l1 (docs/explanation/continuation.md).
struct NormalForm {
  enum class Verdict : std::uint8_t {
    none,  ///< not asked for
    fold,  ///< LP: the coefficient has no sign
    supercritical,
    subcritical,
    not_simple,      ///< no coefficient: the critical multiplier is not that of a simple eigenvector
    resonance,       ///< .. a strong resonance 1:m is near
    other_critical,  ///< .. another multiplier is near the unit circle
    too_inexact,     ///< .. its error is too large
    no_map           ///< .. a leg of a motion beside the orbit does not end
  };
  Verdict verdict = Verdict::none;
  std::optional<double> coefficient = {};
  double error = 0.0;  ///< of the coefficient
  int resonance = 0;   ///< verdict resonance: m
};
[[nodiscard]] std::string_view name(NormalForm::Verdict verdict);

/// What is left of legs that have shrunk to nothing: guards that are zero at one instant, within a leg or at an end.
struct Touch {
  struct Guard {
    mode::GuardKind kind = mode::GuardKind::gap;
    int contact = 0;  ///< among contacts of its kind
  };
  enum class Place : std::uint8_t { start, within, end };
  Place place = Place::within;
  std::size_t leg = 0;
  double t = 0.0;             ///< the instant, in periods, as those of the orbit's events
  std::vector<Guard> guards;  ///< of the leg's mode; of the first the derivative is zero too where the place is within
};

/// Where legs shrink to nothing together: the orbit without them, and its touches.
struct Death {
  Orbit orbit;
  std::vector<Touch> touches;
};

struct SpecialPoint {
  SpecialType type = SpecialType::LP;
  double value = 0.0;          ///< of the parameter
  double error = 0.0;          ///< of it: the last change of the refinement, or what rounding leaves
  Solution solution;           ///< the orbit there; where legs die one beside it, with these legs
  std::optional<Death> death;  ///< where legs shrink to nothing, as far as that is what makes its equations singular

  Occurrence occurrence = Occurrence::fold;
  UsedMargin margin;                     ///< occurrence margin; death: a leg's length
  Sliding sliding = Sliding::unchanged;  ///< type SL
  bool chatter_begins = false;           ///< occurrence margin, type CH: and a complete chatter begins
  double cascade_ratio = 0.0;            ///< occurrence onset: of the distances of neighbouring changes, if measured

  Passage passage = Passage::same_events;
  std::optional<Jump> jump;  ///< passage jump

  double rotation = 0.0;  ///< NS: rho in (0, 1/2)
  /// Orbits from which other branches that begin here or cross can be followed; with passages merges and symmetric the
  /// first is that in which the branch ends.
  std::vector<Orbit> born;
  std::size_t after = 0;  ///< the special point lies after this point of the branch
  std::size_t test = 0;   ///< GR, SL, CH, CO: the index of the margin among all margins of the orbit

  NormalForm normal_form;  ///< of LP, PD, NS
};

/// The events of the orbit at a special point that meet, or that the margin belongs to: indices of legs, each of which
/// such an event ends. Two for a leg that shrinks to nothing: what ends the leg before it, and what ends it.
[[nodiscard]] std::vector<std::size_t> events_at(const SpecialPoint& point);
/// The contacts that take part, as System::contact_name numbers them, each once.
[[nodiscard]] std::vector<int> contacts_at(const SpecialPoint& point, const Model& model);

}  // namespace slapstick::orbit
