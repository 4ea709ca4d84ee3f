#pragma once
/// Branches as a picture: impact speeds over the parameter, stable solid, unstable dashed, a colour and a number for
/// each branch, a marker for each special point, over the motions that settle, if there are some. The legend stands
/// below. Where a branch has no impacts it is drawn at speed 0; if nothing has impacts, the first coordinate at the
/// events is drawn. Axes have units where the model's file states them.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "figure/figure.hpp"
#include "settled_motions.hpp"
#include "slapstick/continuation/branch.hpp"

namespace slapstick::app {

struct BranchAxes {
  std::string x_label;
  ParameterRange range;      ///< what is shown of the parameter
  std::string speed, place;  ///< units of the impact speeds, and of the first coordinate; empty: not stated
  std::string y_label = {};  ///< of `y`
  std::function<double(const orbit::Solution&)> y = {};  ///< what is drawn instead, if there is one
  std::optional<ParameterRange> y_range = {};            ///< what is shown of `y`; none: all
};

[[nodiscard]] figure::Figure branch_figure(const std::vector<orbit::Branch>& branches, const BranchAxes& axes,
                                           const orbit::Problem& problem, const SettledMotions& beneath);

}  // namespace slapstick::app
