/// Tones and signals by the clock.
#include "mode/drive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/double_double.hpp"

namespace slapstick::mode {

Tone::Tone(double of_frequency, double period)
    : frequency(of_frequency), turns(of_frequency * period / (2.0 * std::numbers::pi)) {}

double Tone::at(Instant t) const {
  const DoubleDouble whole = two_product(turns, static_cast<double>(t.period)), part = two_product(turns, t.fraction);
  const auto within = [](double x) { return x - std::nearbyint(x); };
  return (within(whole.hi) + within(part.hi)) + (within(whole.lo) + part.lo);
}

SignalTable::SignalTable(const Signal& signal, double period) {
  const auto& knots = signal.knots;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    knots_.push_back(Instant{}.plus(knots[i].time / period));
    values_.push_back(knots[i].value);
    if (i + 1 < knots.size())
      slopes_.push_back((knots[i + 1].value - knots[i].value) / (knots[i + 1].time - knots[i].time) * period);
  }
  if (signal.repeats) length_ = (knots.back().time - knots.front().time) / period;
}

/// Rounds begin where the last knot of the round before was.
Instant SignalTable::knot(std::int64_t round, std::size_t i) const {
  if (round == 0) return knots_[i];
  const DoubleDouble shift = two_product(length_, static_cast<double>(round));
  return knots_[i].plus(shift.hi).plus(shift.lo);
}

SignalTable::Place SignalTable::place(Instant t) const {
  Place place;
  if (length_ == 0.0 && (t < knots_.front() || t >= knots_.back())) return {0, outside};
  if (length_ > 0.0) {
    place.round = static_cast<std::int64_t>(std::floor(t.since(knots_.front()) / length_));
    while (t < knot(place.round, 0)) --place.round;
    while (t >= knot(place.round + 1, 0)) ++place.round;
  }
  std::size_t low = 0, high = slopes_.size();  // knot low <= t < knot high
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (t < knot(place.round, middle) ? high : low) = middle;
  }
  place.piece = low;
  return place;
}

SignalTable::Value SignalTable::at(Instant t) const {
  const auto [round, piece] = place(t);
  if (piece == outside) return {t < knots_.front() ? values_.front() : values_.back(), 0.0};
  return {values_[piece] + slopes_[piece] * t.since(knot(round, piece)), slopes_[piece]};
}

Instant SignalTable::next(Instant t) const {
  const auto [round, piece] = place(t);
  if (piece == outside) return t < knots_.front() ? knots_.front() : never;
  const bool ends_round = piece + 1 == slopes_.size();
  return ends_round && length_ > 0.0 ? knot(round + 1, 0) : knot(round, piece + 1);
}

bool SignalTable::has_knot(Instant t) const {
  const auto [round, piece] = place(t);
  return piece == outside ? t == knots_.back() : t == knot(round, piece);
}

}  // namespace slapstick::mode
