#pragma once
/// Spectra of quantities, without sampling: Fourier integrals of the polynomials that quantities are on short steps,
/// and of the impulses of impacts, whose lines do not decay.
///
///     c_k = 1/T integral_0^T f(t) exp(-i w_k t) dt,   w_k = 2 pi k / T,   f(t) = c_0 + sum_k 2 |c_k| cos(w_k t + arg
///     c_k)
///
/// Each integral is a Gauss quadrature that is exact to rounding. There is no aliasing and no window for a cycle.
/// Cost: docs/reference/measure.md, section 6; beyond a dozen lines a node costs the same for any number of them.
/// Threads: as the Motion's.
/// Source: docs/reference/measure.md; Welch (1967) for averages over overlapping stretches; IEC 61260-1 for octaves,
/// IEC 61672-1 for the weighting A.
#include <atomic>
#include <complex>
#include <functional>
#include <vector>

#include "slapstick/flow/motion.hpp"
#include "slapstick/orbit/periodic_orbit.hpp"
#include "slapstick/quantity/quantity.hpp"

namespace slapstick {

/// A line of a cycle's spectrum; t counts from phase 0 (without forcing from event 0).
struct SpectralLine {
  double order = 0.0;      ///< in multiples of the forcing: k / n; without forcing of the cycle: k
  double frequency = 0.0;  ///< cycles per unit of time
  std::complex<double> c;
  [[nodiscard]] double amplitude() const { return order == 0.0 ? std::abs(c) : 2.0 * std::abs(c); }
  [[nodiscard]] double phase() const { return std::arg(c); }  ///< of the cosine, in (-pi, pi]
};

struct LineSpectrum {
  double duration = 0.0;            ///< of the cycle
  std::vector<SpectralLine> lines;  ///< from order 0 on
  /// Mean square of the quantity between impacts, and of the lines (Parseval): the share of what the lines leave out.
  double mean_square = 0.0, mean_square_of_lines = 0.0;
  long impulses = 0;  ///< in the cycle; with some the sum of all lines has no limit
};

/// The lines of a cycle up to an order.
/// @throws NumericalError as measure; InputError for a quantity at impacts, or an order that is not positive
[[nodiscard]] LineSpectrum spectrum(const orbit::Problem& problem, const orbit::Orbit& orbit, const Quantity& of,
                                    double highest_order);

struct DensityOptions {
  double stretch = 64.0;        ///< length of a stretch, forcing periods
  int stretches = 63;           ///< with half of each in the next one
  double highest_order = 20.0;  ///< multiples of the forcing; without forcing cycles per unit of time
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double periods)> progress = {};  ///< called now and then with the motion's time
};

/// One-sided power spectral density by Welch's method with the window of Hann.
struct DensitySpectrum {
  std::vector<double> order, frequency, density;  ///< density in unit^2 per unit of frequency
  int stretches = 0;
  double resolution = 0.0;  ///< noise bandwidth of the window: 1.5 / stretch, as a frequency
  double degrees_of_freedom = 0.0;
  double low = 0.0, high = 0.0;  ///< the density is between low and high times the one given, with 95 % confidence
  bool complete = true;
};

/// The motion from where it stands on. Frequencies below two of 1 / stretch, where the mean leaks, are left out.
/// @throws NumericalError as Motion::advance; InputError as spectrum
[[nodiscard]] DensitySpectrum density(Motion motion, const Quantity& of, const DensityOptions& options);

/// A band of an octave (parts 1) or a third (parts 3), with its mean square.
struct Band {
  double centre = 0.0, from = 0.0, to = 0.0;  ///< Hz
  double mean_square = 0.0;
  double weighted = 0.0;  ///< the same with each line, or frequency, weighted by A
  bool whole = true;      ///< the spectrum has all of the band: not so of one that the highest or lowest frequency cuts
};

/// Mean squares in the bands of what the spectrum has, be it one line. Frequencies are per `unit_of_time` seconds.
[[nodiscard]] std::vector<Band> octaves(const LineSpectrum& of, int parts, double unit_of_time = 1.0);
[[nodiscard]] std::vector<Band> octaves(const DensitySpectrum& of, int parts, double unit_of_time = 1.0);

/// The weighting A in decibels.
[[nodiscard]] double a_weighting(double hertz);

}  // namespace slapstick
