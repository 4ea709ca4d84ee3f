#pragma once
/// What can be measured on a model: one list of names for the whole program.
///
///     const auto all = quantities(model);
///     const Quantity press = find_quantity(all, "F_wall");
///
/// A contact is a stop, friction contact, compliant stop or characteristic. Its force F pulls the two sides of its pair
/// together where it is positive: -F acts on a, +F on b, as of a spring. Between impacts every quantity is a polynomial
/// of degree two in the extended state; an impact adds an impulse to the acceleration of coordinates, to the force of
/// stops and to the power that stops take. Each quantity is defined in each mode in docs/reference/measure.md.
/// Plain data; values may be shared between threads. Cost: microseconds.
/// Source: docs/developers/architecture.md, section 8; Glocker (2001) for contact forces and impulses.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "slapstick/model/model.hpp"

namespace slapstick {

struct Quantity {
  enum class Kind {
    displacement,  ///< x of a coordinate ..
    velocity,      ///< .. x'
    acceleration,  ///< .. x'', and at impacts the jumps of x' as impulses
    gap,           ///< of a stop or compliant stop: clearance - (x_a - x_b)
    relative,      ///< velocity of a contact: v_a - v_b - belt speed
    force,         ///< of a contact
    normal,        ///< force N that friction is in proportion to, not positive without a load
    power,         ///< that a contact dissipates; of a stop impulses only
    damping,       ///< power that dampers and the damping matrix dissipate
    input,         ///< power that forces and belts bring
    kinetic,       ///< energy
    potential,     ///< energy of springs, compliant stops and characteristics; forces have none
    speed,         ///< at impacts and engagements: w just before; of one stop where `index` is its number, as the next
    impulse,       ///< at impacts: of the stop
    loss,          ///< at impacts: energy lost
    flight,        ///< at impacts: time since the impact before, in forcing periods (SectionPoint::flight)
    sliding,       ///< at impacts: time of slip since then, in forcing periods
    parameter      ///< a constant
  };

  Kind kind = Kind::parameter;
  int index = -1;      ///< coordinate, or contact as in System::contact_name; behind these the springs and the dampers
  int minus = -1;      ///< the quantity is that of `index` minus that of this one, or -1
  double value = 0.0;  ///< of a parameter
  std::string name, unit, meaning;

  [[nodiscard]] bool at_impacts() const { return kind >= Kind::speed && kind <= Kind::sliding; }
};

/// "displacement", "force", "impact", ..: what kind a table or a list calls it.
[[nodiscard]] std::string_view name(Quantity::Kind kind);

/// What the quantities of a kind of part are called: the one table that names, lists and documents come from.
struct QuantityRule {
  enum class Of {
    coordinate,
    stop,
    friction,
    compliant_stop,
    characteristic,
    spring,
    damper,
    model,
    impacts,
    impacts_of_one
  };
  Of of = Of::model;
  Quantity::Kind kind = Quantity::Kind::parameter;
  /// With NAME for the part's name; velocity and acceleration of a coordinate x1 are v1 and a1.
  std::string_view name, meaning;
};
[[nodiscard]] std::span<const QuantityRule> quantity_rules();
[[nodiscard]] std::string_view name(QuantityRule::Of of);

/// Everything that can be measured on a model, in the order coordinates, contacts, energies, impacts; no units.
[[nodiscard]] std::vector<Quantity> quantities(const Model& model);

/// The quantity of a name, or of "A-B" for two of one kind: "x1-x2", "a1-a2".
/// @throws InputError that names the nearest
[[nodiscard]] Quantity find_quantity(const std::vector<Quantity>& all, const std::string& name);

}  // namespace slapstick
