#pragma once
/// The same question as interval_zero.hpp by another method: Descartes' rule of signs on Bernstein coefficients, and halving.
#include "interval_zero.hpp"

namespace campaign {

/// The first zero of f = sum a_n x^n on [0, 1], f(0) > error; its minima are not looked for.
template <class T>
class SignSearch {
 public:
  using Polynomial = std::array<T, ExactFlow::terms>;

  SignSearch(const Polynomial& a, T error) : a_(a), error_(error) {}

  IntervalZero<T> first() {
    Polynomial b;
    for (int j = 0; j <= degree; ++j) {
      T weight = 1;
      b[j] = a_[0];
      for (int n = 1; n <= j; ++n) {
        weight = weight * (j - n + 1) / (degree - n + 1);
        b[j] += weight * a_[n];
      }
    }
    if (!search(b, 0, 1, 0)) out_.kind = Kind::none;
    return out_;
  }

 private:
  static constexpr int degree = ExactFlow::terms - 1;

  bool search(const Polynomial& b, T low, T width, int depth) {
    int changes = 0;
    T least = b[0];
    for (int j = 1; j <= degree; ++j) {
      if ((b[j] < 0) != (b[j - 1] < 0)) ++changes;
      if (b[j] < least) least = b[j];
    }
    if (least > error_) return false;
    if (changes == 1 && b[0] > error_ && b[degree] < -error_) return bisect(b, low, width);
    if (depth > 60) return end(Kind::touch, low + width / 2);
    Polynomial left, right = b;
    for (int j = 0; j <= degree; ++j) {
      left[j] = right[0];
      for (int i = 0; i < degree - j; ++i) right[i] = (right[i] + right[i + 1]) / 2;
    }
    return search(left, low, width / 2, depth + 1) || search(right, low + width / 2, width / 2, depth + 1);
  }

  /// Regula falsi with a bisection in every third step; the value by de Casteljau's scheme.
  bool bisect(const Polynomial& b, T low, T width) {
    T left = 0, right = 1, f_left = b[0], f_right = b[degree], x = 0;
    for (int i = 0; i < 300; ++i) {
      x = i % 3 == 2 ? (left + right) / 2 : (left * f_right - right * f_left) / (f_right - f_left);
      if (!(x > left && x < right)) x = (left + right) / 2;
      Polynomial c = b;
      for (int j = degree; j > 0; --j)
        for (int k = 0; k < j; ++k) c[k] += x * (c[k + 1] - c[k]);
      if (size_of(c[0]) <= error_ || !(x > left && x < right)) break;
      (c[0] > 0 ? left : right) = x;
      (c[0] > 0 ? f_left : f_right) = c[0];
    }
    return end(Kind::crossing, low + width * x);
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
