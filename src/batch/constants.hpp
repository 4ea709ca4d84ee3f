#pragma once
/// Numbers of the batch kernels that no model changes: the series' length, the window it carries, economised powers,
/// bounds of rounding. docs/developers/proofs.md, section 11, derives them.
#include <array>

#include "base/double_double.hpp"

namespace slapstick::batch {
namespace {

inline constexpr int terms = 32;  ///< Taylor coefficients of a window

inline constexpr int most_economized = 20;  ///< of these the first are economised

/// A window's length times the rate of its mode: longest_window^32 / 32! < 2^-55, so that what the series leaves
/// out, at most 1 / (1 - longest_window / 33) times that, is below 2^-54 of the norm.
inline constexpr double longest_window = 3.875;
/// More than (exp(longest_window) - 1) times a fraction of the window: by convexity exp(z h) <= 1 + h (exp(z) - 1).
inline constexpr double growth = 47.2;

inline constexpr double unit = 0x1p-53;
/// Of a step of the recurrence of derivatives: products of up to 2 n + k + 1 = 13 words, each with three roundings
/// of its own, in units of the norm.
inline constexpr double step_rounding = 20.0 * unit;
inline constexpr double dropped = 0x1p-54;
/// Of the Bernstein coefficients, their halvings and values, in units of the sum of the sizes of the polynomial's
/// coefficients.
inline constexpr double hull_rounding = 0x1.4p-47;

/// 1/n, 1/n!, the powers x^n modulo the Chebyshev polynomial of degree 8 (event/hull.hpp), the error of that on [0, 1],
/// and 1/C(7, n).
struct Tables {
  double inverse[terms] = {};
  double inverse_factorial[terms + 1] = {};
  double economized[terms][8] = {};
  double error[terms] = {};
  double to_bernstein[8] = {};

  constexpr Tables() {
    DoubleDouble factorial = 1.0;
    for (int n = 0; n <= terms; ++n) {
      if (n > 0) factorial = factorial * static_cast<double>(n);
      inverse_factorial[n] = static_cast<double>(DoubleDouble(1.0) / factorial);
    }
    for (int n = 1; n < terms; ++n) inverse[n] = 1.0 / n;
    economize();
    double binomial = 1.0;
    for (int n = 0; n < 8; ++n) {
      to_bernstein[n] = 1.0 / binomial;
      binomial = binomial * (7 - n) / (n + 1);
    }
  }

 private:
  constexpr void economize() {
    constexpr std::array<double, 8> x8_remainder = {-1.0 / 32768,      128.0 / 32768,    -2688.0 / 32768,
                                                    21504.0 / 32768,   -84480.0 / 32768, 180224.0 / 32768,
                                                    -212992.0 / 32768, 131072.0 / 32768};
    std::array<DoubleDouble, 8> p{1.0};
    DoubleDouble q;
    for (int n = 0; n < terms; ++n) {
      double size = 0.0;
      for (std::size_t j = 0; j < 8; ++j) {
        economized[n][j] = static_cast<double>(p[j]);
        size += economized[n][j] < 0.0 ? -economized[n][j] : economized[n][j];
      }
      error[n] = n < 8 ? 0.0 : static_cast<double>(q) / 32768 * (1.0 + 0x1p-40) + 64.0 * unit * size;
      const DoubleDouble leading = p[7];
      q = q + leading;
      for (std::size_t j = 7; j > 0; --j) p[j] = p[j - 1];
      p[0] = 0.0;
      for (std::size_t j = 0; j < 8; ++j) p[j] = p[j] + leading * x8_remainder[j];
    }
  }
};
inline constexpr Tables tables;

}  // namespace
}  // namespace slapstick::batch
