/// Fourier integrals of a quantity along a cycle, and along overlapping stretches of a motion.
#include "slapstick/quantity/spectrum.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "flow/compiled_system.hpp"
#include "quantity/fourier.hpp"
#include "quantity/leg_trace.hpp"
#include "quantity/tracer.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {
namespace quantity {
namespace {

void check(const Quantity& of, double highest_order) {
  if (of.at_impacts()) throw InputError("spectrum: " + in_quotes(of.name) + " is a quantity at impacts, not of time");
  if (!(highest_order > 0.0))
    throw InputError("spectrum: the highest order " + shown(highest_order) + " is not positive");
}

/// The part p of the distribution chi^2 over its degrees of freedom, by Wilson and Hilferty (1931); z: that of the
/// normal one.
double chi_square_part(double freedom, double z) {
  const double spread = 2.0 / (9.0 * freedom);
  return std::pow(1.0 - spread + z * std::sqrt(spread), 3);
}

/// Of the average over K stretches with the window of Hann, each half in the next one: neighbours correlate by (1/6)^2.
double degrees_of_freedom(double K) { return 2.0 * K / (1.0 + 2.0 * (K - 1.0) / K / 36.0); }

/// |X|^2 of the window of Hann, from the integrals without a window: X_k / 2 - X_{k-1} / 4 - X_{k+1} / 4.
double windowed(const std::vector<std::complex<double>>& first, const std::vector<std::complex<double>>& second,
                std::size_t k) {
  const auto X = [&](std::size_t i) { return i % 2 == 0 ? first[i] + second[i] : first[i] - second[i]; };
  return std::norm(0.5 * X(k) - 0.25 * (X(k - 1) + X(k + 1)));
}

}  // namespace
}  // namespace quantity

LineSpectrum spectrum(const orbit::Problem& problem, const orbit::Orbit& orbit, const Quantity& of,
                      double highest_order) {
  quantity::check(of, highest_order);
  const quantity::Cycle cycle(problem, orbit);
  const double T = cycle.duration().value, n = orbit.shape.n > 0 ? orbit.shape.n : 1.0;
  quantity::Fourier fourier(T, static_cast<std::size_t>(std::floor(highest_order * n)) + 1);
  const std::vector<Quantity> one = {of};
  quantity::Tracer tracer(cycle.model(), cycle.frame(), cycle.period(), one, fourier);
  cycle.trace(tracer);
  LineSpectrum found{T, {}, fourier.square() / T, 0.0, fourier.impulses()};
  for (const auto& sum : fourier.take()) {
    const auto k = static_cast<double>(found.lines.size());
    found.lines.push_back({k / n, k / T, sum / T});
    found.mean_square_of_lines += (k > 0.0 ? 2.0 : 1.0) * std::norm(sum / T);
  }
  return found;
}

DensitySpectrum density(Motion motion, const Quantity& of, const DensityOptions& options) {
  quantity::check(of, options.highest_order);
  const System system = motion.system();
  const double half = 0.5 * options.stretch, T = options.stretch * system.period();
  const double per_order = system.model().forced() ? options.stretch : T;  // points
  const auto count = static_cast<std::size_t>(std::floor(options.highest_order * per_order)) + 1;
  if (count < 3) throw InputError("spectrum: a stretch is too short for the highest order");
  quantity::Fourier fourier(T, count + 1);
  const std::vector<Quantity> one = {of};
  quantity::Tracer tracer(system.model(), system.compiled().frame(), {system.period(), 0.0}, one, fourier);
  std::vector<double> sums(count, 0.0);
  std::vector<std::complex<double>> before;
  const Instant start = motion.time();
  int stretches = 0;
  for (int i = 1; i <= options.stretches + 1; ++i) {
    if (!quantity::trace(motion, start.plus(i * half), tracer, options.stop, options.progress)) break;
    std::vector<std::complex<double>> now = fourier.take();
    for (std::size_t k = 2; k < count && i > 1; ++k) sums[k] += quantity::windowed(before, now, k);
    stretches += i > 1 ? 1 : 0;
    before = std::move(now);
  }
  DensitySpectrum found;
  found.complete = stretches == options.stretches;
  found.stretches = stretches;
  found.resolution = 1.5 / T;
  found.degrees_of_freedom = quantity::degrees_of_freedom(stretches);
  found.low = 1.0 / quantity::chi_square_part(found.degrees_of_freedom, 1.959963984540054);
  found.high = 1.0 / quantity::chi_square_part(found.degrees_of_freedom, -1.959963984540054);
  for (std::size_t k = 2; k < count; ++k) {
    found.order.push_back(static_cast<double>(k) / per_order);
    found.frequency.push_back(static_cast<double>(k) / T);
    found.density.push_back(2.0 * sums[k] / (0.375 * T * stretches));  // integral of the window's square: 3/8 T
  }
  return found;
}

}  // namespace slapstick
