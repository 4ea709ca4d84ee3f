/// Lays out the corners of a Stribeck law.
///
/// A chord over a piece of length h is off by |g''| h^2 / 8, so that pieces with equal integrals D of sqrt|g''| are off
/// by the same (D / K)^2 / 8, K their number; beyond the last corner the polyline is off by g there.
#include "io/stribeck_law.hpp"

#include <algorithm>
#include <cmath>

#include "base/elementary.hpp"

namespace slapstick {
namespace {

/// g = exp(-x): sqrt(g) falls by the same step U / K from corner to corner, and (1 - U)^2 = (U / K)^2 / 2.
StribeckFall exponential(int corners) {
  const double U = 1.0 / (1.0 + 1.0 / (corners * std::sqrt(2.0)));
  StribeckFall fall;
  for (int j = 1; j <= corners; ++j) {
    const double root = 1.0 - j * U / corners;
    fall.at.push_back(-2.0 * fixed::ln(root));
    fall.left.push_back(root * root);
  }
  return fall;
}

/// With s = x^(e/2), g = exp(-s^2) and D = 2 / sqrt(e) times the integral of exp(-s^2 / 2) sqrt|e s^2 - (e - 1)|.
StribeckFall power_law(int corners, double e) {
  constexpr double step = 1.0 / 512.0, end = 7.0;  // g(7) = 5e-22; a step moves corners, and adds to no error
  const auto left = [](double s) { return fixed::exp(-s * s); };
  std::vector<double> D = {0.0};
  const auto reached = [&](double of) { return left(static_cast<double>(D.size() - 1) * step) <= of * of / 8.0; };
  while (!reached(D.back() / corners) && static_cast<double>(D.size()) * step < end) {
    const double s = (static_cast<double>(D.size()) - 0.5) * step;
    const double density = fixed::exp(-0.5 * s * s) * std::sqrt(std::abs(e * s * s - (e - 1.0)));
    D.push_back(D.back() + 2.0 / std::sqrt(e) * density * step);
  }
  StribeckFall fall;
  for (int j = 1; j <= corners; ++j) {
    const double wanted = D.back() * j / corners;
    const auto above = std::min(std::lower_bound(D.begin() + 1, D.end(), wanted), D.end() - 1);
    const double s = step * (static_cast<double>(above - D.begin()) - (*above - wanted) / (*above - above[-1]));
    fall.at.push_back(fixed::power(s, 2.0 / e));
    fall.left.push_back(left(s));
  }
  return fall;
}

/// How far a chord is off at most between x0 and x1, where the slope g' = -e x^(e-1) g is monotone: where both slopes
/// agree, if they do.
double chord_error(double e, double begin, double g_begin, double slope, double x0, double x1) {
  const auto g = [&](double x) { return fixed::exp(-fixed::power(x, e)); };
  const auto steeper = [&](double x) { return -e * fixed::power(x, e - 1.0) * g(x) < slope; };
  const auto off = [&](double x) { return std::abs(g_begin + slope * (x - begin) - g(x)); };
  const double inside = 1e-9 * (x1 - x0);  // the slope at x = 0 is infinite for e < 1
  const bool at_first = steeper(x0 + inside);
  double low = x0 + inside, high = x1;
  if (at_first == steeper(x1)) return std::max(off(low), off(high));
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (steeper(middle) == at_first ? low : high) = middle;
  }
  return off(low);
}

double largest_error(const StribeckFall& fall, double e) {
  const double bend = e > 1.0 ? fixed::power((e - 1.0) / e, 1.0 / e) : 0.0;  // g'' = 0
  double most = fall.left.back();
  for (std::size_t j = 0; j < fall.at.size(); ++j) {
    const double x0 = j == 0 ? 0.0 : fall.at[j - 1], g0 = j == 0 ? 1.0 : fall.left[j - 1], x1 = fall.at[j];
    const double slope = (fall.left[j] - g0) / (x1 - x0), middle = std::clamp(bend, x0, x1);
    if (middle > x0) most = std::max(most, chord_error(e, x0, g0, slope, x0, middle));
    if (middle < x1) most = std::max(most, chord_error(e, x0, g0, slope, middle, x1));
  }
  return most;
}

}  // namespace

StribeckFall stribeck_fall(int corners, double exponent) {
  StribeckFall fall = exponent == 1.0 ? exponential(corners) : power_law(corners, exponent);
  fall.error = largest_error(fall, exponent);
  return fall;
}

}  // namespace slapstick
