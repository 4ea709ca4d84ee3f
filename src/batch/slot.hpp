#pragma once
/// A slot in a window: is it clear of both limits, and if not, where does it first come to one? The hull of
/// event/hull.hpp for all lanes at once.
#include "batch/series.hpp"

namespace slapstick::batch {
namespace {

template <int width>
struct SlotWindow {
  using Real = typename Lanes<width>::Real;
  using Mask = typename Lanes<width>::Mask;

  Real series[terms + 2];  ///< with a zero of its order at the start divided out
  Mask first, second;      ///< order at least one, at least two
  Mask there, doubtful;    ///< the lane's mode has this slot; it starts in doubt or outside its limits
  Real lower, upper, size, noise;  ///< size: no value is more; noise: a bound of the series' errors
  Real P[8], error;        ///< of the polynomial of degree 7 that is near, and how near
  Mask undecided, hit;
  Real side, limit;        ///< the slot is limit - side v; side 1: the upper limit, -1: the lower
  Real end, root;          ///< of the part of the window that is decided; about where the hull vanishes

  template <int n>
  __attribute__((noinline)) void make(const Block& block, const Window<width, n>& window, int s) {
    const Layout& at = block.layout;
    const auto word = [&](int which) { return load<Real>(block.active[at.slot_number(s, which)]); };
    lower = word(Layout::lower);
    upper = word(Layout::upper);
    size = word(Layout::norm) * window.size;
    there = less(Real{}, size);
    make_series(block, window, at.slot(s));
    find_orders(window.scale, word(Layout::start_norm) * window.size);
    make_hull();
    decide();
    find_root();
  }

  /// About the slot's value v at x.
  __attribute__((always_inline)) Real about(const Real& x) const {
    Real value = P[7];
    for (int j = 6; j >= 0; --j) value = value * x + P[j];
    return value * choose(first, choose(second, x * x, x), Real{} + 1.0);
  }

  /// The lower polynomial limit - side P - error at x.
  __attribute__((always_inline)) Real above(const Real& x) const {
    Real value = P[7];
    for (int j = 6; j >= 0; --j) value = value * x + P[j];
    return (limit - side * value) - error;
  }

 private:
  template <int n>
  __attribute__((always_inline)) void make_series(const Block& block, const Window<width, n>& window, int row) {
    const Layout& at = block.layout;
    const Real inverse_scale = 1.0 / window.scale;
    Real over_p[n], over_u[n];
    for (int i = 0; i < n; ++i) {
      over_p[i] = load<Real>(block.active[row + i]);
      over_u[i] = load<Real>(block.active[row + n + i]) * inverse_scale;
    }
    for (int m = 0; m < terms; ++m) {
      Real still = over_p[0] * window.p[0][m], moving = over_u[0] * window.p[n][m];
      for (int i = 1; i < n; ++i) {
        still = still + over_p[i] * window.p[i][m];
        moving = moving + over_u[i] * window.p[n + i][m];
      }
      series[m] = still + moving;
    }
    for (int k = 0; k < at.k; ++k) {
      const Real over = load<Real>(block.active[row + 2 * n + k]);
      for (int m = 0; m < terms; ++m) series[m] = series[m] + over * window.stream[k][m];
    }
    series[0] = series[0] + load<Real>(block.active[row + 2 * n + at.k]);
    series[terms] = series[terms + 1] = Real{};
  }

  /// The first of value, slope and bend at the start that is more than eight times its noise decides; it must be
  /// positive.
  __attribute__((always_inline)) void find_orders(const Real& scale, const Real& start_size) {
    const Real z = scale * longest_window, spread = (z + 4.0) * (scale * growth + 1.0);
    const Real noise_0 = start_size * (8.0 * 3.0 * step_rounding), noise_1 = size * z * (8.0 * 3.0 * step_rounding),
               noise_2 = size * z * z * (8.0 * 3.0 * step_rounding);
    const Real margin = smaller(upper - series[0], series[0] + lower);
    const Mask clear = less(noise_0, margin), outside = less(margin, -noise_0);
    const Mask one_sided = equal(lower, Real{});
    const Mask rises = less(noise_1, series[1]), falls = less(series[1], -noise_1), bends = less(noise_2, series[2]);
    first = there & ~clear;
    second = first & ~rises;
    doubtful = first & (outside | ~one_sided | falls | (second & ~bends));
    first = first & ~doubtful;
    second = second & ~doubtful;
    noise = size * (choose(first, choose(second, z * z, z), Real{} + 1.0) * spread * step_rounding + dropped);
    if (!any(first)) return;
    for (int m = 0; m < terms; ++m) series[m] = choose(second, series[m + 2], choose(first, series[m + 1], series[m]));
  }

  /// g = P + sum of what economization leaves: |x^m - p_m| <= tables.error[m]. The last powers, which add little,
  /// are left out whole: |x^m| <= 1.
  __attribute__((always_inline)) void make_hull() {
    for (int j = 0; j < 8; ++j) P[j] = series[j];
    error = Real{};
    Real p0 = P[0], p1 = P[1], p2 = P[2], p3 = P[3], p4 = P[4], p5 = P[5], p6 = P[6], p7 = P[7];
    for (int m = most_economized; m < terms; ++m) error = error + magnitude(series[m]);
    for (int m = 8; m < most_economized; ++m) {
      const Real a = series[m];
      const double* const e = tables.economized[m];
      p0 = p0 + a * e[0];
      p1 = p1 + a * e[1];
      p2 = p2 + a * e[2];
      p3 = p3 + a * e[3];
      p4 = p4 + a * e[4];
      p5 = p5 + a * e[5];
      p6 = p6 + a * e[6];
      p7 = p7 + a * e[7];
      error = error + magnitude(a) * tables.error[m];
    }
    P[0] = p0, P[1] = p1, P[2] = p2, P[3] = p3, P[4] = p4, P[5] = p5, P[6] = p6, P[7] = p7;
    Real sum = magnitude(P[0]);
    for (int j = 1; j < 8; ++j) sum = sum + magnitude(P[j]);
    error = (error + sum * hull_rounding + noise * 8.0) * (1.0 + 0x1p-40);
  }

  /// Signs of the Bernstein coefficients b_j against both limits: none beyond, the slot is clear; one change of sign
  /// at one limit, that has one zero. Anything else is undecided, and then the left half is looked at, up to four
  /// times.
  __attribute__((always_inline)) void decide() {
    constexpr int most_halvings = 4;
    Real b[8];
    for (int j = 0; j < 8; ++j) b[j] = P[j] * tables.to_bernstein[j];
    for (int k = 1; k < 8; ++k)
      for (int j = 7; j >= k; --j) b[j] = b[j] + b[j - 1];
    end = Real{} + 1.0;
    root = end;
    side = end;
    limit = Real{};
    hit = there & ~there;
    undecided = there & ~doubtful;
    for (int halvings = 0;; ++halvings) {
      look(b);
      if (!any(undecided) || halvings == most_halvings) break;
      end = choose(undecided, end * 0.5, end);
      for (int k = 1; k < 8; ++k)
        for (int j = 7; j >= k; --j) b[j] = (b[j] + b[j - 1]) * 0.5;
    }
  }

  /// For the lanes that are undecided.
  __attribute__((always_inline)) void look(const Real (&b)[8]) {
    Real most = b[0], least = b[0];
    for (int j = 1; j < 8; ++j) {
      most = larger(most, b[j]);
      least = smaller(least, b[j]);
    }
    const Mask beyond_upper = less(upper - error, most), beyond_lower = less(least, error - lower);
    const Real one = Real{} + 1.0, now_side = choose(beyond_upper, one, -one), now_limit = choose(beyond_upper, upper, lower);
    Real before = now_limit - now_side * b[0], place = one;
    Mask clear = less(error, before), seen = ~clear, open = (beyond_upper & beyond_lower) | ~clear;
    for (int j = 1; j < 8; ++j) {
      const Real value = now_limit - now_side * b[j];
      const Mask now_clear = less(error, value), falls = clear & ~now_clear & ~seen;
      place = choose(falls, (before / (before - value) + (j - 1.0)) * (1.0 / 7.0), place);
      open = open | (seen & now_clear);
      seen = seen | ~now_clear;
      clear = now_clear;
      before = value;
    }
    open = open | (seen & ~less(before, -error));
    side = choose(undecided, now_side, side);
    limit = choose(undecided, now_limit, limit);
    root = choose(undecided & seen & ~open, place * end, root);
    hit = hit | (undecided & seen & ~open);
    undecided = undecided & open;
  }

  /// Two steps of Halley's iteration on the polynomial of degree 7.
  __attribute__((always_inline)) void find_root() {
    if (!any(hit)) return;
    Real x = root;
    for (int step = 0; step < 2; ++step) {
      Real f = P[7], slope = Real{}, bend = Real{};
      for (int j = 6; j >= 0; --j) {
        bend = bend * x + slope;
        slope = slope * x + f;
        f = f * x + P[j];
      }
      f = limit - side * f;
      slope = -(side * slope);
      bend = -(side * bend);
      const Real next = x - f * slope / (slope * slope - f * bend);
      x = smaller(larger(next, Real{}), end);
    }
    root = choose(hit, x, root);
  }
};

}  // namespace
}  // namespace slapstick::batch
