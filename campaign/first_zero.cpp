/// Finds the first zero of a guard on a segment with certainty.
#include "first_zero.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sign_zero.hpp"

namespace campaign {
namespace {

constexpr int most_size = 32;

/// One search; holds what its parts share.
class Segment {
 public:
  Segment(const ExactFlow& flow, int guard, const double* X, int order, Method method)
      : flow_(flow), guard_(guard), X_(X), order_(order), method_(method), size_(flow.size(guard, X)) {
    truth_.scale = flow.scale(guard, X);
  }

  Truth first(int intervals) {
    const double low = flow_.bend(guard_, X_) / 8 + 0x1p-46 * size_;
    for (int begin = 0; begin < intervals; begin += piece) {
      std::array<double, piece + 1> h{};
      const int count = std::min(piece, intervals - begin);
      evaluate(h.data(), begin, count);
      for (int j = 0; j < count; ++j) {
        const bool clear = h[j] > low && h[j + 1] > low && (begin + j > 0 || order_ == 0);
        if (!clear && look_at(begin + j)) return truth_;
      }
    }
    return truth_;
  }

 private:
  static constexpr int piece = 31;  ///< intervals that are evaluated together

  void evaluate(double* h, int begin, int count) const {
    if (method_ == Method::wide) {
      for (int j = 0; j <= count; ++j) h[j] = static_cast<double>(flow_.value(guard_, begin + j, X_));
      return;
    }
    for (int i = 0; i < flow_.size(); ++i) {
      const double* column = flow_.column(guard_, i) + begin;
      for (int j = 0; j <= count; ++j) h[j] += column[j] * X_[i];
    }
  }

  /// True if the search ends in interval j.
  bool look_at(int j) {
    if (method_ == Method::quick) {
      const auto found = search<long double, IntervalSearch<long double>>(j, 0x1p-58L);
      if (found.kind != Kind::touch) return take(found, j);
      return take(search<Quad, IntervalSearch<Quad>>(j, Quad(0x1p-104)), j);
    }
    const auto found = search<Quad, SignSearch<Quad>>(j, Quad(0x1p-104));
    const auto check = search<Quad, IntervalSearch<Quad>>(j, Quad(0x1p-104));
    if (found.kind != check.kind || size_of(found.x - check.x) > Quad(0x1p-30))
      throw std::logic_error("the two searches of the reference contradict each other");
    return take(check, j);
  }

  template <class T, class Search>
  IntervalZero<T> search(int j, T error) const {
    std::array<T, most_size> state;
    std::array<T, ExactFlow::terms> a;
    flow_.state<T>(j, X_, state.data());
    flow_.polynomial<T>(guard_, state.data(), a.data());
    const int order = j == 0 ? order_ : 0;
    std::copy(a.begin() + order, a.end(), a.begin());
    std::fill(a.end() - order, a.end(), T(0));
    return Search(a, error * T(size_)).first();
  }

  template <class T>
  bool take(const IntervalZero<T>& found, int j) {
    const double power = j == 0 ? static_cast<double>(order_) : 0.0, d = flow_.spacing();
    const auto x = static_cast<double>(found.x), lift = std::pow(x, power);
    if (found.low) {
      const double least = static_cast<double>(found.least) * std::pow(static_cast<double>(found.lowest), power);
      if (!truth_.low || least < truth_.least) truth_.least = least;
      truth_.low = true;
    }
    if (found.kind == Kind::none) return false;
    truth_.kind = found.kind;
    truth_.time = static_cast<double>((static_cast<long double>(j) + static_cast<long double>(found.x)) * d);
    truth_.slope = lift * std::abs(static_cast<double>(found.slope)) / d;
    truth_.bend = lift * std::abs(static_cast<double>(found.bend)) / (d * d);
    return true;
  }

  const ExactFlow& flow_;
  int guard_;
  const double* X_;
  int order_;
  Method method_;
  double size_;
  Truth truth_;
};

}  // namespace

Truth first_zero(const ExactFlow& flow, int guard, const double* X, int order, int intervals, Method method) {
  return Segment(flow, guard, X, order, method).first(intervals);
}

}  // namespace campaign
