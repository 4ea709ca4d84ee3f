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
  std::vector<Signal::Knot> knots = signal.knots;
  // The end of a round is the start of the next one, which alone says what it is: two instants for one would differ.
  if (signal.repeats && knots[knots.size() - 2].time == knots.back().time) knots.pop_back();
  const double unit = signal.in_periods ? 1.0 : period;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    knots_.push_back(Instant{}.plus(knots[i].time / unit));
    values_.push_back(knots[i].value);
    pulses_.push_back(knots[i].pulse);
    if (i + 1 == knots.size()) break;
    const double rise = knots[i + 1].value - knots[i].value, apart = knots[i + 1].time - knots[i].time;
    slopes_.push_back(apart > 0.0 ? rise / apart * unit : 0.0);  // nothing is on a step
  }
  in_periods_ = signal.in_periods;
  if (signal.repeats) length_ = in_periods_ ? 1.0 : (knots.back().time - knots.front().time) / period;
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

double SignalTable::before(Instant t) const {
  if (!has_knot(t)) return at(t).value;
  const auto first_at_its_time = [&](std::size_t i) {
    while (i > 0 && knots_[i - 1] == knots_[i]) --i;
    return i;
  };
  const std::size_t piece = place(t).piece, last = knots_.size() - 1;
  const std::size_t i = first_at_its_time(piece == outside ? last : piece);
  return values_[i == 0 && length_ > 0.0 ? first_at_its_time(last) : i];
}

double SignalTable::pulse(Instant t) const {
  if (!has_knot(t)) return 0.0;
  const std::size_t piece = place(t).piece;
  return pulses_[piece == outside ? pulses_.size() - 1 : piece];
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

namespace {

/// The whole periods that bring a phase within half a period of another one.
double rounds_to(double phase, double turns) { return std::nearbyint(turns - phase); }

/// Since the first knot of a line, in the round in which the line's middle is nearest.
double since_begin(const Signal& signal, std::size_t i, double turns) {
  const double begin = signal.knots[i].time, middle = 0.5 * (begin + signal.knots[i + 1].time);
  return turns - rounds_to(middle, turns) - begin;
}

double slope_of(const Signal& signal, std::size_t i) {
  return (signal.knots[i + 1].value - signal.knots[i].value) / (signal.knots[i + 1].time - signal.knots[i].time);
}

}  // namespace

SignalTable::Value on_line(const Signal& signal, int line, double turns) {
  const auto i = static_cast<std::size_t>(line);
  const double slope = slope_of(signal, i);
  return {signal.knots[i].value + slope * since_begin(signal, i, turns), slope};
}

/// A value and an instant are each off by 2^-53 of themselves, and so are sums of them: a slope of two points is off by
/// no more than four such roundings of (|v_i| + |v_j| + |slope| (|t_i| + |t_j|)) / (t_j - t_i).
bool goes_straight_on(const Signal& signal, int line, int next) {
  const auto i = static_cast<std::size_t>(line), j = static_cast<std::size_t>(next);
  const Signal::Knot &end = signal.knots[i + 1], &begin = signal.knots[j];
  const auto rounding = [&](std::size_t of) {
    const Signal::Knot &from = signal.knots[of], &to = signal.knots[of + 1];
    const double times = std::abs(from.time) + std::abs(to.time), values = std::abs(from.value) + std::abs(to.value);
    return 0x1p-51 * (values + std::abs(slope_of(signal, of)) * times) / (to.time - from.time);
  };
  return end.pulse == 0.0 && end.value == begin.value &&
         std::abs(slope_of(signal, i) - slope_of(signal, j)) <= rounding(i) + rounding(j);
}

/// value = v_i + slope (t - t_i),  slope = (v_j - v_i) / (t_j - t_i)
SignalTable::Value line_rate(const Signal& signal, const Signal& rate, int line, double turns) {
  const auto i = static_cast<std::size_t>(line);
  const Signal::Knot &from = rate.knots[i], &to = rate.knots[i + 1];
  const double slope = slope_of(signal, i), length = signal.knots[i + 1].time - signal.knots[i].time;
  const double change = (to.value - from.value - slope * (to.time - from.time)) / length;
  return {from.value + change * since_begin(signal, i, turns) - slope * from.time, change};
}

double line_end(const Signal& signal, int line, double turns) {
  const double end = signal.knots[static_cast<std::size_t>(line) + 1].time;
  return end + rounds_to(end, turns);
}

double line_end_rate(const Signal& rate, int line) { return rate.knots[static_cast<std::size_t>(line) + 1].time; }

}  // namespace slapstick::mode
