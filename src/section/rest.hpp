#pragma once
/// The state of rest that a free motion comes to which has no more events: there X' = A X in one mode.
///
/// Modulo translations y' = Q y + q in the numbers y that the mode does not hold at zero. A state of rest is a solution
/// y* of Q y* + q = 0, the nearest if there are several, as where friction holds a mass anywhere in an interval; moves
/// along the null vectors of Q lead to others. Its eigenvalues are those of Q, less a 0 for each null vector.
#include "section/return_map.hpp"

namespace slapstick::section {

struct Rest {
  Eigen::VectorXd x;                              ///< contact state, representative of its class
  std::vector<std::complex<double>> eigenvalues;  ///< per unit of time, largest real part first
  int family = 0;                                 ///< dimensions of the continuum of states of rest
  bool held = false;                              ///< a contact sticks or a stop is closed
  /// all eigenvalues have a negative real part, and the motion nears it
  bool drawn = false;
  bool neutral = false;                           ///< the largest real part is zero but for rounding: closed curves
  double approach = 0.0;                          ///< how far the motion still was, relative to its size
  Eigen::VectorXd advance;                        ///< along each translation, per period
};

/// @param motion  stands where no event follows
/// @returns nothing if the mode has no state of rest, or an event follows all the same
/// @throws NumericalError as Motion::advance
[[nodiscard]] std::optional<Rest> rest(const flow::Translations& translations, Motion motion, Stop stop);

}  // namespace slapstick::section
