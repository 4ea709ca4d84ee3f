#pragma once
/// Names of a model as the text of a picture, in gnuplot's enhanced notation.
#include <string>

#include "slapstick/io/model_file.hpp"

namespace slapstick::app {

/// Literally: an underscore stays one.
[[nodiscard]] std::string axis_text(const std::string& name);
/// A parameter by its symbol: omega as the Greek letter, k_c as k with an index, "damping_ratio" as "damping ratio".
[[nodiscard]] std::string parameter_symbol(const std::string& name);
/// A parameter, or group of parameters of one unit, with its unit: "speed [mm/s]".
[[nodiscard]] std::string parameter_axis(const ModelDefinition& definition, const std::string& name);
/// As a symbol: x1 as x_{1}, the velocity v_u1 as v_{u_{1}}; else as axis_text.
[[nodiscard]] std::string axis_symbol(const std::string& name);

}  // namespace slapstick::app
