/// Steps, pulses and steep pieces of signals.
#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "model/fault.hpp"

namespace slapstick {

bool steps(const Signal& signal) {
  const auto& knots = signal.knots;
  const auto step = [](const auto& a, const auto& b) { return a.time == b.time && a.value != b.value; };
  if (std::adjacent_find(knots.begin(), knots.end(), step) != knots.end()) return true;
  return signal.repeats && !knots.empty() && knots.back().value != knots.front().value;
}

bool pulses(const Signal& signal) {
  return std::any_of(signal.knots.begin(), signal.knots.end(), [](const auto& knot) { return knot.pulse != 0.0; });
}

std::optional<SteepPiece> first_steep_piece(const Signal& signal, double period) {
  const auto& knots = signal.knots;
  if (knots.size() < 2 || !std::isfinite(period)) return std::nullopt;
  const auto [low, high] =
      std::minmax_element(knots.begin(), knots.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  const double range = high->value - low->value;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const double apart = knots[i].time - knots[i - 1].time;
    if (apart == 0.0) continue;  // a step
    const double least = 0x1p-26 * period * std::abs(knots[i].value - knots[i - 1].value) / range;
    if (apart < least)
      return SteepPiece{i, "time " + shown(knots[i].time) + " is only " + shown(apart) +
                               " after that of the point before, and events would be lost in such a steep step: " +
                               "leave " + shown(least) + " at least"};
  }
  return std::nullopt;
}

}  // namespace slapstick
