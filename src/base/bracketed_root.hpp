#pragma once
/// The zero of a continuous function between two places at which its signs differ.
#include <algorithm>
#include <cmath>

namespace slapstick {

/// Regula falsi; the end that stays is halved in weight (Illinois), and every fourth step halves the bracket.
/// Superlinear, and never outside the bracket.
/// @param enough  width of the bracket, or length of a step, after which there is nothing to gain
/// @returns a place at which the function is zero, or which the last step moved by less than `enough`
template <class Function>
double bracketed_root(const Function& function, double a, double b, double enough) {
  double f_a = function(a), f_b = function(b);
  if (f_a == 0.0) return a;
  if (f_b == 0.0) return b;
  double weight_a = 1.0, weight_b = 1.0, last = a;
  for (int k = 1; k <= 200; ++k) {
    const double w_a = weight_a * f_a, w_b = weight_b * f_b;
    double s = k % 4 == 0 ? 0.5 * (a + b) : (a * w_b - b * w_a) / (w_b - w_a);
    if (!(s > std::min(a, b) && s < std::max(a, b))) s = 0.5 * (a + b);
    const double f_s = function(s);
    if (f_s == 0.0 || std::abs(b - a) <= enough || std::abs(s - last) <= enough) return s;
    last = s;
    const bool left = (f_s < 0.0) == (f_a < 0.0);
    (left ? a : b) = s;
    (left ? f_a : f_b) = f_s;
    (left ? weight_a : weight_b) = 1.0;
    (left ? weight_b : weight_a) *= 0.5;
  }
  return last;
}

}  // namespace slapstick
