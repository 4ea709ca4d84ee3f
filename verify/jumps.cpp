/// Measures jumps of coordinates by their own sizes.
#include "jumps.hpp"

#include <algorithm>
#include <cmath>

namespace verify {
namespace {

constexpr double most_in_sum = 0x1p-24;

/// Eight roundings of 2^-53: a coordinate is a sum of stored numbers, each rounded once. Longer sums may be refused;
/// no sum is accepted wrongly.
constexpr double stored_rounding = 0x1p-50;

}  // namespace

Jumps::Jumps(const Mechanics& mechanics)
    : m_(mechanics), largest_(2 * mechanics.n(), 0.0), sum_(largest_), scale_(largest_), reach_(largest_) {}

void Jumps::add(const Balls& p, const Balls& u) {
  for (std::size_t i = 0; i < 2 * m_.n(); ++i) {
    const bool velocity = i >= m_.n();
    const double size = abs(dot(m_.to_coordinates(velocity)[i % m_.n()], velocity ? u : p)).highest();
    largest_[i] = std::max(largest_[i], size);
    sum_[i] += size;
  }
}

void Jumps::raise(const std::vector<double>& sizes, const std::vector<double>& of_numbers) {
  for (std::size_t i = 0; i < scale_.size(); ++i) {
    scale_[i] = std::max(scale_[i], sizes[i]);
    const bool velocity = i >= m_.n();
    double reach = 0.0;
    for (std::size_t j = 0; j < m_.n(); ++j)
      reach += std::abs(m_.to_coordinates(velocity)[i % m_.n()][j].near()) *
               of_numbers[(velocity ? m_.d() : 0) + m_.basis(velocity)[j]];
    reach_[i] = std::max(reach_[i], reach);
  }
}

void Jumps::raise_by_impulse(std::size_t number, double P) {
  for (std::size_t i = 0; i < m_.n(); ++i)
    scale_[m_.n() + i] = std::max(scale_[m_.n() + i], std::abs(m_.impulse_effect(i, number).near() * P));
}

void Jumps::widen(std::size_t number, double off) {
  for (std::size_t i = 0; i < m_.n(); ++i)
    if (!m_.impulse_effect(i, number).is_zero()) sum_[m_.n() + i] += static_cast<double>(m_.n()) * off;
}

bool Jumps::within_own(std::size_t i) const {
  return relative(largest_, i) <= rounding && relative(sum_, i) <= most_in_sum;
}

bool Jumps::by_rounding(std::size_t i) const {
  const bool still = scale_[i] <= rounding * reach_[i];
  return still || (largest_[i] <= stored_rounding * reach_[i] && relative(sum_, i) <= most_in_sum);
}

double Jumps::relative(const std::vector<double>& jumps, std::size_t i) const {
  return jumps[i] == 0.0 ? 0.0 : jumps[i] / scale_[i];
}

double Jumps::worst(const std::vector<double>& jumps, bool of_velocities) const {
  double most = 0.0;
  for (std::size_t i = 0; i < m_.n(); ++i) {
    const std::size_t k = i + (of_velocities ? m_.n() : 0);
    if (within_own(k) || !by_rounding(k)) most = std::max(most, relative(jumps, k));
  }
  return most;
}

long Jumps::check(long line, const Refuse& refuse) const {
  std::vector<bool> moved(m_.n());
  for (std::size_t i = 0; i < scale_.size(); ++i) {
    if (within_own(i)) continue;
    if (by_rounding(i)) {
      moved[i % m_.n()] = true;
      continue;
    }
    const std::string what = (i < m_.n() ? "coordinate " : "velocity ") + std::to_string(i % m_.n());
    if (!(relative(largest_, i) <= rounding))
      refuse(line, what + " jumps by " + digits(largest_[i]) + ", more than 2^-40 of what it is added up from, " +
                       digits(scale_[i]));
    else
      refuse(line, "all jumps of " + what + " together are " + digits(relative(sum_, i)) +
                       " of what it is added up from, more than 2^-24");
  }
  return std::count(moved.begin(), moved.end(), true);
}

}  // namespace verify
