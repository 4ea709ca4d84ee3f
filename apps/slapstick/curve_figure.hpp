#pragma once
/// The picture of a locus in two parameters: the pieces on which the orbit is a motion, and what is met on them.
#include <string>
#include <vector>

#include "figure/figure.hpp"
#include "slapstick/io/model_file.hpp"
#include "slapstick/continuation/branch.hpp"

namespace slapstick::app {

/// @param names  of the two parameters
/// @param type   of the point that is followed
[[nodiscard]] figure::Figure curve_figure(const orbit::Curve& curve, const ModelDefinition& definition,
                                          const std::vector<std::string>& names, const std::string& type);

}  // namespace slapstick::app
