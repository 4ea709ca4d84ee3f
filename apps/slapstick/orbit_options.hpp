#pragma once
/// What `orbit`, `continue` and `curve` share besides the orbit that they begin with: the parameter and its range, and
/// how orbits are written down.
#include <optional>
#include <string>
#include <vector>

#include "io/json.hpp"
#include "model_options.hpp"
#include "slapstick/orbit/periodic_orbit.hpp"
#include "slapstick/quantity/cycle_energy.hpp"
#include "verb.hpp"

namespace slapstick::app {

struct ParameterRange {
  double from = 0.0, to = 0.0;
};
/// Reads "A:B", A < B. @throws InputError naming the argument
[[nodiscard]] ParameterRange parse_range(const std::string& argument, const std::string& text);

/// The value that a parameter or group has by --set or default. @throws InputError naming the argument if there is no
/// such parameter or group (the nearest is suggested), or the members of the group have several
[[nodiscard]] double present_value(const ChosenModel& chosen, const std::string& argument,
                                   const std::string& parameter);

/// The same inside a range. @throws InputError if it is outside, or the range is not within the parameter's own
[[nodiscard]] double value_inside(const ChosenModel& chosen, const std::string& argument, const std::string& parameter,
                                  const ParameterRange& range);

/// Why there are no multipliers.
inline constexpr const char* no_derivative = "contacts that act on each other meet their events at one instant";

/// "class", "n", "p", "sticking", "stable", "multipliers", "period", ..
[[nodiscard]] Json solution_json(const orbit::Solution& solution);
/// The same and "state": an orbit of a branch or curve.
[[nodiscard]] Json point_json(const orbit::Problem& problem, const orbit::Solution& solution, const Model& model);
/// A state by name, as --state takes it.
[[nodiscard]] Json state_json(const State& state, const Model& model);
/// The impacts of a cycle and its events. @param system of the orbit's parameters
[[nodiscard]] Json impacts_json(const orbit::Problem& problem, const orbit::Solution& solution, const System& system);
[[nodiscard]] Json events_json(const orbit::Problem& problem, const orbit::Solution& solution, const System& system);
/// The least and the largest value of each number of the state over the cycle: "x": {"min": .., "max": ..}.
[[nodiscard]] Json extremes_json(const orbit::Problem& problem, const orbit::Solution& solution, const Model& model);
[[nodiscard]] Json energy_json(const CycleEnergy& energy, const Model& model);
[[nodiscard]] Json margins_json(const std::vector<orbit::Margin>& margins, const System& system);

}  // namespace slapstick::app
