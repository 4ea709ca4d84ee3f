#pragma once
/// The truth about one guard on one segment: its first zero, certainly.
#include "interval_zero.hpp"

namespace campaign {

/// How the truth is found.
enum class Method {
  quick,  ///< intervals excluded in doubles, the rest searched with 64 bits (interval_zero.hpp), in doubt with 113
  wide    ///< everything with 113 bits, the rest by interval_zero.hpp and by signs (sign_zero.hpp), which must agree
};

struct Truth {
  Kind kind = Kind::none;
  double time = 0.0;   ///< of the zero or touch
  double slope = 0.0;  ///< |h'| there
  double bend = 0.0;   ///< |h''| there
  bool low = false;    ///< was a minimum looked at?
  double least =
      0.0;  ///< then its value, the lowest of them (on the interval of a zero, what lies before it or just behind)
  double scale = 0.0;  ///< of h, what values are measured by
};

/// The first zero of a guard on (0, intervals * spacing], for the state X and the stored numbers of the mode.
///
/// An interval between two points of the grid is free of zeros where h > M d^2 / 8 at both of them, M >= |h''|: a
/// function lies at most that far below its chord. Where that does not hold the Taylor polynomial there is searched.
/// @param order  of the zero of h at the start, which is divided out; the first derivative that is not zero must be
/// positive
Truth first_zero(const ExactFlow& flow, int guard, const double* X, int order, int intervals, Method method);

}  // namespace campaign
