#pragma once
/// The zero of a continuous function between two places at which its signs differ.
#include <algorithm>
#include <cmath>

namespace slapstick {

/// Regula falsi; an end that stays a second time is halved in weight (Illinois). Superlinear, and never outside the
/// bracket.
/// A short step is no reason to stop: beside a value of rounding's size at an end the steps are short, and far from the
/// zero.
/// @param enough  width of the bracket after which there is nothing to gain
/// @returns a place at which the function is zero, or the end of such a bracket
template <class Function>
double bracketed_root(const Function& function, double a, double b, double enough) {
  constexpr int most_steps = 200, by_halves = 20;  // steps; from then on each halves the bracket
  double f_a = function(a), f_b = function(b);
  if (f_a == 0.0) return a;
  if (f_b == 0.0) return b;
  int stays = 0;  // the end that stayed in the last step: -1 a, +1 b
  for (int k = 1; k <= most_steps; ++k) {
    double s = k > by_halves ? 0.5 * (a + b) : (a * f_b - b * f_a) / (f_b - f_a);
    if (!(s > std::min(a, b) && s < std::max(a, b))) s = 0.5 * (a + b);
    if (s == a || s == b) return s;  // neighbours
    const double f_s = function(s);
    if (f_s == 0.0 || std::abs(b - a) <= enough) return s;
    const bool left = (f_s < 0.0) == (f_a < 0.0);
    (left ? a : b) = s;
    (left ? f_a : f_b) = f_s;
    const int staying = left ? 1 : -1;
    if (staying == stays) (left ? f_b : f_a) *= 0.5;
    stays = staying;
  }
  return a;
}

}  // namespace slapstick
