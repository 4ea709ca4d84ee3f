#pragma once
/// The least or greatest of values as they come, and the first place where it is.
///
/// Extremes of a symmetric motion tie: which of them is ahead is rounding. The first one stays then, so that a value,
/// its instant and the derivatives of both belong to one place, and to the same one for neighbouring parameters.
#include <algorithm>
#include <cmath>

namespace slapstick::quantity {

/// Is a piece no longer than some roundings of an instant, which is a part of a period? Between two events of one
/// instant a contact may be in a state for no time, and what is never there for a while is no extreme. A larger bound
/// would drop states that last, as of a body between two impacts; a smaller one would let rounding's states in.
inline bool has_no_length(double length, double period) { return length <= 0x1p-50 * period; }

class FirstExtreme {
 public:
  /// Of the largest value: far above the rounding of a cycle, some 1e-14 of it. A larger bound would give the instant
  /// of an extreme that is not the extreme, a smaller one an instant by chance.
  static constexpr double ties = 0x1p-40;

  /// Of a step: two extremes are not so near, and a value that ties with an extreme for its nearness is.
  static constexpr double part_of_step = 0x1p-6;

  static FirstExtreme least() { return FirstExtreme(1.0); }
  static FirstExtreme greatest() { return FirstExtreme(-1.0); }

  /// @param near  what is nearer to the place is the same extreme, as an end of a step beside it is: the better value
  ///   counts
  /// @returns whether the extreme's place is that of this value from now on
  bool note(double value, double at, double near) {
    const double v = sign_ * value;
    size_ = std::max(size_, std::abs(value));
    extreme_ = std::min(extreme_, v);
    const bool better = at_place_ - v > ties * size_, same = v < at_place_ && std::abs(at - place_) <= near;
    if (!better && !same) return false;
    at_place_ = v;
    place_ = at;
    return true;
  }
  /// The extreme itself.
  [[nodiscard]] double value() const { return sign_ * extreme_; }

 private:
  explicit FirstExtreme(double sign) : sign_(sign) {}

  double sign_, extreme_ = INFINITY, at_place_ = INFINITY, place_ = -INFINITY, size_ = 0.0;
};

}  // namespace slapstick::quantity
