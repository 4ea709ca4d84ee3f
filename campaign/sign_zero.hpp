#pragma once
/// The same question as interval_zero.hpp by another method: Descartes' rule of signs on Bernstein coefficients, and
/// halving.
#include "interval_zero.hpp"

namespace campaign {

/// The first zero of f = sum a_n x^n on [0, 1], f(0) > error; its minima are not looked for.
template <class T>
class SignSearch {
 public:
  using Polynomial = std::array<T, ExactFlow::terms>;

  SignSearch(const Polynomial& a, T error) : a_(a), error_(error) {}

  IntervalZero<T> first() {
    Polynomial b{};
    for (int j = 0; j <= degree; ++j)
      for (int n = 0; n <= j; ++n) b[j] += weights()[j][n] * a_[n];
    if (!search(b, 0, 1, 0)) out_.kind = Kind::none;
    return out_;
  }

 private:
  static constexpr int degree = ExactFlow::terms - 1;

  /// Bernstein coefficients of x^n: binomial(j, n) / binomial(degree, n).
  static const std::array<Polynomial, ExactFlow::terms>& weights() {
    static const auto all = [] {
      std::array<Polynomial, ExactFlow::terms> w{};
      for (int j = 0; j <= degree; ++j) {
        w[j][0] = 1;
        for (int n = 1; n <= j; ++n) w[j][n] = w[j][n - 1] * (j - n + 1) / (degree - n + 1);
      }
      return w;
    }();
    return all;
  }

  bool search(const Polynomial& b, T low, T width, int depth) {
    int changes = 0;
    T least = b[0];
    for (int j = 1; j <= degree; ++j) {
      if ((b[j] < 0) != (b[j - 1] < 0)) ++changes;
      if (b[j] < least) least = b[j];
    }
    if (least > error_) return false;
    if (changes == 1 && b[0] > error_ && b[degree] < -error_) return settle(low, low + width);
    if (depth > 60) return end(Kind::touch, low + width / 2);
    Polynomial left, right = b;
    for (int j = 0; j <= degree; ++j) {
      left[j] = right[0];
      for (int i = 0; i < degree - j; ++i) right[i] = (right[i] + right[i + 1]) / 2;
    }
    return search(left, low, width / 2, depth + 1) || search(right, low + width / 2, width / 2, depth + 1);
  }

  /// The only zero in an interval that begins above and ends below: Newton's steps kept inside by bisection.
  bool settle(T low, T high) {
    T x = high;
    for (int i = 0; i < 300; ++i) {
      T f = 0, slope = 0;
      for (int n = degree; n >= 0; --n) slope = slope * x + f, f = f * x + a_[n];
      (f > 0 ? low : high) = x;
      T next = x - f / slope;
      if (!(next > low && next < high)) next = (low + high) / 2;
      if (size_of(f) <= error_ || !(next > low && next < high)) break;
      x = next;
    }
    return end(Kind::crossing, x);
  }

  bool end(Kind kind, T x) {
    out_.kind = kind;
    out_.x = x;
    for (int n = degree; n >= 1; --n) out_.slope = out_.slope * x + n * a_[n];
    for (int n = degree; n >= 2; --n) out_.bend = out_.bend * x + n * (n - 1) * a_[n];
    return true;
  }

  const Polynomial& a_;
  T error_;
  IntervalZero<T> out_;
};

}  // namespace campaign
