#pragma once
/// The window of every lane as power series in x = s / (scale H): displacements, velocities, streams, and the rows
/// of the slots.
#include "batch/block.hpp"
#include "batch/constants.hpp"
#include "batch/lane_type.hpp"

namespace slapstick::batch {
namespace {

/// sin and cos of 2 pi j t for 0 <= t <= 1 and a whole j, within 4 units of 2^-53 of one: Taylor's series on an eighth
/// of a turn. t is split in two, so that j t less its whole turns is rounded as a part of an eighth only.
template <class Real>
SLAPSTICK_INLINE void sine_cosine(const Real& t, double j, Real& sine, Real& cosine) {
  const Real high = nearest(t * 0x1p26) * 0x1p-26, turns = high * j, low = (t - high) * j, rest = turns - nearest(turns);
  const Real quarter = nearest((rest + low) * 4.0);
  const Real r = ((rest - quarter * 0.25) + low) * 0x1.921fb54442d18p+2, z = r * r;
  Real s = z * -0x1.ae7f3e733b81fp-41 + 0x1.6124613a86d09p-33;
  s = s * z - 0x1.ae64567f544e4p-26;
  s = s * z + 0x1.71de3a556c734p-19;
  s = s * z - 0x1.a01a01a01a01ap-13;
  s = s * z + 0x1.1111111111111p-7;
  s = s * z - 0x1.5555555555555p-3;
  s = s * z * r + r;
  Real c = z * 0x1.ae7f3e733b81fp-45 - 0x1.93974a8c07c9dp-37;
  c = c * z + 0x1.1eed8eff8d898p-29;
  c = c * z - 0x1.27e4fb7789f5cp-22;
  c = c * z + 0x1.a01a01a01a01ap-16;
  c = c * z - 0x1.6c16c16c16c17p-10;
  c = c * z + 0x1.5555555555555p-5;
  c = c * z - 0x1.0000000000000p-1;
  c = c * z + 1.0;
  const Real q = quarter - 4.0 * floor_of(quarter * 0.25);  // 0, 1, 2, 3
  const auto one = equal(q, Real{} + 1.0), two = equal(q, Real{} + 2.0), three = equal(q, Real{} + 3.0);
  const Real a = choose(one | three, c, s), b = choose(one | three, s, c);
  sine = choose(two | three, -a, a);
  cosine = choose(one | two, -b, b);
}

/// The values of `count` series sum_m a_m x^m at one place, in even and odd parts, side by side: each waits for
/// itself only. A function of its own: gcc 12 would keep what two calls load in memory beside where it is.
template <int count, class Real>
static __attribute__((noinline)) void values_at(const Real (*a)[terms], const Real& x, Real (&value)[count]) {
  const Real z = x * x;
  Real even[count], odd[count];
  for (int i = 0; i < count; ++i) {
    even[i] = a[i][terms - 2];
    odd[i] = a[i][terms - 1];
  }
#pragma GCC unroll 16
  for (int m = terms - 3; m > 0; m -= 2)
    for (int i = 0; i < count; ++i) {
      odd[i] = odd[i] * z + a[i][m];
      even[i] = even[i] * z + a[i][m - 1];
    }
  for (int i = 0; i < count; ++i) value[i] = odd[i] * x + even[i];
}

/// Value, first and half the second derivative: with p = e(z) + x o(z), z = x^2,
///     p' = 2 x e' + o + 2 z o',      p'' / 2 = e' + 2 z e'' + 3 x o' + 2 x z o''.
template <class Real>
struct Jet {
  Real value, slope, half_bend;
};
template <class Real>
static __attribute__((noinline)) void jet_at(const Real* a, const Real& x, Jet<Real>& jet) {
  const Real z = x * x;
  Real e = a[terms - 2], o = a[terms - 1], e1 = Real{}, o1 = Real{}, e2 = Real{}, o2 = Real{};
  for (int m = terms - 3; m > 0; m -= 2) {
    e2 = e2 * z + e1;
    o2 = o2 * z + o1;
    e1 = e1 * z + e;
    o1 = o1 * z + o;
    o = o * z + a[m];
    e = e * z + a[m - 1];
  }
  jet = {o * x + e, (x + x) * (x * o1 + e1) + o, e1 + 3.0 * x * o1 + 4.0 * z * (x * o2 + e2)};
}

/// Derivatives in x of all numbers at the start, divided by m!: y^(m+1) from y^(m) by the mode's rows.
template <int width, int n>
struct Window {
  using Real = typename Lanes<width>::Real;
  using Mask = typename Lanes<width>::Mask;

  Real p[2 * n][terms];        ///< of p, then of scale H u
  Real stream[most_streams][terms];
  Real scale, H;  ///< H times scale
  Real size;      ///< the norm of the state

  static inline __attribute__((always_inline)) Real word(const Block& block, int i) { return load<Real>(block.active[i]); }

  __attribute__((noinline)) void make(const Block& block) {
    const Layout& at = block.layout;
    scale = load<Real>(block.scale);
    H = word(block, Layout::window) * scale;
    Real force[n][terms];
    make_streams(block, force);
    Real p0[n], u0[n];
    const Real inverse_speed = word(block, Layout::inverse_speed);
    size = word(block, Layout::least_size);
    for (int i = 0; i < n; ++i) {
      p0[i] = load<Real>(block.p[i]);
      u0[i] = load<Real>(block.u[i]);
      size = larger(size, larger(magnitude(p0[i]), magnitude(u0[i]) * inverse_speed));
      u0[i] = u0[i] * H;
    }
    recur(block, at, p0, u0, force);
  }

 private:
  /// f^(m+2) = -(j omega H)^2 f^(m); and what the streams do to each row.
  __attribute__((always_inline)) void make_streams(const Block& block, Real (*force)[terms]) {
    const Layout& at = block.layout;
    const Real phase = load<Real>(block.fraction), square = scale * scale;
    for (int s = 0; s < at.k; ++s) {
      Real sine, cosine;
      sine_cosine(phase, static_cast<double>(block.harmonic[s]), sine, cosine);
      const Real rate = word(block, Layout::rates + s) * scale, bend = -(rate * rate);
      const bool turned = block.cosine[s] != 0;
      Real even = turned ? cosine : sine, odd = turned ? -(sine * rate) : cosine * rate;
      Real share[n];
      for (int i = 0; i < n; ++i) share[i] = word(block, at.row(i) + 2 * n + s) * square;
      for (int m = 0; m < terms; m += 2) {
        stream[s][m] = even * tables.inverse_factorial[m];
        stream[s][m + 1] = odd * tables.inverse_factorial[m + 1];
        for (int i = 0; i < n; ++i) {
          force[i][m] = s == 0 ? share[i] * even : force[i][m] + share[i] * even;
          force[i][m + 1] = s == 0 ? share[i] * odd : force[i][m + 1] + share[i] * odd;
        }
        even = even * bend;
        odd = odd * bend;
      }
    }
    for (int i = 0; i < n; ++i) {
      if (at.k == 0)
        for (int m = 0; m < terms; ++m) force[i][m] = Real{};
      force[i][0] = force[i][0] + word(block, at.row(i) + at.row_size() - 1) * square;
    }
  }

  __attribute__((always_inline)) void recur(const Block& block, const Layout& at, Real (&dp)[n], Real (&du)[n], Real (*force)[terms]) {
    Real K[n][n], C[n][n];
    const Real square = scale * scale;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        K[i][j] = word(block, at.row(i) + j) * square;
        C[i][j] = word(block, at.row(i) + n + j) * scale;
      }
    for (int m = 0; m < terms; ++m) {
      Real a[n];
      for (int i = 0; i < n; ++i) {
        p[i][m] = dp[i] * tables.inverse_factorial[m];
        p[n + i][m] = du[i] * tables.inverse_factorial[m];
        Real still = force[i][m], moving = C[i][0] * du[0];
        for (int j = 0; j < n; ++j) still = still + K[i][j] * dp[j];
        for (int j = 1; j < n; ++j) moving = moving + C[i][j] * du[j];
        a[i] = still + moving;
      }
      for (int i = 0; i < n; ++i) {
        dp[i] = m == 0 ? du[i] + word(block, at.drift(i)) * scale : du[i];
        du[i] = a[i];
      }
    }
  }
};

}  // namespace
}  // namespace slapstick::batch
