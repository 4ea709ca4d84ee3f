/// Encloses power series: the table of economised powers, and sums of its rows.
#include "event/hull.hpp"

#include <algorithm>
#include <array>

#include "base/double_double.hpp"

namespace slapstick::event {
namespace {

using Monomials = std::array<DoubleDouble, 8>;

/// x^8 modulo T, T(x) = cos(16 arccos(sqrt(x))).
constexpr std::array<double, 8> x8_remainder = {-1.0 / 32768,      128.0 / 32768,    -2688.0 / 32768,
                                                21504.0 / 32768,   -84480.0 / 32768, 180224.0 / 32768,
                                                -212992.0 / 32768, 131072.0 / 32768};

/// b_j = sum_{n<=j} C(j, n) / C(7, n) p_n.
Monomials to_bernstein(const Monomials& p) {
  Monomials b{};
  for (int j = 0; j < 8; ++j) {
    DoubleDouble weight = 1.0;
    for (int n = 0; n <= j; ++n) {
      b[j] += weight * p[n];
      weight = weight * (j - n) / (7.0 - n);
    }
  }
  return b;
}

/// What one unit of a_n adds to the hull, to its truncation errors, and to its rounding errors in units of
/// noise_factor.
struct Table {
  std::array<Lane8, most_terms> bernstein{}, truncation{}, rounding{};

  Table() {
    Monomials p{1.0};
    DoubleDouble q, q1, q2;  // q_n(1) and its derivatives; zero below n = 8
    for (int n = 0; n < most_terms; ++n) {
      add(n, p, {q, q1, q2});
      const DoubleDouble leading = p[7];
      q2 += 2.0 * q1;
      q1 += q;
      q += leading;
      std::rotate(p.begin(), p.end() - 1, p.end());
      p[0] = 0.0;
      for (int j = 0; j < 8; ++j) p[j] += leading * x8_remainder[j];
    }
  }

 private:
  void add(int n, const Monomials& p, const std::array<DoubleDouble, 3>& q) {
    const auto b = to_bernstein(p);
    DoubleDouble widest;
    for (int j = 0; j < 8; ++j) {
      bernstein[n][j] = static_cast<double>(b[j]);
      widest = std::max(widest, abs(b[j]));
    }
    constexpr double up = (1.0 + 0x1p-40) / 32768;  // more than all roundings of the sums of positive terms
    truncation[n][hull_error] = up * static_cast<double>(q[0]);
    truncation[n][slope_error] = up * static_cast<double>(q[1] + 128.0 * q[0]);
    truncation[n][curvature_error] = up * static_cast<double>(q[2] + 256.0 * q[1] + 5376.0 * q[0]);
    // A coefficient b_j carries the rounding of its product (noise_factor) and of the sum that made its row (64 u <= 4
    // noise_factor); g' = 7 (b_{j+1} - b_j) .. has 14 times that, g'' = 42 (b_{j+2} - 2 b_{j+1} + b_j) .. 168 times.
    const auto w = static_cast<double>(5.0 * widest);
    rounding[n] = Lane8{w + 8.0, 14.0 * w, 168.0 * w};
    rounding[n][std::min(noise_0 + n, static_cast<int>(noise_2))] = 1.0;
    if (n >= 2) rounding[n][slope_noise] = n;
    if (n >= 2) rounding[n][curvature_noise] = n * (n - 1.0);
  }
};

const Table& table_of_powers() {
  static const Table table;
  return table;
}

}  // namespace

HullRows hull_rows(double noise_factor, Lane8* bounds) {
  const Table& table = table_of_powers();
  for (int n = 0; n < most_terms; ++n) bounds[n] = table.truncation[n] + noise_factor * table.rounding[n];
  return {table.bernstein.data(), bounds};
}

Hull enclose(const double* a, const double* size, int count, double noise_factor) {
  const Table& table = table_of_powers();
  Lane8 bernstein{}, truncation{}, rounding{};
  for (int n = 0; n < count; ++n) {
    bernstein += table.bernstein[n] * a[n];
    truncation += table.truncation[n] * size[n];
    rounding += table.rounding[n] * size[n];
  }
  return {bernstein, truncation + noise_factor * rounding};
}

}  // namespace slapstick::event
