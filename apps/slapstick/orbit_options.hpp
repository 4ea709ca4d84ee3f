#pragma once
/// What `orbit`, `continue` and `curve` share: which orbit is meant, how it is found, and how it is written down.
#include <optional>
#include <string>
#include <vector>

#include "model_options.hpp"
#include "slapstick/io/json.hpp"
#include "slapstick/orbit/periodic_orbit.hpp"
#include "verb.hpp"

namespace slapstick::app {

struct OrbitOptions {
  std::string orbit;                ///< --orbit N-P
  long long transient = 500;        ///< --transient
  long long starts = 64, seed = 1;  ///< --starts, --seed

  void declare(Arguments& arguments);
};

/// The parts of --orbit "N-P"; P may be "inf" (complete chatter) or left out.
struct OrbitClass {
  int n = 0;              ///< 0: any
  std::optional<long> p;  ///< none: any
  bool chatter = false;
  [[nodiscard]] bool admits(const orbit::Solution& solution) const;
};
/// @throws InputError naming --orbit
[[nodiscard]] OrbitClass parse_orbit(const std::string& text);

struct ParameterRange {
  double from = 0.0, to = 0.0;
};
/// Reads "A:B", A < B. @throws InputError naming the argument
[[nodiscard]] ParameterRange parse_range(const std::string& argument, const std::string& text);

/// The value that a parameter or group has by --set or default. @throws InputError naming the argument if there is none (the nearest is
/// suggested), or the members of the group have several
[[nodiscard]] double present_value(const ChosenModel& chosen, const std::string& argument,
                                   const std::string& parameter);

/// The same inside a range. @throws InputError if it is outside, or the range is not within the parameter's own
[[nodiscard]] double value_inside(const ChosenModel& chosen, const std::string& argument, const std::string& parameter,
                                  const ParameterRange& range);

/// The orbit that is meant: the one that the motion from the start settles on if it is of the class, else the first of that class that a search
/// finds. @throws NumericalError saying what was tried and found instead
[[nodiscard]] orbit::Solution find_orbit(const orbit::Problem& problem, const System& system, const State& start,
                                         const OrbitOptions& options, const std::atomic<bool>& stop);

/// "class", "n", "p", "sticking", "stable", "multipliers", "period", ..
[[nodiscard]] Json solution_json(const orbit::Solution& solution);
/// The same and "state": an orbit of a branch or curve.
[[nodiscard]] Json point_json(const orbit::Problem& problem, const orbit::Solution& solution, const Model& model);
/// A state by name, as --state takes it.
[[nodiscard]] Json state_json(const State& state, const Model& model);
/// The impacts of a cycle and its events. @param system of the orbit's parameters
[[nodiscard]] Json impacts_json(const orbit::Problem& problem, const orbit::Solution& solution, const System& system);
[[nodiscard]] Json events_json(const orbit::Problem& problem, const orbit::Solution& solution, const System& system);
[[nodiscard]] Json energy_json(const orbit::Energy& energy, const Model& model);
[[nodiscard]] Json margins_json(const std::vector<orbit::Margin>& margins, const System& system);

}  // namespace slapstick::app
