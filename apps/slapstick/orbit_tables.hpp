#pragma once
/// Branches and curves as tables of numbers, a row for each orbit: for .csv, .npz and .h5.
#include <functional>
#include <string>
#include <vector>

#include "model_options.hpp"
#include "slapstick/continuation/branch.hpp"

namespace slapstick::app {

/// Whether a path ends as a table's file does.
[[nodiscard]] bool is_table_file(const std::string& path);

/// More columns of an orbit than those that all have.
struct MoreColumns {
  std::vector<std::string> names{};
  std::function<std::vector<double>(const orbit::Solution&)> values{};
};

/// Columns: branch, point (a number; 0 of special points), type ("point", "LP", ..), the parameter, class, period,
/// largest_multiplier, stable, is_motion, the state at phase 0. In the order of the points along each branch.
void write_branches(const std::string& path, const std::vector<orbit::Branch>& branches, const std::string& parameter,
                    const orbit::Problem& problem, const ChosenModel& chosen, const MoreColumns& more);

struct CurveRows {
  std::string type;  ///< of the point that is followed
  const orbit::Problem& problem;
  const orbit::Curve& curve;
};
/// Columns: curve (the type), met ("none" or what is met), the two parameters, class, period, largest_multiplier,
/// stable, is_motion, the state. What is met has the numbers of the point before it.
void write_curves(const std::string& path, const std::vector<CurveRows>& curves, const std::vector<std::string>& names,
                  const ChosenModel& chosen);

}  // namespace slapstick::app
