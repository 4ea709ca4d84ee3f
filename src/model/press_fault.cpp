/// Finds what is wrong with forces that press a friction contact, or are a part of what one does.
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "model/fault.hpp"

namespace slapstick {
namespace {

std::string no_contact(int number) { return "there is no friction contact " + std::to_string(number); }

/// Of one that presses.
std::string wrong_press(const Force& force, const Model& model) {
  const auto contact = static_cast<std::size_t>(force.presses);
  if (contact >= model.frictions.size()) return no_contact(force.presses);
  if (!model.frictions[contact].normal)
    return "friction contact " + in_quotes(model.frictions[contact].name) +
           " has fixed limits, and a force presses one with a normal force: give it normal_force = { constant = 0 }, "
           "then static and kinetic are coefficients";
  if (force.signal >= 0 && pulses(model.signals[static_cast<std::size_t>(force.signal)]))
    return "an impulse cannot press a friction contact";
  return "";
}

bool is_constant(const Force& force) {
  return force.harmonic == 0 && force.frequency == 0.0 && force.signal < 0 && force.presses < 0 && force.phase == 0.0;
}

/// The smallest constant force that is no part of a contact's, or fixed limit of another contact; infinite without any.
double least_constant(const Model& model) {
  double least = std::numeric_limits<double>::infinity();
  const auto note = [&](double size) {
    if (size != 0.0) least = std::min(least, std::abs(size));
  };
  std::vector<bool> in_parts(model.frictions.size(), false);
  for (const Force& force : model.forces)
    if (force.contact >= 0 && static_cast<std::size_t>(force.contact) < in_parts.size())
      in_parts[static_cast<std::size_t>(force.contact)] = true;
    else if (is_constant(force))
      note(force.amplitude);
  for (std::size_t i = 0; i < model.frictions.size(); ++i)
    if (!in_parts[i] && !model.frictions[i].normal) note(model.frictions[i].kinetic_friction);
  return least;
}

/// Of a part of a contact's force: the parts act as -F on a and F on b.
std::string wrong_part(const Force& force, const Model& model) {
  const auto number = static_cast<std::size_t>(force.contact);
  if (number >= model.frictions.size()) return no_contact(force.contact);
  const FrictionContact& contact = model.frictions[number];
  const std::string rule = "a part of a contact's force is constant, and acts on each end of the contact as -F and F";
  if (!is_constant(force)) return rule;
  double on_a = 0.0, on_b = 0.0;
  int parts = 0;
  for (const Force& other : model.forces) {
    if (other.contact != force.contact) continue;
    ++parts;
    (other.coordinate == contact.a ? on_a : on_b) += other.amplitude;
    if (other.coordinate != contact.a && other.coordinate != contact.b) return rule;
  }
  const int ends = (contact.a >= 0 ? 1 : 0) + (contact.b >= 0 ? 1 : 0);
  const double left = on_a / contact.ratio.a + on_b / contact.ratio.b;
  // Both are products of one number by a ratio: each is rounded once, and their quotients once more.
  return parts == ends && (ends < 2 || std::abs(left) <= 0x1p-50 * std::abs(on_a / contact.ratio.a)) ? "" : rule;
}

/// In a sum with it, constants below 2^-47 of it are rounding (mode::drop_rounding): it is not so large that they lose
/// more than a millionth.
std::string too_large_a_part(const Force& force, const Model& model) {
  constexpr double most_over_other_constants = 0x1p27;
  const double least = least_constant(model);
  if (std::abs(force.amplitude) <= most_over_other_constants * least) return "";
  return "holds is so large that the digits of the constant force " + shown(least) +
         " are lost beside it: a hundred times the largest force holds as well";
}

}  // namespace

std::optional<Fault> first_press_fault(const Model& model) {
  for (std::size_t i = 0; i < model.forces.size(); ++i) {
    const Force& force = model.forces[i];
    std::string what = force.presses >= 0 ? wrong_press(force, model) : "";
    if (what.empty() && force.contact >= 0) what = wrong_part(force, model);
    if (what.empty() && force.contact >= 0) what = too_large_a_part(force, model);
    if (!what.empty()) return Fault{"force", static_cast<int>(i), "on", std::move(what)};
  }
  return std::nullopt;
}

}  // namespace slapstick
