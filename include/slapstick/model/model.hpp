#pragma once
/// A mechanical oscillator with dry friction and stops, as plain data.
///
///     M x'' + C x' + K x = sum forces + friction + stop forces + compliant stops + characteristics,
///
/// M, C, K: the coordinates' masses, the dampers and the springs, plus the model's own matrices.
/// Nothing here assumes a number of coordinates or contacts. Units are the user's; the paper's system is dimensionless.
/// Plain data: no function but `validate` throws. Source: docs/reference/notation.md; Glocker (2001) for contacts.
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace slapstick {

/// The index that stands for the fixed surroundings: ground, wall, or (with a belt speed) a belt.
inline constexpr int ground = -1;

/// A displacement x with its mass (>= 0; the sum with the mass matrix must be positive definite). The velocity is
/// called "v" + the rest of the name if the name starts with 'x' (x1 -> v1), else "v_" + name.
///
/// An *inner* coordinate s has no mass, and nothing but its element acts on it. That of a spring (Spring::inner) is on
/// dampers to ground that add up to c > 0: c s' is the spring's force. That of a characteristic is a slider.
struct Coordinate {
  std::string name;
  double mass = 1.0;
};

/// The forces of a model that stand for the motion of a base at the end of a spring or damper: its own force is
/// stiffness * (x_a - x_b) less those of them that act on a (on b, where a is ground: and more).
struct BaseMotion {
  int first = 0, count = 0;  ///< among the model's forces
  [[nodiscard]] bool none() const { return count == 0; }
};

/// By what the displacements of the two ends of a link are multiplied, as by gears, levers, a rack and its pinion: it
/// acts on y = a x_a - b x_b, and a force F of the link pulls with a F at its one end and with b F at the other. Where
/// the texts below say x_a - x_b and v_a - v_b, they mean y and y'.
struct Ratio {
  double a = 1.0, b = 1.0;
  friend bool operator==(const Ratio&, const Ratio&) = default;
};

/// Force stiffness * (x_a - x_b) pulling a and b together; stiffness may be any finite number.
/// With an inner coordinate s in series with it the force is stiffness * (x_a - x_b - s), stiffness > 0: a Maxwell
/// element.
struct Spring {
  int a = 0, b = ground;
  double stiffness = 0.0;
  std::string name = {};  ///< of the quantities of this spring; "": it has none
  BaseMotion motion = {};
  Ratio ratio = {};
  int inner = -1;  ///< index of an inner coordinate, or -1
};

/// Force coefficient * (v_a - v_b); coefficient >= 0, or of either sign for one that may feed energy.
struct Damper {
  int a = 0, b = ground;
  double coefficient = 0.0;
  bool feeds = false;
  std::string name = {};  ///< as of a spring
  BaseMotion motion = {};
  Ratio ratio = {};
};

/// amplitude * sin(harmonic * omega * t + phase) on one coordinate; harmonic 0 is a constant force of size `amplitude`.
/// With a frequency of its own it is amplitude * sin(frequency * t + phase) instead, and with a signal amplitude times
/// that signal, or times its rate of change. The harmonic is 0 then. Where the signal has a pulse the force is a blow:
/// it gives its coordinate the momentum amplitude times the pulse's area.
struct Force {
  int coordinate = 0;
  int harmonic = 1;
  double amplitude = 0.0;
  double phase = 0.0;
  double frequency = 0.0;  ///< rad per unit of time; 0: none
  int signal = -1;         ///< index of a signal, or -1
  bool rate = false;       ///< its rate of change
  /// Index of a friction contact to whose normal force it adds, in place of acting on a coordinate; or -1.
  int presses = -1;
  /// Index of a friction contact whose force it is a part of, beside the friction; or -1. Such a force is constant, and
  /// acts on an end of the contact. So a freewheel has one limit in one sense and another in the other.
  int contact = -1;
};

/// A function of time that is given by points and straight lines between them, as a measurement is. Before the first
/// and after the last point it stays as it is there; one that repeats is periodic instead, also before its first point.
/// Two points at one time are a step: from that time on it has the second value. One that repeats with another last
/// value than its first steps there too.
/// At a point there may be a pulse too, the limit of one that is short and high: it takes no time, and has an area.
struct Signal {
  struct Knot {
    double time = 0.0, value = 0.0;
    double pulse = 0.0;  ///< its area; such a point shares its time with no other, and is no end of a round
  };
  std::string name;
  std::vector<Knot> knots;  ///< at least two, `time` ascending
  bool repeats = false;
  /// The times are in forcing periods, from the first to the last knot one period, from knot to knot 31/32 of one
  /// at most: such a signal is a drive, as a harmonic is. Such a signal repeats.
  bool in_periods = false;
  /// Its pulses are jumps of the speed of what coordinates are measured from, by which a closed stop is hit. Else they
  /// are blows of a force, which a closed stop bears.
  bool kinematic = false;
};

/// A normal force that is linear in the state: constant + sum (stiffness x_i + damping v_i) + the force of a compliant
/// stop + the forces that press the contact (Force::presses). Where the sum is negative there is no normal force, and
/// no friction.
struct NormalForce {
  struct Term {
    int coordinate = 0;
    double stiffness = 0.0, damping = 0.0;
  };
  double constant = 0.0;
  std::vector<Term> terms;
  int compliant_stop = -1;  ///< index of a compliant stop, or -1
};

/// Coulomb friction on w = v_a - v_b - belt_speed. Slip: force -sgn(w) * kinetic_friction on a, the opposite on b.
/// Stick: any force up to static_friction. static_friction >= kinetic_friction >= 0.
/// With a normal force N the two are coefficients of friction: the forces are theirs times N. Constant forces may be a
/// part of what it does (Force::contact).
struct FrictionContact {
  std::string name;
  int a = 0, b = ground;
  double belt_speed = 0.0;
  double static_friction = 0.0;
  double kinetic_friction = 0.0;
  std::optional<NormalForce> normal = std::nullopt;
  Ratio ratio = {};
};

/// A rigid stop that demands x_a - x_b <= clearance; Newton impact with restitution in [0, 1].
/// A wall below a coordinate is {a = ground, b = coordinate}: -x_b <= clearance.
struct Stop {
  std::string name;
  int a = 0, b = ground;
  double clearance = 0.0;
  double restitution = 1.0;
  /// Restitution over the impact speed, constant beyond both ends: `restitution` is that below the first corner.
  struct Corner {
    double speed = 0.0, restitution = 0.0;
  };
  std::vector<Corner> corners = {};
  Ratio ratio = {};
};

/// Restitution of an impact at speed v, and d(r v)/dv there (of the piece above, at a corner).
struct Rebound {
  double restitution = 0.0, rate = 0.0;
};
[[nodiscard]] Rebound rebound(const Stop& stop, double speed);
/// Derivative of the restitution at this speed, `rate` the derivative of the stop's numbers.
[[nodiscard]] double rebound_rate(const Stop& stop, const Stop& rate, double speed);

/// A spring and damper that act only beyond a gap, delta = x_a - x_b - clearance > 0: force stiffness delta + damping
/// delta' on b, the opposite on a. One that does not pull lets go where that force would become negative. The damping
/// force of one that is `bounded` is no larger than the force of its spring, either way: its force is 0 to 2 stiffness
/// delta, and continuous.
struct CompliantStop {
  std::string name;
  int a = 0, b = ground;
  double clearance = 0.0;
  double stiffness = 0.0;
  double damping = 0.0;
  bool pulls = false;
  bool bounded = false;
  Ratio ratio = {};
};

/// A force that is a polyline over the relative displacement x_a - x_b or the relative velocity v_a - v_b, continuous
/// at its corners, pulling a and b together where it is positive. Slopes may be of either sign.
/// Below the first corner and above the last one the force goes on with the slopes given.
///
/// Over `zones` of the displacement the force is coefficient * (v_a - v_b) instead, with a coefficient for each zone;
/// the force jumps at a corner. `force` of a corner is the coefficient above it, slope_below that below the first.
///
/// With an inner coordinate s and two corners it is a Jenkins element: over x_a - x_b - s, flat outside the corners.
/// Between them s rests. At a corner s follows x_a - x_b until the motion turns back, so that the force stays.
struct Characteristic {
  enum class Over : std::uint8_t { displacement, velocity, zones };
  struct Corner {
    double at = 0.0, force = 0.0;
  };
  std::string name;
  int a = 0, b = ground;
  Over over = Over::displacement;
  std::vector<Corner> corners;  ///< at least one, `at` ascending
  double slope_below = 0.0, slope_above = 0.0;
  Ratio ratio = {};
  int inner = -1;  ///< index of an inner coordinate, or -1
};

/// By what x_i is multiplied in the y of a link.
template <class Link>
[[nodiscard]] double share(const Link& link, int i) {
  return i == ground ? 0.0 : (link.a == i ? link.ratio.a : 0.0) - (link.b == i ? link.ratio.b : 0.0);
}

/// Is y another number than a difference of coordinates?
template <class Link>
[[nodiscard]] bool has_ratio(const Link& link) {
  const auto other = [](int end, double by) { return end != ground && std::abs(by) != 1.0; };
  return other(link.a, link.ratio.a) || other(link.b, link.ratio.b);
}

/// Do two links act on one y, or on opposite ones (-1)? Else 0.
template <class Link, class Other>
[[nodiscard]] int same_pair(const Link& link, const Other& other) {
  const int ends[] = {link.a, link.b, other.a, other.b};
  bool same = true, opposite = true;
  for (const int i : ends) {
    same = same && share(link, i) == share(other, i);
    opposite = opposite && share(link, i) == -share(other, i);
  }
  return same ? 1 : opposite ? -1 : 0;
}

/// y (order 0) or y' (1) of a link at a user's state (x_1, v_1, x_2, v_2, ..).
template <class Link>
[[nodiscard]] double relative(const Link& link, const std::vector<double>& state, std::size_t order) {
  const auto part = [&](int end, double by) {
    return end == ground ? 0.0 : by * state[2 * static_cast<std::size_t>(end) + order];
  };
  return part(link.a, link.ratio.a) - part(link.b, link.ratio.b);
}
/// |a x_a| + |b x_b|, the size of the terms of y.
template <class Link>
[[nodiscard]] double relative_size(const Link& link, const std::vector<double>& state) {
  const auto part = [&](int end, double by) {
    return end == ground ? 0.0 : std::abs(by * state[2 * static_cast<std::size_t>(end)]);
  };
  return part(link.a, link.ratio.a) + part(link.b, link.ratio.b);
}

/// What happens when several stops are hit or touched at one instant.
enum class ImpactLaw : std::uint8_t {
  moreau,    ///< all at once: 0 <= P, v+ + r v- <= 0 (v towards the stop), complementary, over the stops in contact
  sequence,  ///< one after another by Newton's law, in the order of the model, until none approaches
};

/// A symmetric n x n matrix by rows, or empty for zero.
using SymmetricMatrix = std::vector<double>;

struct Model {
  std::string name;
  std::vector<Coordinate> coordinates;
  std::vector<Spring> springs;
  std::vector<Damper> dampers;
  std::vector<Force> forces;
  std::vector<FrictionContact> frictions;
  std::vector<Stop> stops;
  std::vector<CompliantStop> compliant_stops;
  std::vector<Characteristic> characteristics;
  std::vector<Signal> signals;
  SymmetricMatrix mass, damping, stiffness;  ///< added to what coordinates, dampers and springs give
  ImpactLaw impact_law = ImpactLaw::moreau;
  double omega = 0.0;  ///< forcing frequency; 0 only if no force has a harmonic > 0 or a signal in periods
  /// For the engine: the contact that numbers each pair of bodies (mode/numbering.hpp). Empty for the nearest ones. All
  /// models of a family of orbits have the same, so that a state's numbers mean the same at all values.
  std::vector<int> numbered_by = {};

  [[nodiscard]] int size() const { return static_cast<int>(coordinates.size()); }
  /// Is this coordinate an inner one (Coordinate)?
  [[nodiscard]] bool is_inner(int coordinate) const;
  /// 2 pi / omega, or 1 for a model that is not forced.
  [[nodiscard]] double forcing_period() const;
  /// Does this force repeat with the forcing: has it a harmonic > 0, or a signal in periods?
  [[nodiscard]] bool repeats_with_forcing(const Force& force) const;
  /// Does a force press this friction contact?
  [[nodiscard]] bool is_pressed(int friction) const;
  /// True if some force does: only then are there stroboscopic maps and n-p classes.
  [[nodiscard]] bool forced() const;
  /// False if a force has a frequency of its own, or another signal: then no motion comes back after whole periods.
  [[nodiscard]] bool periodic() const;
};

/// A state in the user's coordinates, interleaved: x_1, v_1, x_2, v_2, ... (2n numbers), as in tables and `--state`.
using State = std::vector<double>;

/// Column names of a State: "x1", "v1", "x2", "v2".
[[nodiscard]] std::vector<std::string> state_names(const Model& model);

/// Checks everything that makes a model meaningless: non-finite numbers; masses <= 0 (a mass matrix that is not
/// positive definite); matrices that are not symmetric or not n x n; omega; f_k > f_s; restitution outside [0, 1]; bad
/// indices; a contact between a coordinate and itself; opposite stops without room between them; names used twice.
/// Numbers beyond 1e50, and a mass or omega below 1e-50, are refused too: their products would leave the range of a
/// double.
/// @throws InputError naming the field, e.g. "stop 'gap': restitution = 1.2 is outside [0, 1]".
void validate(const Model& model);

/// @throws InputError for a model that is not periodic, with what can be asked of such a model instead
void demand_period(const Model& model);

/// Checks a start: 2n finite numbers of at most 1e50, and no stop violated.
/// @throws InputError naming the coordinate or stop.
void validate(const Model& model, const State& state);

}  // namespace slapstick
