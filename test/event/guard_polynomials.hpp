#pragma once
/// Guard polynomials for tests of the root kernel, and a search for their first zero that shares no code and no method
/// with it.
///
/// Reference: Bernstein subdivision with Descartes' rule of signs, in a number type of the caller's choice.
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "event/first_root.hpp"

namespace slapstick::event::testing {

/// Taylor coefficients in x of one guard on a window, as doubles that are taken as exact.
using Taylor = std::array<double, terms>;

inline double at(const Coefficients& a, int n) { return a[n / 8][n % 8]; }

template <class T>
T evaluate(const Taylor& a, const T& x) {
  T sum = 0;
  for (int n = degree; n >= 0; --n) sum = sum * x + T(a[n]);
  return sum;
}

template <class T>
T slope(const Taylor& a, const T& x) {
  T sum = 0;
  for (int n = degree; n >= 1; --n) sum = sum * x + T(n) * T(a[n]);
  return sum;
}

template <class T>
std::array<T, terms> bernstein(const Taylor& a) {
  std::array<T, terms> b;
  for (int j = 0; j < terms; ++j) {
    T weight = 1;
    b[j] = T(a[0]);
    for (int n = 1; n <= j; ++n) {
      weight = weight * T(j - n + 1) / T(degree - n + 1);
      b[j] += weight * T(a[n]);
    }
  }
  return b;
}

/// The kernel's input for a polynomial whose zero of order `order` at the start is divided out: every coefficient known
/// to 25 u of itself, as in a mode of nine states, and the first one, as a sum of terms of this size in all, to 25 u of
/// `size`.
inline GuardWindow window(const Taylor& a, int order = 0, double size = 0.0) {
  GuardWindow guard{};
  std::array<double, terms> g{}, sizes{};
  for (int n = order; n < terms; ++n) {
    g[n - order] = a[n];
    sizes[n - order] = std::abs(a[n]);
  }
  for (int n = 0; n < terms; ++n) guard.taylor[n / 8][n % 8] = g[n];
  constexpr double factor = 25 * unit_roundoff;
  guard.hull = enclose(g.data(), sizes.data(), terms - order, factor);
  const double more = std::max(0.0, factor * (size - std::abs(g[0])));
  guard.hull.bounds += more * Lane8{8, 0, 0, 1, 0, 0, 0, 0};
  return guard;
}

/// Of the computed g at x.
inline double noise(const GuardWindow& guard, double x) {
  const Lane8& b = guard.hull.bounds;
  return b[noise_0] + x * (b[noise_1] + x * b[noise_2]);
}

/// The first zero of a polynomial that is positive at 0, on (0, 1].
template <class T>
class Reference {
 public:
  /// @param blur below this share of the coefficients the signs are not believed.
  Reference(const Taylor& a, T blur) : blur_(blur) {
    const auto b = bernstein<T>(a);
    for (const T& c : b) size_ = std::max<T>(size_, c < 0 ? -c : c);
    first_ = search(b, T(0), T(1), 0);
  }
  /// A certain sign change, if there is one before anything uncertain.
  [[nodiscard]] const std::optional<T>& first() const { return first_; }
  /// True if a minimum or start is too close to zero for T.
  [[nodiscard]] bool unsure() const { return unsure_; }

 private:
  std::optional<T> search(const std::array<T, terms>& b, const T& low, const T& width, int depth) {
    int changes = 0;
    bool clear = true;
    for (int j = 0; j < terms; ++j) {
      if ((b[j] < 0 ? -b[j] : b[j]) <= blur_ * size_) clear = false;
      if (j > 0 && (b[j] < 0) != (b[j - 1] < 0)) ++changes;
    }
    const bool start_below = b[0] < 0;
    if (changes == 0 && !start_below && clear) return std::nullopt;
    if (start_below && clear) return low;  // fell between two boxes
    if (changes == 1 && b[0] > blur_ * size_ && b[degree] < -blur_ * size_) return bisect(b, low, width);
    if (depth > 60) {
      unsure_ = true;
      return std::nullopt;
    }
    std::array<T, terms> left, right = b;
    for (int j = 0; j < terms; ++j) {
      left[j] = right[0];
      for (int i = 0; i + 1 < terms - j; ++i) right[i] = (right[i] + right[i + 1]) / 2;
    }
    if (auto root = search(left, low, width / 2, depth + 1)) return root;
    if (unsure_) return std::nullopt;
    return search(right, low + width / 2, width / 2, depth + 1);
  }

  static T casteljau(std::array<T, terms> b, const T& x) {
    for (int j = degree; j > 0; --j)
      for (int i = 0; i < j; ++i) b[i] += x * (b[i + 1] - b[i]);
    return b[0];
  }

  T bisect(const std::array<T, terms>& b, const T& low, const T& width) const {
    T left = 0, right = 1, f_left = b[0], f_right = b[degree];
    for (int i = 0; i < 200 && right - left > T(1e-20) * (left + low / width); ++i) {
      T x = i % 3 == 2 ? (left + right) / 2 : (left * f_right - right * f_left) / (f_right - f_left);
      if (!(x > left && x < right)) x = (left + right) / 2;
      if (!(x > left && x < right)) break;
      const T f = casteljau(b, x);
      if (f > 0)
        left = x, f_left = f;
      else
        right = x, f_right = f;
    }
    return low + width * (left + right) / 2;
  }

  T blur_, size_ = 0;
  std::optional<T> first_;
  bool unsure_ = false;
};

/// c + sum_k R_k exp(-sigma_k x) cos(w_k x + phi_k) with |lambda_k| <= 2.6 per window, normalised to a size of one.
class RandomGuards {
 public:
  explicit RandomGuards(std::uint64_t seed) : random_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  Taylor damped_sinusoids() {
    std::array<long double, terms> sum{};
    const int count = integer(1, 3);
    for (int k = 0; k < count; ++k) {
      const long double size = std::pow(10.0L, uniform(-2, 0)), angle = uniform(0, 6.283185307179586),
                        rate = std::pow(10.0L, uniform(-0.7, 0.45)), damping = rate * uniform(-0.2, 1.0);
      long double re = size * std::cos(angle), im = size * std::sin(angle);
      for (int n = 0; n < terms; ++n) {
        sum[n] += re;
        const long double next = (-damping * re - rate * im) / (n + 1);
        im = (rate * re - damping * im) / (n + 1);
        re = next;
      }
    }
    Taylor a;
    for (int n = 0; n < terms; ++n) a[n] = static_cast<double>(sum[n]);
    return a;
  }

 private:
  std::mt19937_64 random_;
};

/// The least value of sum a_n x^n on [low, 1] and where it lies, for cases that are to graze there.
inline std::pair<long double, long double> minimum(const Taylor& a, long double low) {
  long double best = evaluate<long double>(a, low), where = low;
  const int grid = 64;
  for (int i = 1; i <= grid; ++i) {
    const long double x = low + (1 - low) * i / grid, value = evaluate<long double>(a, x);
    if (value < best) best = value, where = x;
  }
  long double left = std::max(low, where - (1 - low) / grid), right = std::min(1.0L, where + (1 - low) / grid);
  for (int i = 0; i < 80; ++i) {
    const long double x = (left + right) / 2;
    (slope<long double>(a, x) < 0 ? left : right) = x;
  }
  const long double x = (left + right) / 2;
  return {evaluate<long double>(a, x), x};
}

}  // namespace slapstick::event::testing
