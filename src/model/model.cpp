/// Validates models and states, and names the numbers of a state.
#include "slapstick/model/model.hpp"

#include <algorithm>
#include <numbers>

#include "model/fault.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {

bool Model::forced() const {
  return std::any_of(forces.begin(), forces.end(), [](const Force& force) { return force.harmonic > 0; });
}

double Model::forcing_period() const { return forced() ? 2.0 * std::numbers::pi / omega : 1.0; }

std::string velocity_name(const std::string& coordinate) {
  const bool numbered = !coordinate.empty() && coordinate.front() == 'x';
  std::string name = numbered ? "v" : "v_";
  return name.append(coordinate, numbered ? 1 : 0, std::string::npos);
}

std::vector<std::string> state_names(const Model& model) {
  std::vector<std::string> names;
  for (const auto& coordinate : model.coordinates) {
    names.push_back(coordinate.name);
    names.push_back(velocity_name(coordinate.name));
  }
  return names;
}

void validate(const Model& model) {
  if (const auto fault = first_fault(model)) throw InputError(fault->place(model) + ": " + fault->what);
}

void validate(const Model& model, const State& state) {
  if (const auto fault = first_fault(model, state)) throw InputError("state: " + fault->what);
}

}  // namespace slapstick
