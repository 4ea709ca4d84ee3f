/// Sums the harmonics of a cycle by Gauss's quadrature.
#include "quantity/harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/phase.hpp"
#include "quantity/quadrature.hpp"

namespace slapstick::quantity {
namespace {

using Complex = std::complex<double>;

constexpr double most_turns = 1.5;  ///< of the highest harmonic in a quadrature: 10 of the 14 that it has exactly

/// exp(-2 pi i turns)
Complex back_by(double turns) {
  const auto [cosine, sine] = of_turns(turns - std::floor(turns));
  return {cosine, -sine};
}

}  // namespace

void Harmonics::add(const Polynomial& f, const Polynomial* rate, const Step& step) {
  if (frequency_.value == 0.0) return;
  const double parts = std::max(1.0, std::ceil(most_harmonics * frequency_.value * step.length / most_turns)),
               part = 1.0 / parts;
  for (double i = 0.0; i < parts && step.length > 0.0; i += 1.0) {
    for (std::size_t k = 0; k < nodes; ++k) {
      const double x = (i + gauss().x[k]) * part, weight = gauss().weight[k] * part * step.length;
      add_at({weight * f.at(x), rate != nullptr ? weight * rate->at(x) : 0.0},
             {step.begin + x * step.length, step.piece_rate});
    }
  }
  if (step.from_rate != 0.0) add_end(-f.at(0.0), step.begin, step.from_rate);
  if (step.to_rate != 0.0) add_end(f.at(1.0), step.begin + step.length, step.to_rate);
}

void Harmonics::add(Number impulse, Number time) {
  if (frequency_.value != 0.0 && (impulse.value != 0.0 || impulse.rate != 0.0)) add_at(impulse, time);
}

void Harmonics::add_at(Number f, Number t) {
  const Number turns = frequency_ * t;
  const Complex z = back_by(turns.value), turning(0.0, -2.0 * std::numbers::pi * turns.rate);
  Complex power = 1.0;
  for (std::size_t k = 0; k < most_harmonics; ++k) {
    power *= z;
    value_[k] += f.value * power;
    rate_[k] += (f.rate + static_cast<double>(k + 1) * turning * f.value) * power;
  }
}

void Harmonics::add_end(double f, double t, double by) {
  const Complex z = back_by(frequency_.value * t);
  Complex power = 1.0;
  for (Complex& rate : rate_) {
    power *= z;
    rate += f * by * power;
  }
}

/// c = 2 S / T, c' = 2 (S' - S T' / T) / T.
Harmonics::Found Harmonics::over(Number duration) const {
  Found found;
  if (frequency_.value == 0.0) return found;
  for (std::size_t k = 0; k < most_harmonics; ++k) {
    found.value.push_back(2.0 / duration.value * value_[k]);
    found.rate.push_back(2.0 / duration.value * (rate_[k] - duration.rate / duration.value * value_[k]));
  }
  return found;
}

}  // namespace slapstick::quantity
