/// The rates of a cascade from the bounce map's second fixed point, and limits of places by known rates.
#include "change/cascade_law.hpp"

#include <algorithm>
#include <cmath>

#include "base/bracketed_root.hpp"
#include "base/ranges.hpp"

namespace slapstick::orbit {

BounceRates bounce_rates(double restitution) {
  const double r = restitution;
  const double s = bracketed_root(
      [r](double sigma) { return (3.0 - sigma) * (1.0 - sigma) * (1.0 - sigma) - r * (3.0 - 2.0 * sigma); }, 0.0, 1.0,
      0x1p-53);
  const double left = 1.0 - s;
  const double by_sigma =  // d w' / d sigma
      r * ((0.5 - 2.0 * s / 3.0) / (left * left) + 2.0 * (s / 2.0 - s * s / 3.0) / (left * left * left));
  const double sigma_rate = (3.0 - 2.0 * s) / (2.0 * r - left * left - 2.0 * (3.0 - s) * left);
  return {s, left, by_sigma / (0.5 - s / 3.0), 0.5 * s - s * s / 6.0, (0.5 - s / 3.0) * sigma_rate};
}

std::vector<double> cascade_rates(double restitution, std::size_t count) {
  const BounceRates bounce = bounce_rates(restitution);
  std::vector<double> rates;
  const auto powers = static_cast<int>(count) + 2;
  for (int i = 0; i <= powers; ++i)
    for (int k = i == 0 ? 2 : 0; k <= powers; ++k)
      rates.push_back(std::pow(bounce.lambda, -i) * std::pow(bounce.mu, k));
  ranges::sort(rates, std::greater<>());
  rates.resize(count);
  return rates;
}

namespace {

using Row = std::vector<double>;

/// Each entry and the next one, put together with two weights.
Row combined(const Row& row, double own, double next) {
  Row result;
  for (std::size_t i = 0; i + 1 < row.size(); ++i) result.push_back(own * row[i] + next * row[i + 1]);
  return result;
}

}  // namespace

std::optional<PlaceLimit> limit_by_rates(const std::vector<double>& places, const std::vector<double>& errors,
                                         const std::vector<double>& rates) {
  std::optional<PlaceLimit> best;
  Row before = places, noise = errors;
  for (std::size_t M = 1; M < rates.size() && M + 2 <= places.size(); ++M) {
    const double q = rates[M - 1], next = rates[M];
    const Row limits = combined(before, 1.0 / (1.0 - q), -q / (1.0 - q));
    noise = combined(noise, 1.0 / (1.0 - q), q / (1.0 - q));
    double change = std::abs(limits[0] - limits[1]);
    if (limits.size() > 2) change = std::max(change, next * std::abs(limits[1] - limits[2]));
    const double error =
        next / (1.0 - next) * change + std::abs(limits[0] - before[0]) + q * std::abs(limits[1] - before[1]) + noise[0];
    if (M > 1 && (!best || error < best->error)) best = {limits[0], error};
    before = limits;
  }
  return best;
}

namespace {

/// D_0 of the law from the distances d_0, d_1 of three places, by iteration from zero:
///     D_0 = 2^(1/3) D_1^(7/3) / D_2^(4/3),     D_1 = D_0 + d_0, ..
std::optional<double> beyond_last(double d0, double d1) {
  constexpr int most_iterations = 100;
  double left = 0.0;
  for (int k = 0; k < most_iterations; ++k) {
    const double next = std::cbrt(2.0) * std::pow(left + d0, 7.0 / 3.0) / std::pow(left + d0 + d1, 4.0 / 3.0);
    if (!(next < d0)) return std::nullopt;
    if (next == left) break;
    left = next;
  }
  return left;
}

}  // namespace

std::optional<PlaceLimit> limit_with_friction(const std::vector<double>& places) {
  if (places.size() < 4) return std::nullopt;
  const auto limit = [&](std::size_t i) -> std::optional<double> {
    const double d0 = places[i] - places[i + 1], d1 = places[i + 1] - places[i + 2];
    if (!(d0 * d1 > 0.0)) return std::nullopt;
    const std::optional<double> left = beyond_last(std::abs(d0), std::abs(d1));
    return left ? std::optional(places[i] + std::copysign(*left, d0)) : std::nullopt;
  };
  const std::optional<double> now = limit(0), before = limit(1);
  if (!now || !before) return std::nullopt;
  return PlaceLimit{*now, std::abs(*now - *before)};
}

}  // namespace slapstick::orbit
