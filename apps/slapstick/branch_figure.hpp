#pragma once
/// Branches as a picture: impact speeds over the parameter, stable solid, unstable dashed, special points marked and named.
#include <string>
#include <vector>

#include "slapstick/figure/figure.hpp"
#include "slapstick/orbit/branch.hpp"

namespace slapstick::app {

[[nodiscard]] figure::Figure branch_figure(const std::vector<orbit::Branch>& branches, const std::string& parameter,
                                           const orbit::Problem& problem);

}  // namespace slapstick::app
