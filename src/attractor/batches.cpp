/// Means of batches.
#include "attractor/batches.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace slapstick::attractor {

namespace {

double mean_of(const double* first, std::size_t count) {
  return std::accumulate(first, first + count, 0.0) / static_cast<double>(count);
}

/// Half the range of the sums of the deviations from the mean, over their number: what a rate that oscillates for ever
/// leaves in a mean. Batches of a multiple of its period do not see the oscillation.
double oscillation(const std::vector<double>& rates, double mean) {
  double walk = 0.0, low = 0.0, high = 0.0;
  for (const double rate : rates) {
    walk += rate - mean;
    low = std::min(low, walk), high = std::max(high, walk);
  }
  return 0.5 * (high - low) / static_cast<double>(rates.size());
}

}  // namespace

Mean batch_mean(const std::vector<double>& rates) {
  const std::size_t length = rates.size() / batches;
  const double mean = mean_of(rates.data(), rates.size());
  double squares = 0.0;
  for (int b = 0; b < batches; ++b) {
    const double apart = mean_of(rates.data() + b * length, length) - mean;
    squares += apart * apart;
  }
  return {mean, std::max(std::sqrt(squares / batches / (batches - 1)), oscillation(rates, mean))};
}

}  // namespace slapstick::attractor
