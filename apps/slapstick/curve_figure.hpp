#pragma once
/// The picture of a locus in two parameters: the pieces on which the orbit is a motion, and what is met on them.
#include <string>
#include <vector>

#include "figure/figure.hpp"
#include "slapstick/continuation/branch.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick::app {

struct NamedCurve {
  std::string type;  ///< of the point that is followed
  const orbit::Curve& curve;
};

/// @param names  of the two parameters
[[nodiscard]] figure::Figure curve_figure(const std::vector<NamedCurve>& curves, const ModelDefinition& definition,
                                          const std::vector<std::string>& names);

}  // namespace slapstick::app
