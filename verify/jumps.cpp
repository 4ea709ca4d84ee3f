/// Measures jumps of coordinates by their own sizes.
#include "jumps.hpp"

#include <algorithm>
#include <cmath>

namespace verify {
namespace {

constexpr double most_in_sum = 0x1p-24;

}  // namespace

Jumps::Jumps(const Mechanics& mechanics)
    : m_(mechanics), largest_(2 * mechanics.n(), 0.0), sum_(largest_), scale_(largest_) {}

void Jumps::add(const Balls& p, const Balls& u) {
  for (std::size_t i = 0; i < 2 * m_.n(); ++i) {
    const bool velocity = i >= m_.n();
    const double size = abs(dot(m_.to_coordinates()[i % m_.n()], velocity ? u : p)).highest();
    largest_[i] = std::max(largest_[i], size);
    sum_[i] += size;
  }
}

void Jumps::raise(const std::vector<double>& sizes) {
  for (std::size_t i = 0; i < scale_.size(); ++i) scale_[i] = std::max(scale_[i], sizes[i]);
}

void Jumps::raise_by_impulse(std::size_t number, double P) {
  for (std::size_t i = 0; i < m_.n(); ++i)
    scale_[m_.n() + i] = std::max(scale_[m_.n() + i], std::abs(m_.impulse_effect(i, number).near() * P));
}

void Jumps::widen(double off) {
  for (std::size_t i = m_.n(); i < sum_.size(); ++i) sum_[i] += static_cast<double>(m_.n()) * off;
}

double Jumps::relative(const std::vector<double>& jumps, std::size_t i) const {
  return jumps[i] == 0.0 ? 0.0 : jumps[i] / scale_[i];
}

double Jumps::worst(const std::vector<double>& jumps, bool of_velocities) const {
  double most = 0.0;
  for (std::size_t i = 0; i < m_.n(); ++i) most = std::max(most, relative(jumps, i + (of_velocities ? m_.n() : 0)));
  return most;
}

void Jumps::check(long line, const Refuse& refuse) const {
  for (std::size_t i = 0; i < scale_.size(); ++i) {
    const std::string what = (i < m_.n() ? "coordinate " : "velocity ") + std::to_string(i % m_.n());
    if (!(relative(largest_, i) <= rounding))
      refuse(line, what + " jumps by " + digits(largest_[i]) + ", more than 2^-40 of what it is added up from, " +
                       digits(scale_[i]));
    if (!(relative(sum_, i) <= most_in_sum))
      refuse(line, "all jumps of " + what + " together are " + digits(relative(sum_, i)) +
                       " of what it is added up from, more than 2^-24");
  }
}

}  // namespace verify
