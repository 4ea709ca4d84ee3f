#pragma once
/// A polynomial on [0, 1], its zeros and its extremes, none missed.
///
/// In Bernstein's basis a polynomial has no more zeros in a piece than its coefficients have changes of sign. With none
/// there is no zero; with one it is found between the ends; with more the piece is halved, until the polynomial is
/// negligible in it. Nothing is sampled. Source: Farouki and Rajan (1987) for the basis; Descartes' rule of signs.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/bracketed_root.hpp"

namespace slapstick::event {

/// sum_j a_j x^j
struct Polynomial {
  static constexpr int most = 46;  ///< the largest degree: that of a product of two windows
  int degree = 0;
  std::array<double, most + 1> a{};

  [[nodiscard]] double at(double x) const {
    double sum = 0.0;
    for (int j = degree; j >= 0; --j) sum = sum * x + a[static_cast<std::size_t>(j)];
    return sum;
  }
  /// sum |a_j|, j >= from: a bound of what the terms from there on can be.
  [[nodiscard]] double size(int from = 0) const {
    double sum = 0.0;
    for (int j = from; j <= degree; ++j) sum += std::abs(a[static_cast<std::size_t>(j)]);
    return sum;
  }
  [[nodiscard]] double integral() const {
    double sum = 0.0;
    for (int j = degree; j >= 0; --j) sum += a[static_cast<std::size_t>(j)] / (j + 1);
    return sum;
  }
  [[nodiscard]] Polynomial slope() const {
    Polynomial of;
    of.degree = std::max(degree - 1, 0);
    for (int j = 1; j <= degree; ++j) of.a[static_cast<std::size_t>(j) - 1] = j * a[static_cast<std::size_t>(j)];
    return of;
  }
};

/// The coefficients in Bernstein's basis of some degree.
class Bernstein {
 public:
  /// b_i = sum_{j <= i} C(i, j) / C(n, j) a_j: the sums by Pascal's triangle
  explicit Bernstein(const Polynomial& f) : degree_(f.degree) {
    double choices = 1.0;  // C(n, j)
    for (int j = 0; j <= degree_; ++j) {
      b_[static_cast<std::size_t>(j)] = f.a[static_cast<std::size_t>(j)] / choices;
      choices *= static_cast<double>(degree_ - j) / (j + 1);
    }
    for (int row = 1; row <= degree_; ++row)
      for (int i = degree_; i >= row; --i) b_[static_cast<std::size_t>(i)] += b_[static_cast<std::size_t>(i) - 1];
  }

  [[nodiscard]] double front() const { return b_[0]; }
  [[nodiscard]] double back() const { return b_[static_cast<std::size_t>(degree_)]; }
  /// The polynomial is between these.
  [[nodiscard]] double least() const { return *std::min_element(b_.begin(), b_.begin() + degree_ + 1); }
  [[nodiscard]] double most() const { return *std::max_element(b_.begin(), b_.begin() + degree_ + 1); }
  [[nodiscard]] double largest() const {
    double most = 0.0;
    for (int i = 0; i <= degree_; ++i) most = std::max(most, std::abs(b_[static_cast<std::size_t>(i)]));
    return most;
  }
  [[nodiscard]] int changes_of_sign() const {
    int changes = 0;
    double last = 0.0;
    for (int i = 0; i <= degree_; ++i) {
      const double value = b_[static_cast<std::size_t>(i)];
      if (value * last < 0.0) ++changes;
      if (value != 0.0) last = std::copysign(1.0, value);
    }
    return changes;
  }
  /// de Casteljau: this becomes the right half's. @returns the left half's
  Bernstein halve() {
    Bernstein left = *this;
    for (int k = 0; k <= degree_; ++k) {
      left.b_[static_cast<std::size_t>(k)] = b_[0];
      for (int i = 0; i < degree_ - k; ++i) {
        const auto at = static_cast<std::size_t>(i);
        b_[at] = 0.5 * (b_[at] + b_[at + 1]);
      }
    }
    return left;
  }

 private:
  int degree_;
  std::array<double, Polynomial::most + 1> b_{};
};

/// -1 or 1, or 0 for a value that the rounding of its sum may have made. Where a velocity comes to rest, the slope of
/// its square is zero, and rounding gives it a sign. Such a sign would be taken for the change of sign inside.
inline int certain_sign(const Polynomial& g, double x) {
  const double value = g.at(x);
  return std::abs(value) > 2 * g.degree * 0x1p-53 * g.size() ? value > 0.0 ? 1 : -1 : 0;
}

/// Hands `take` every place of (0, 1) at which g may be zero: each zero up to rounding, and some places that are not.
/// @param negligible  pieces where |g| times their length is below this are not halved any further
template <class Take>
void possible_zeros(const Polynomial& g, Bernstein b, double from, double to, double negligible, const Take& take) {
  const int changes = b.changes_of_sign();
  if (changes == 0) return;
  const double middle = 0.5 * (from + to);
  if (b.largest() * (to - from) <= negligible) return take(middle);
  if (changes == 1 && certain_sign(g, from) * certain_sign(g, to) < 0)
    return take(bracketed_root([&](double x) { return g.at(x); }, from, to, 0x1p-53));
  take(middle);
  const Bernstein left = b.halve();
  possible_zeros(g, left, from, middle, negligible, take);
  possible_zeros(g, b, middle, to, negligible, take);
}

/// Hands (x, f(x)) to `take` at both ends and wherever f may have an extreme.
template <class Take>
void possible_extremes(const Polynomial& f, const Take& take) {
  take(0.0, f.at(0.0));
  take(1.0, f.at(1.0));
  const Polynomial slope = f.slope();
  possible_zeros(slope, Bernstein(slope), 0.0, 1.0, 0x1p-53 * f.size(), [&](double x) { take(x, f.at(x)); });
}

}  // namespace slapstick::event
