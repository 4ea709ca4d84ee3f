#pragma once
/// The first zero of a polynomial on [0, 1], with certainty or not at all, by the signs of its first two derivatives.
///
/// An interval is split until one of these holds on it: f > 0 by its Taylor polynomial about the middle; f falls or
/// rises; f is concave (its least value lies at an end); f is convex (Newton's iteration finds its minimum u, and
/// f >= f(u) - f'(u)^2 / (2 min f'')). The engine's way, steps that cannot pass a zero, is not used.
#include <array>
#include <utility>

#include "exact_flow.hpp"

namespace campaign {

enum class Kind { none, crossing, touch };  ///< touch: it cannot be told whether there is a zero

template <class T>
struct IntervalZero {
  Kind kind = Kind::none;
  T x = 0;           ///< of the zero, or of the minimum that cannot be told from one
  T slope = 0;       ///< f' there
  T bend = 0;        ///< f'' there
  T least = 0;       ///< the value of the lowest minimum that was looked at,
  T lowest = 0;      ///< where it lies,
  bool low = false;  ///< if there was one
};

template <class T>
T size_of(T x) {
  return x < 0 ? -x : x;
}

/// f = sum a_n x^n, of values known to `error`. f(0) > error is demanded.
template <class T>
class IntervalSearch {
 public:
  using Polynomial = std::array<T, ExactFlow::terms>;

  IntervalSearch(const Polynomial& a, T error) : a_(a), error_(error) {
    for (int n = 3; n < ExactFlow::terms; ++n) third_ += n * (n - 1) * (n - 2) * size_of(a[n]);
  }

  IntervalZero<T> first() {
    if (!search(0, 1, 0)) out_.kind = Kind::none;
    return out_;
  }

 private:
  struct Jet {
    T f, f1, f2;
  };

  [[nodiscard]] Jet jet(T x) const {
    T f = 0, f1 = 0, f2 = 0;
    for (int n = ExactFlow::useful<T> - 1; n >= 0; --n) {
      f2 = f2 * x + f1;
      f1 = f1 * x + f;
      f = f * x + a_[n];
    }
    return {f, f1, 2 * f2};
  }

  /// True if the search has ended at a zero or a touch.
  bool search(T low, T high, int depth) {
    const T x = (low + high) / 2, r = (high - low) / 2;
    const Jet c = jet(x);
    const T dip = c.f2 < 0 ? -c.f2 * r * r / 2 : T(0);
    if (c.f - size_of(c.f1) * r - dip - third_ * r * r * r / 6 > error_) return false;
    const bool monotone = size_of(c.f1) > size_of(c.f2) * r + third_ * r * r / 2;
    const T bend = size_of(c.f2) - third_ * r;
    if (monotone && c.f1 > 0) return at_end(low, low, high);
    if (monotone || (bend > 0 && c.f2 < 0)) return at_end(high, low, high);
    if (bend > 0) return at_minimum(low, high, bend);
    if (depth > 50) return end(Kind::touch, x);
    return search(low, x, depth + 1) || search(x, high, depth + 1);
  }

  /// f has its least value at the end `x` of the interval, and at most one zero in it.
  bool at_end(T x, T low, T high) {
    const T f = jet(x).f;
    if (f > error_) return false;
    return f < -error_ && x == high ? zero(low, high) : end(Kind::touch, x);
  }

  bool at_minimum(T low, T high, T bend) {
    if (jet(high).f1 <= 0) return at_end(high, low, high);
    if (jet(low).f1 >= 0) return at_end(low, low, high);
    T left = low, right = high, u = (low + high) / 2;
    for (int i = 0; i < 60; ++i) {
      const Jet c = jet(u);
      const T step = c.f1 / c.f2;
      if (size_of(step) * size_of(c.f1) <= error_ / 8) break;
      (c.f1 < 0 ? left : right) = u;
      u -= step;
      if (!(u > left && u < right)) u = (left + right) / 2;
    }
    const Jet c = jet(u);
    note(c.f, u);
    if (c.f - c.f1 * c.f1 / (2 * bend) > error_) return false;
    return c.f < -error_ ? zero(low, u) : end(Kind::touch, u);
  }

  /// The only zero in (left, right): f > 0 at the left, f < 0 at the right.
  bool zero(T left, T right) {
    T x = right;
    for (int i = 0; i < 200; ++i) {
      const Jet c = jet(x);
      (c.f > 0 ? left : right) = x;
      T next = x - c.f / c.f1;
      if (!(next > left && next < right)) next = (left + right) / 2;
      const bool settled = size_of(c.f) <= error_ / 8 || !(next > left && next < right);
      if (settled) break;
      x = next;
    }
    return end(Kind::crossing, x);
  }

  bool end(Kind kind, T x) {
    const Jet c = jet(x);
    out_.kind = kind;
    out_.x = x;
    out_.slope = c.f1;
    out_.bend = c.f2;
    if (kind == Kind::touch) note(c.f, x);
    return true;
  }

  void note(T f, T x) {
    if (out_.low && out_.least <= f) return;
    out_.least = f;
    out_.lowest = x;
    out_.low = true;
  }

  const Polynomial& a_;
  T error_, third_ = 0;
  IntervalZero<T> out_;
};

}  // namespace campaign
