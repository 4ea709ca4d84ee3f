/// Finds what is wrong with forces that press a friction contact.
#include "base/text.hpp"
#include "model/fault.hpp"

namespace slapstick {
namespace {

std::string what_is_wrong(const Force& force, const Model& model) {
  const auto contact = static_cast<std::size_t>(force.presses);
  if (contact >= model.frictions.size()) return "there is no friction contact " + std::to_string(force.presses);
  if (!model.frictions[contact].normal)
    return "friction contact " + in_quotes(model.frictions[contact].name) +
           " has fixed limits, and a force presses one with a normal force: give it normal_force = { constant = 0 }, "
           "then static and kinetic are coefficients";
  if (force.signal >= 0 && pulses(model.signals[static_cast<std::size_t>(force.signal)]))
    return "an impulse cannot press a friction contact";
  return "";
}

}  // namespace

std::optional<Fault> first_press_fault(const Model& model) {
  for (std::size_t i = 0; i < model.forces.size(); ++i) {
    if (model.forces[i].presses < 0) continue;
    if (std::string what = what_is_wrong(model.forces[i], model); !what.empty())
      return Fault{"force", static_cast<int>(i), "on", std::move(what)};
  }
  return std::nullopt;
}

}  // namespace slapstick
