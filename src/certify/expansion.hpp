#pragma once
/// The guards of a segment as Taylor polynomials in a number type of choice, and lower parabolas of them.
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "certify/segment_proof.hpp"

namespace slapstick::certify {

/// A guard about one place: coefficients, and the sums of the sizes of what each was made of.
template <class Real>
struct Polynomial {
  std::vector<Real> a, size;
};

template <class Real>
class Expansion {
 public:
  /// @param terms  number of Taylor terms; the tail beyond must be below the type's rounding over a window
  /// @param rounding  unit roundoff of Real, with some reserve for sums of `terms` terms
  Expansion(const mode::Mode& mode, const std::vector<double>& X, int terms, double rounding)
      : mode_(mode), terms_(terms), rounding_(rounding) {
    for (Eigen::Index i = 0; i < mode.system().rows(); ++i)
      for (Eigen::Index j = 0; j < mode.system().cols(); ++j)
        if (mode.system()(i, j) != 0.0)
          entries_.push_back({static_cast<int>(i), static_cast<int>(j), mode.system()(i, j)});
    std::vector<Real> start(X.begin(), X.end()), size = start;
    for (Real& x : size) x = abs_of(x);
    add_window(0.0, std::move(start), std::move(size));
  }

  [[nodiscard]] double rounding() const { return rounding_; }

  /// Guard g about s; only for s = 0, the first `order` coefficients are dropped.
  Polynomial<Real> about(int g, double s, int order = 0) {
    const std::size_t w = window_of(s);
    Polynomial<Real> p = of_window(g, w);
    p.a.erase(p.a.begin(), p.a.begin() + order);
    p.size.erase(p.size.begin(), p.size.begin() + order);
    const Real x = Real(s) - Real(windows_[w].begin);
    if (x != 0) {
      shift(p.a, x);
      shift(p.size, x);
    }
    return p;
  }

 private:
  struct Entry {
    int row, column;
    double value;
  };
  struct Window {
    double begin;
    std::vector<std::vector<Real>> terms;  ///< A^n X / n!
    std::vector<std::vector<Real>>
        sizes;  ///< |A|^n s / n!, s the largest sums of sizes so far: what rounding is measured by
  };

  void add_window(double begin, std::vector<Real> X, std::vector<Real> size) {
    Window window{begin, {std::move(X)}, {std::move(size)}};
    for (int n = 1; n < terms_; ++n) {
      std::vector<Real> next(window.terms[0].size(), Real(0)), next_size = next;
      for (const Entry& e : entries_) {
        next[e.row] += Real(e.value) * window.terms.back()[e.column];
        next_size[e.row] += Real(std::abs(e.value)) * window.sizes.back()[e.column];
      }
      for (Real& x : next) x /= n;
      for (Real& x : next_size) x /= n;
      window.terms.push_back(std::move(next));
      window.sizes.push_back(std::move(next_size));
    }
    windows_.push_back(std::move(window));
  }

  /// The window that s lies in; windows are made as they are needed.
  std::size_t window_of(double s) {
    const double H = mode_.window();
    while (s > windows_.back().begin + H) {
      const Window& last = windows_.back();
      const double begin = last.begin + H;
      const Real x = Real(begin) - Real(last.begin);
      std::vector<Real> X = last.terms.back(), size(X.size(), Real(0));
      for (int n = terms_ - 2; n >= 0; --n)
        for (std::size_t i = 0; i < X.size(); ++i) X[i] = X[i] * x + last.terms[n][i];
      for (int n = terms_ - 1; n >= 0; --n)
        for (std::size_t i = 0; i < X.size(); ++i) size[i] = size[i] * x + abs_of(last.terms[n][i]);
      for (std::size_t i = 0; i < X.size(); ++i) size[i] = std::max(size[i], last.sizes[0][i]);
      add_window(begin, std::move(X), std::move(size));
    }
    std::size_t w = windows_.size() - 1;
    while (w > 0 && s < windows_[w].begin) --w;
    return w;
  }

  static Real abs_of(const Real& x) { return x < 0 ? Real(-x) : x; }

  Polynomial<Real> of_window(int g, std::size_t w) const {
    const mode::RowVector& row = mode_.guards()[g].row;
    Polynomial<Real> p{std::vector<Real>(terms_, Real(0)), std::vector<Real>(terms_, Real(0))};
    for (int n = 0; n < terms_; ++n) {
      for (Eigen::Index i = 0; i < row.size(); ++i) {
        if (row[i] == 0.0) continue;
        p.a[n] += Real(row[i]) * windows_[w].terms[n][i];
        p.size[n] += Real(std::abs(row[i])) * windows_[w].sizes[n][i];
      }
    }
    return p;
  }

  /// a(t) -> a(t + x), by Horner's rule.
  static void shift(std::vector<Real>& a, const Real& x) {
    for (std::size_t i = 0; i + 1 < a.size(); ++i)
      for (std::size_t j = a.size() - 1; j-- > i;) a[j] += x * a[j + 1];
  }

  const mode::Mode& mode_;
  int terms_;
  double rounding_;
  std::vector<Entry> entries_;
  std::vector<Window> windows_;
};

/// The longest step that the polynomial, about s, allows within `most`; d = 0 if it is not certainly positive at s.
template <class Real>
Step longest_step(const Polynomial<Real>& p, double rounding, double s, double most) {
  using std::abs;
  constexpr double up = 1.0 + 0x1p-40;
  const auto number = [](const Real& x) { return static_cast<double>(x); };
  Step step{s, number(p.a[0] - rounding * p.size[0]), number(p.a[1] - rounding * p.size[1]), 0.0, 0.0};
  step.h = std::nextafter(step.h - 0x1p-50 * std::abs(step.h), -INFINITY);
  step.h1 = std::nextafter(step.h1 - 0x1p-50 * std::abs(step.h1), -INFINITY);
  if (!(step.h > 0.0)) return step;
  double d = most;
  for (int k = 0; k < 200; ++k) {
    double M = 0.0;
    for (std::size_t j = p.a.size(); j-- > 2;)
      M = M * d + static_cast<double>(j * (j - 1)) * (number(abs(p.a[j])) + rounding * number(p.size[j]));
    step.M = M * up;
    if (step.h + step.h1 * d - 0.5 * step.M * d * d > 0x1p-30 * step.h) {
      step.d = d;
      return step;
    }
    // The first zero of h + h1 t - M t^2 / 2; a shorter step has a smaller M, so that its parabola is higher.
    const double root = step.h1 < 0.0 ? 2.0 * step.h / (std::sqrt(step.h1 * step.h1 + 2.0 * step.M * step.h) - step.h1)
                                      : (step.h1 + std::sqrt(step.h1 * step.h1 + 2.0 * step.M * step.h)) / step.M;
    d = std::max(root * (1.0 - 0x1p-20), 0.5 * d) < d ? std::max(root * (1.0 - 0x1p-20), 0.5 * d) : 0.5 * d;
    if (!(s + d > s)) return step;
  }
  return step;
}

}  // namespace slapstick::certify
