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

  Real series[terms];              ///< with a zero of its order at the start divided out
  Mask first, second;              ///< order at least one, at least two
  Mask there, doubtful;            ///< the lane's mode has this slot; it starts in doubt or outside its limits
  Real lower, upper, size, noise;  ///< size: no value is more; noise: a bound of the series' errors
  Real P[8], error;                ///< of the polynomial of degree 7 that is near, and how near
  Mask undecided, hit;
  Real side, limit;  ///< the slot is limit - side v; side 1: the upper limit, -1: the lower
  Real end, root;    ///< of the part of the window that is decided; about where the hull vanishes

  template <int n>
  __attribute__((noinline)) void make(const Block& block, const Window<width, n>& window, int s) {
    const Layout& at = block.layout;
    const auto word = [&](int which) { return load<Real>(block.active[at.slot_number(s, which)]); };
    lower = word(Layout::lower);
    upper = word(Layout::upper);
    size = word(Layout::norm) * window.size;
    there = less(Real{}, size);
    bool driven = false;
    for (int k = 0; k < at.k; ++k)
      driven = driven || any(~equal(load<Real>(block.active[at.slot(s) + 2 * n + k]), Real{}));
    const Real start_size = word(Layout::start_norm) * window.size;
    if (!driven)
      expand(Row<n, 0>(block, window, at.slot(s)), start_size);
    else if (at.k == 1)
      expand(Row<n, 1>(block, window, at.slot(s)), start_size);
    else
      expand(Row<n, most_streams>(block, window, at.slot(s)), start_size);
    decide();
    find_root();
  }

  /// About the slot's value v at x.
  __attribute__((always_inline)) Real about(const Real& x) const {
    Real value = P[7];
    for (int j = 6; j >= 0; --j) value = value * x + P[j];
    return value * choose(first, choose(second, x * x, x), Real{} + 1.0);
  }

  /// About the integral of v from 0 to x.
  __attribute__((always_inline)) Real integral(const Real& x) const {
    Real sum = Real{};
    for (int j = 7; j >= 0; --j) {
      const Real part = choose(first, choose(second, Real{} + tables.inverse[j + 3], Real{} + tables.inverse[j + 2]),
                               Real{} + tables.inverse[j + 1]);
      sum = sum * x + P[j] * part;
    }
    return sum * choose(first, choose(second, x * x, x), Real{} + 1.0) * x;
  }

  /// The lower polynomial limit - side P - error at x.
  __attribute__((always_inline)) Real above(const Real& x) const {
    Real value = P[7];
    for (int j = 6; j >= 0; --j) value = value * x + P[j];
    return (limit - side * value) - error;
  }

 private:
  /// The series of a row over (p, u, f, 1), term by term. k streams.
  template <int n, int k>
  struct Row {
    const Window<width, n>& window;
    Real over_p[n], over_u[n], constant, even[k + 1], odd[k + 1];

    __attribute__((always_inline)) Row(const Block& block, const Window<width, n>& window_, int row) : window(window_) {
      const Real inverse_scale = 1.0 / window.scale;
      for (int i = 0; i < n; ++i) {
        over_p[i] = load<Real>(block.active[row + i]);
        over_u[i] = load<Real>(block.active[row + n + i]) * inverse_scale;
      }
      for (int s = 0; s < k; ++s) {
        const Real over = s < block.layout.k ? load<Real>(block.active[row + 2 * n + s]) : Real{};
        even[s] = over * window.even[s];
        odd[s] = over * window.odd[s];
      }
      constant = load<Real>(block.active[row + 2 * n + block.layout.k]);
    }

    __attribute__((always_inline)) Real first() {
      Real still = over_p[0] * window.p[0][0], moving = over_u[0] * window.start[0];
      for (int i = 1; i < n; ++i) {
        still = still + over_p[i] * window.p[i][0];
        moving = moving + over_u[i] * window.start[i];
      }
      return add(still + moving, 0, even) + constant;
    }
    /// m > 0, one after the other. (m + 1) p_(m+1) are the velocities' coefficients.
    __attribute__((always_inline)) Real term(int m, Real (&stream)[k + 1]) {
      Real still = over_p[0] * window.p[0][m], moving = over_u[0] * window.p[0][m + 1];
      for (int i = 1; i < n; ++i) {
        still = still + over_p[i] * window.p[i][m];
        moving = moving + over_u[i] * window.p[i][m + 1];
      }
      return add(still + moving * (m + 1.0), m, stream);
    }

   private:
    __attribute__((always_inline)) Real add(Real sum, int m, Real (&stream)[k + 1]) const {
      for (int s = 0; s < k; ++s) {
        sum = sum + stream[s] * tables.inverse_factorial[m];
        stream[s] = stream[s] * window.bend[s];
      }
      return sum;
    }
  };

  /// The series with the zero at its start divided out, and on the way its hull: g = P + sum of what economization
  /// leaves, |x^m - p_m| <= tables.error[m]. The last powers, which add little, are left out whole: |x^m| <= 1.
  template <class Row>
  __attribute__((always_inline)) void expand(Row row, const Real& start_size) {
    Real now = row.first(), next = row.term(1, row.odd), after = row.term(2, row.even);
    find_orders(row.window.scale, start_size, now, next, after);
    const auto shifted = [&](int m, const Real& third) __attribute__((always_inline)) {
      const Real a = choose(second, after, choose(first, next, now));
      series[m] = a;
      now = next;
      next = after;
      after = third;
      return a;
    };
#pragma GCC unroll 4
    for (int m = 0; m < 8; m += 2) {
      P[m] = shifted(m, row.term(m + 3, row.odd));
      P[m + 1] = shifted(m + 1, row.term(m + 4, row.even));
    }
    Real p0 = P[0], p1 = P[1], p2 = P[2], p3 = P[3], p4 = P[4], p5 = P[5], p6 = P[6], p7 = P[7], left = Real{};
    const auto economize = [&](int m, const Real& a) __attribute__((always_inline)) {
      const double* const e = tables.economized[m];
      p0 = p0 + a * e[0];
      p1 = p1 + a * e[1];
      p2 = p2 + a * e[2];
      p3 = p3 + a * e[3];
      p4 = p4 + a * e[4];
      p5 = p5 + a * e[5];
      p6 = p6 + a * e[6];
      p7 = p7 + a * e[7];
      left = left + magnitude(a) * tables.error[m];
    };
    for (int m = 8; m < most_economized; m += 2) {
      economize(m, shifted(m, row.term(m + 3, row.odd)));
      economize(m + 1, shifted(m + 1, row.term(m + 4, row.even)));
    }
    for (int m = most_economized; m < terms - 4; m += 2) {
      left = left + magnitude(shifted(m, row.term(m + 3, row.odd)));
      left = left + magnitude(shifted(m + 1, row.term(m + 4, row.even)));
    }
    left = left + magnitude(shifted(terms - 4, row.term(terms - 1, row.odd)));
    for (int m = terms - 3; m < terms; ++m) left = left + magnitude(shifted(m, Real{}));
    P[0] = p0, P[1] = p1, P[2] = p2, P[3] = p3, P[4] = p4, P[5] = p5, P[6] = p6, P[7] = p7;
    Real sum = magnitude(p0) + magnitude(p1) + magnitude(p2) + magnitude(p3) + magnitude(p4) + magnitude(p5) +
               magnitude(p6) + magnitude(p7);
    error = (left + sum * hull_rounding + noise * 8.0) * (1.0 + 0x1p-40);
  }

  /// The first of value, slope and bend at the start that is more than eight times its noise decides; it must be
  /// positive.
  __attribute__((always_inline)) void find_orders(const Real& scale, const Real& start_size, const Real& value,
                                                  const Real& slope, const Real& bend) {
    const Real z = scale * longest_window, spread = (z + 4.0) * (scale * growth + 1.0);
    const Real noise_0 = start_size * (8.0 * 3.0 * step_rounding), noise_1 = size * z * (8.0 * 3.0 * step_rounding),
               noise_2 = size * z * z * (8.0 * 3.0 * step_rounding);
    const Real margin = smaller(upper - value, value + lower);
    const Mask clear = less(noise_0, margin), outside = less(margin, -noise_0);
    const Mask one_sided = equal(upper, Real{} + no_limit);
    const Mask rises = less(noise_1, slope), falls = less(slope, -noise_1), bends = less(noise_2, bend);
    first = there & ~clear;
    second = first & ~rises;
    doubtful = first & (outside | ~one_sided | falls | (second & ~bends));
    first = first & ~doubtful;
    second = second & ~doubtful;
    noise = size * (choose(first, choose(second, z * z, z), Real{} + 1.0) * spread * step_rounding + dropped);
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
    const Real one = Real{} + 1.0, now_side = choose(beyond_upper, one, -one),
               now_limit = choose(beyond_upper, upper, lower);
    Real before = now_limit - now_side * b[0], whole = Real{}, above = one, drop = one;
    Mask clear = less(error, before), seen = ~clear, open = (beyond_upper & beyond_lower) | ~clear;
    for (int j = 1; j < 8; ++j) {
      const Real value = now_limit - now_side * b[j];
      const Mask now_clear = less(error, value), falls = clear & ~now_clear & ~seen;
      whole = choose(falls, Real{} + (j - 1.0), whole);
      above = choose(falls, before, above);
      drop = choose(falls, before - value, drop);
      open = open | (seen & now_clear);
      seen = seen | ~now_clear;
      clear = now_clear;
      before = value;
    }
    open = open | (seen & ~less(before, -error));
    side = choose(undecided, now_side, side);
    limit = choose(undecided, now_limit, limit);
    root = choose(undecided & seen & ~open, (above / drop + whole) * (1.0 / 7.0) * end, root);
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
