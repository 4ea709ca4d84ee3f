#pragma once
/// The rotation number of a motion on closed curves: how far round the curve each period brings it.
///
/// The stroboscopic points z_k (one displacement and its velocity, as a complex number) of a smooth quasi-periodic
/// motion are a sum of lines exp(2 pi i f k). The frequency of the strongest is found as the maximum of
///     |sum_k w(k / N) (z_k - mean) exp(-2 pi i f k)|,   w(t) = exp(-1 / (t (1 - t))),
/// which converges faster than any power of N, as the averages of Das, Sander and Yorke with the same weight do. Where
/// it is j / n for a small n the motion is on n curves in turn, and every n-th point is looked at instead.
#include <complex>
#include <vector>

namespace slapstick::attractor {

struct Rotation {
  double number = 0.0;  ///< turns of one curve per `curves` periods, in (0, 0.5]: orientation is not told
  double digits = 0.0;  ///< agreement of the numbers of both halves, decimal digits; 0: no rotation
  int curves = 1;
  /// The least q <= 1000 for which number = j / q as well as it is known, or 0: a long cycle, not a curve.
  int locked = 0;
};

/// @param points  one for each period, at least some 500; fewer give no rotation. Cost: some 1e7 additions
[[nodiscard]] Rotation rotation(std::vector<std::complex<double>> points);

/// w(t) above, for t in (0, 1).
[[nodiscard]] double bump(double t);

}  // namespace slapstick::attractor
