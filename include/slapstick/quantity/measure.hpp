#pragma once
/// Statistics of quantities over a motion, exact up to rounding: nothing is sampled.
///
/// Integrals are Gauss quadratures of the polynomials that quantities are on short steps; least and greatest values are
/// at the roots of their derivatives. An impulse counts in the mean, which is the integral over the time. An impulse
/// has no finite square and no greatest value: rms, least and greatest are those between impacts.
/// Threads: as the Motion's. Cost: some hundred nanoseconds a step and quantity, about two steps a window.
/// Source: docs/reference/measure.md; Golub and Welsch (1969) for the quadrature.
#include <array>
#include <atomic>
#include <complex>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "slapstick/flow/motion.hpp"
#include "slapstick/orbit/periodic_orbit.hpp"
#include "slapstick/quantity/quantity.hpp"

namespace slapstick {

/// Harmonics of a cycle that its statistics have.
inline constexpr int most_harmonics = 16;

/// Of a quantity over a time; of one at impacts over the impacts, each with the same weight.
struct Statistics {
  double mean = 0.0;  ///< with impulses
  double rms = 0.0, least = 0.0, greatest = 0.0;
  double least_at = 0.0, greatest_at = 0.0;  ///< time units after the start; the first of equals
  double impulse = 0.0;                      ///< sum of the impulses; of a quantity at impacts of its values
  long impulses = 0;                         ///< how many are not zero; of a quantity at impacts the impacts
  std::vector<double> values = {};           ///< of a quantity at impacts, in order of size
  /// Of a cycle c_1, c_2, ..: the quantity is its mean and the sum of Re(c_k exp(i k omega t)), impulses included.
  /// omega is that of the forcing, without forcing 2 pi over the cycle's duration.
  std::vector<std::complex<double>> harmonics = {};

  [[nodiscard]] double peak_to_peak() const { return greatest - least; }
  [[nodiscard]] double crest() const;  ///< largest absolute value over rms
  /// Of a quantity at impacts: the least value that a part q in [0, 1] of them does not exceed; NaN if there are none.
  [[nodiscard]] double quantile(double q) const;
  friend bool operator==(const Statistics&, const Statistics&) = default;
};

/// The impacts of one stop: the rigid ones, then the compliant ones.
struct StopStatistics {
  std::string stop;
  Statistics w, impulse, loss;  ///< the last two are empty of a compliant stop ..
  bool compliant = false;       ///< .. whose impacts are its engagements (section/stop_choice.hpp)
};

struct Measured {
  double duration = 0.0;  ///< time units
  std::vector<Statistics> of;
  std::vector<StopStatistics> stops;
  bool complete = true;  ///< false: stopped before the end; the statistics are those of `duration`
};

/// The statistics by name: the table that help and documents come from.
struct StatisticRule {
  std::string_view name, meaning;
};
[[nodiscard]] std::span<const StatisticRule> statistic_rules();

/// A statistic by name: "mean", "rms", "min", "max", "min_at", "max_at", "peak_to_peak", "crest", "impulse", "number";
/// of quantities at impacts also "q05" .. "q95" (part in percent); of cycles "h1" .. "h16" and "h1:phase" .., amplitude
/// and phase of amplitude cos(k omega t + phase).
/// @throws InputError that names the nearest, and for a harmonic of what is no cycle
[[nodiscard]] double statistic(const Statistics& of, const std::string& name);
/// Those that `measure` writes of a quantity if no statistic is named.
[[nodiscard]] std::vector<std::string> usual_statistics(const Quantity& quantity);
/// @throws InputError unless `statistic` knows the name for the quantity
void check_statistic(const Quantity& quantity, const std::string& name);
/// .. and if only a cycle has it: of a stretch of any motion.
void check_statistic_of_stretch(const Quantity& quantity, const std::string& name);

/// The motion from where it stands to `end`. What happens at its present instant does not count, what happens at `end`
/// does.
/// @param progress  if there is one, called now and then with the motion's time
/// @throws NumericalError as Motion::advance; InputError if `end` is not later
[[nodiscard]] Measured measure(Motion motion, Instant end, const std::vector<Quantity>& of,
                               const std::atomic<bool>* stop = nullptr,
                               const std::function<void(double periods)>& progress = {});

/// The cycle of an orbit, by its legs: also of one that is unstable, or no motion. Times count from phase 0 (without
/// forcing from event 0).
/// @throws NumericalError if a leg is too long for the rates of its mode
[[nodiscard]] Measured measure(const orbit::Problem& problem, const orbit::Orbit& orbit,
                               const std::vector<Quantity>& of);

/// The derivatives of `measure` of the cycle by each parameter of the problem's family, the others as they are: every
/// number is that number's derivative, of `values` in the same order; counts are 0. Exact up to rounding, by the
/// implicit function theorem on the orbit's equations, as long as the orbit keeps its events. Instants of extremes that
/// are flat to second order, and numbers that do not exist, are NaN.
/// Cost: for each parameter some times that of `measure`.
/// @throws NumericalError as measure, and where the orbit has no derivative: at a fold, or as one of a family;
/// InputError for a parameter among the quantities, and as Family::rate
[[nodiscard]] std::vector<Measured> measure_rates(const orbit::Problem& problem, const orbit::Orbit& orbit,
                                                  const std::vector<Quantity>& of);

/// The derivative of `statistic(of, name)`, `rate` the derivatives of `of`.
/// @throws InputError as statistic
[[nodiscard]] double statistic_rate(const Statistics& of, const Statistics& rate, const std::string& name);

}  // namespace slapstick
