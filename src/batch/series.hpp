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
  const Real high = nearest(t * 0x1p26) * 0x1p-26, turns = high * j, low = (t - high) * j,
             rest = turns - nearest(turns);
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

/// The values of `count` series sum_m a_m x^m, m < terms, at one place, in even and odd parts, side by side: each
/// waits for itself only. A function of its own: gcc 12 would keep what two calls load in memory beside where it is.
template <int count, class Real>
static __attribute__((noinline)) void values_at(const Real (*a)[terms + 1], const Real& x, Real (&value)[count]) {
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

/// The same of m <= terms, and their derivatives: with a = e(z) + x o(z), z = x^2,  a' = 2 x e' + o + 2 z o'.
template <int count, class Real>
static __attribute__((noinline)) void values_and_slopes_at(const Real (*a)[terms + 1], const Real& x,
                                                           Real (&value)[count], Real (&slope)[count]) {
  const Real z = x * x;
  Real e[count], o[count], e1[count], o1[count];
  for (int i = 0; i < count; ++i) {
    e1[i] = a[i][terms];
    e[i] = a[i][terms] * z + a[i][terms - 2];
    o1[i] = Real{};
    o[i] = a[i][terms - 1];
  }
#pragma GCC unroll 16
  for (int m = terms - 3; m > 0; m -= 2)
    for (int i = 0; i < count; ++i) {
      o1[i] = o1[i] * z + o[i];
      e1[i] = e1[i] * z + e[i];
      o[i] = o[i] * z + a[i][m];
      e[i] = e[i] * z + a[i][m - 1];
    }
  for (int i = 0; i < count; ++i) {
    value[i] = o[i] * x + e[i];
    slope[i] = (x + x) * (x * o1[i] + e1[i]) + o[i];
  }
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

/// Taylor coefficients of the displacements p, from p^(m+2) by the mode's rows. The velocities' are not kept:
/// H u = p' - drift.
template <int width, int n>
struct Window {
  using Real = typename Lanes<width>::Real;
  using Mask = typename Lanes<width>::Mask;

  Real p[n][terms + 1];
  Real start[n], drift[n];                                         ///< scale H u at the start; p' = scale H u + drift
  Real even[most_streams], odd[most_streams], bend[most_streams];  ///< f^(2j) = even bend^j, f^(2j+1) = odd bend^j
  Real scale, H;                                                   ///< H times scale
  Real size;                                                       ///< the norm of the state

  static inline __attribute__((always_inline)) Real word(const Block& block, int i) {
    return load<Real>(block.active[i]);
  }

  __attribute__((always_inline)) void make(const Block& block) {
    block.layout.k <= 1 ? expand<1>(block) : expand<most_streams>(block);
  }

  /// p and u at x.
  __attribute__((always_inline)) void state_at(const Real& x, Real (&p_at)[n], Real (&u_at)[n]) const {
    const Real inverse = 1.0 / H;
    values_and_slopes_at<n>(p, x, p_at, u_at);
    for (int i = 0; i < n; ++i) u_at[i] = (u_at[i] - drift[i]) * inverse;
  }

 private:
  template <int k>
  __attribute__((noinline)) void expand(const Block& block) {
    const Layout& at = block.layout;
    scale = load<Real>(block.scale);
    H = word(block, Layout::window) * scale;
    const Real inverse_speed = word(block, Layout::inverse_speed);
    size = word(block, Layout::least_size);
    for (int i = 0; i < n; ++i) {
      const Real p0 = load<Real>(block.p[i]), u0 = load<Real>(block.u[i]);
      size = larger(size, larger(magnitude(p0), magnitude(u0) * inverse_speed));
      p[i][0] = p0;
      start[i] = u0 * H;
      drift[i] = word(block, at.drift(i)) * scale;
    }
    start_streams<k>(block);
    recur<k>(block);
  }

  /// Streams that the model does not have are zero.
  template <int k>
  __attribute__((always_inline)) void start_streams(const Block& block) {
    for (int s = 0; s < k; ++s) {
      even[s] = odd[s] = bend[s] = Real{};
      if (s >= block.layout.k) continue;
      const Real sine = load<Real>(block.sine[s]), cosine = load<Real>(block.cosine[s]);
      const Real rate = word(block, Layout::rates + s) * scale;
      const bool turned = block.cosine_of[s] != 0;
      even[s] = turned ? cosine : sine;
      odd[s] = turned ? -(sine * rate) : cosine * rate;
      bend[s] = -(rate * rate);
    }
  }

  template <int k>
  __attribute__((always_inline)) void recur(const Block& block) {
    const Layout& at = block.layout;
    const Real square = scale * scale;
    Real K[n][n], C[n][n], share[n][k], dp[n], du[n], f_even[k], f_odd[k];
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        K[i][j] = word(block, at.row(i) + j) * square;
        C[i][j] = word(block, at.row(i) + n + j) * scale;
      }
      for (int s = 0; s < k; ++s) share[i][s] = s < at.k ? word(block, at.row(i) + 2 * n + s) * square : Real{};
      dp[i] = p[i][0];
      du[i] = start[i];
    }
    for (int s = 0; s < k; ++s) {
      f_even[s] = even[s];
      f_odd[s] = odd[s];
    }
    // u^(m+1) = K p^(m) + C u^(m) + F f^(m); then p^(m+1) = u^(m)
    const auto step = [&](int m, const Real(&f)[k]) __attribute__((always_inline)) {
      Real a[n];
      for (int i = 0; i < n; ++i) {
        p[i][m] = dp[i] * tables.inverse_factorial[m];
        Real still = share[i][0] * f[0], moving = C[i][0] * du[0];
        for (int s = 1; s < k; ++s) still = still + share[i][s] * f[s];
        if (m == 0) still = still + word(block, at.row(i) + at.row_size() - 1) * square;
        for (int j = 0; j < n; ++j) still = still + K[i][j] * dp[j];
        for (int j = 1; j < n; ++j) moving = moving + C[i][j] * du[j];
        a[i] = still + moving;
      }
      for (int i = 0; i < n; ++i) {
        dp[i] = du[i];
        du[i] = a[i];
      }
    };
    step(0, f_even);
    for (int i = 0; i < n; ++i) dp[i] = dp[i] + drift[i];
    step(1, f_odd);
    for (int m = 2; m < terms; m += 2) {
      for (int s = 0; s < k; ++s) {
        f_even[s] = f_even[s] * bend[s];
        f_odd[s] = f_odd[s] * bend[s];
      }
      step(m, f_even);
      step(m + 1, f_odd);
    }
    for (int i = 0; i < n; ++i) p[i][terms] = dp[i] * tables.inverse_factorial[terms];
  }
};

}  // namespace
}  // namespace slapstick::batch
