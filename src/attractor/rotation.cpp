/// Finds the strongest frequency of a sequence by averages with a smooth weight.
#include "attractor/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "base/bracketed_root.hpp"

namespace slapstick::attractor {

double bump(double t) { return std::exp(-1.0 / (t * (1.0 - t))); }

namespace {

using Complex = std::complex<double>;
using Points = std::span<const Complex>;

constexpr std::size_t fewest = 200;  ///< points of a half from which a frequency is read

/// The points with their weights, less their weighted mean.
std::vector<Complex> weighted(Points points) {
  const auto count = static_cast<double>(points.size());
  Complex sum = 0.0;
  double total = 0.0;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const double w = bump(static_cast<double>(k) / count);
    sum += w * points[k];
    total += w;
  }
  std::vector<Complex> values(points.size());
  for (std::size_t k = 1; k < points.size(); ++k)
    values[k] = bump(static_cast<double>(k) / count) * (points[k] - sum / total);
  return values;
}

double strength(const std::vector<Complex>& values, double frequency) {
  const Complex turn = std::polar(1.0, -2.0 * std::numbers::pi * frequency);
  Complex sum = 0.0;
  for (std::size_t k = values.size(); k-- > 0;) sum = sum * turn + values[k];  // Horner: the turn's error grows like k
  return std::norm(sum);
}

/// The strongest of frequencies spread over an interval.
double strongest(const std::vector<Complex>& values, double from, double to, int count) {
  double best = from, most = -1.0;
  for (int i = 0; i <= count; ++i) {
    const double frequency = from + (to - from) * i / count, here = strength(values, frequency);
    if (here <= most) continue;
    best = frequency;
    most = here;
  }
  return best;
}

/// Nearest to `guess`: the zero of the derivative, d/df |S|^2 = 2 Re(conj(S) S').
double sharpened(const std::vector<Complex>& values, double guess, double width) {
  const auto slope = [&](double frequency) {
    const Complex turn = std::polar(1.0, -2.0 * std::numbers::pi * frequency);
    Complex sum = 0.0, by_turn = 0.0;
    for (std::size_t k = values.size(); k-- > 0;) {
      by_turn = by_turn * turn + sum;
      sum = sum * turn + values[k];
    }
    return (std::conj(sum) * by_turn * turn * Complex(0.0, -1.0)).real();
  };
  const double a = guess - width, b = guess + width;
  return slope(a) > 0.0 && slope(b) < 0.0 ? bracketed_root(slope, a, b, 1e-17) : guess;
}

/// By doubling lengths, so that each search is over a few widths of a line.
double frequency_of(Points points) {
  std::size_t length = std::min<std::size_t>(points.size(), 512);
  double frequency = strongest(weighted(points.first(length)), 0.0, 1.0, static_cast<int>(2 * length));
  while (length < points.size()) {
    const double width = 2.0 / static_cast<double>(length);
    length = std::min(points.size(), 2 * length);
    frequency = strongest(weighted(points.first(length)), frequency - width, frequency + width, 32);
  }
  const std::vector<Complex> all = weighted(points);
  return sharpened(all, frequency, 0.5 / static_cast<double>(length));
}

double apart(double a, double b) { return std::abs(a - b - std::round(a - b)); }

/// The least q up to `most` with q f a whole number, f known to `error`; or 0.
int denominator(double frequency, double error, int most) {
  for (int q = 1; q <= most; ++q)
    if (apart(q * frequency, 0.0) < q * error) return q;
  return 0;
}

}  // namespace

Rotation rotation(std::vector<Complex> points) {
  constexpr int most_curves = 64, longest = 1000;
  constexpr double least_turns = 3.0;  // in half of the run: what only creeps, less its mean, makes 1.2
  Rotation found;
  for (int passes = 0; passes < 3; ++passes) {
    const std::size_t half = points.size() / 2;
    if (half < fewest) return {};
    const Points all = points;
    const double first = frequency_of(all.first(half)), second = frequency_of(all.last(half));
    const double error = std::max(apart(first, second), 1e-16);
    const double number = second - std::floor(second);
    found.number = std::min(number, 1.0 - number);
    found.digits = std::min(16.0, -std::log10(error));
    const double known = std::max(10.0 * error, 1e-12);
    // Nearer to a fraction the points have gone so little of a turn round their curves: what moves is something slow.
    // Wider: a slow rotation has no number. Narrower: what creeps beside a cycle has one, hardly other than a fraction.
    const double unmoved = 1e-3 / static_cast<double>(points.size());
    const int curves = denominator(number, std::max(known, unmoved), most_curves);
    if (found.number * static_cast<double>(half) < least_turns) found.digits = 0.0;
    if (curves == 0 || found.digits < 4.0) {
      found.locked = denominator(number, std::min(known, 1e-9), longest);
      return found;
    }
    std::vector<Complex> every;
    for (std::size_t k = 0; k < points.size(); k += static_cast<std::size_t>(curves)) every.push_back(points[k]);
    points = std::move(every);
    found.curves *= curves;
  }
  return {};
}

}  // namespace slapstick::attractor
