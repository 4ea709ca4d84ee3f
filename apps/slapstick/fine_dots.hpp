#pragma once
/// Dots as fine as their number asks for.
#include <algorithm>
#include <cmath>
#include <vector>

#include "figure/figure.hpp"

namespace slapstick::app {

/// Few points are seen, many do not hide what they form: discs become smaller by one over the root of their number.
inline void make_dots_fine(std::vector<figure::Points>& clouds, double largest_mm = 0.7) {
  constexpr double least_mm = 0.12, of_one_mm = 14.0;
  std::size_t points = 1;
  double thickest = 0.0;
  for (const figure::Points& cloud : clouds) {
    points += cloud.x.size();
    thickest = std::max(thickest, cloud.diameter_mm);
  }
  const double wanted = std::clamp(of_one_mm / std::sqrt(static_cast<double>(points)), least_mm, largest_mm);
  for (figure::Points& cloud : clouds) cloud.diameter_mm *= wanted / thickest;
}

}  // namespace slapstick::app
