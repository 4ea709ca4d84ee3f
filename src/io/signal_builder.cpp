/// Builds signals: from points, files and named shapes, those that repeat in forcing periods, and those of impulses.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "base/ranges.hpp"
#include "base/text.hpp"
#include "io/model_builder.hpp"
#include "io/number_rows.hpp"
#include "model/fault.hpp"

namespace slapstick {
namespace {

bool has_shape(const Part& part) { return part.texts.contains("shape"); }
bool repeats(const Part& part) { return part.flag("repeats") || has_shape(part); }
/// Are its times in forcing periods?
bool in_periods(const Part& part) {
  return part.flag("in_periods") || (has_shape(part) && !part.fields.contains("period"));
}

/// Do the times of its points, seen from the first one, depend on no parameter? All models of a family have the same
/// points.
bool has_fixed_times(const Part& part) {
  if (has_shape(part)) return part.texts.at("shape") == "sawtooth";
  return ranges::all_of(part.points, [](const Point& point) { return !point.at.expression; });
}

/// Is the last value the first one, whatever the parameters?
bool is_continuous(const Part& part, double first, double last) {
  if (has_shape(part)) return part.texts.at("shape") == "triangle" || part.texts.at("shape") == "trapezoid";
  const auto fixed = [](const Point& point) { return !point.force.expression; };
  return first == last && ranges::all_of(part.points, fixed);
}

/// How often one length goes into another: a whole number up to rounding, or 0.
double times_within(double length, double whole) {
  constexpr double decimal_rounding = 0x1p-46;  // of decimal numbers: 0.333333333333333 goes three times into 1
  const double times = std::nearbyint(whole / length);
  return std::abs(whole / length - times) <= decimal_rounding * times ? times : 0.0;
}

}  // namespace

/// Over one round, u from 0 to 1. A force sin(theta + phase) leads by its phase, and so does a shape: it begins at
/// u = -phase / (2 pi).
ModelBuilder::Points ModelBuilder::shape_points(const Part& part) const {
  const std::string& shape = part.texts.at("shape");
  const Dual low = field(part, "low", Dual{-1.0}), high = field(part, "high", Dual{1.0}), none{0.0}, whole{1.0};
  const Dual duty = field(part, "duty", Dual{0.5}), rise = field(part, "rise", Dual{0.1});
  const auto demand = [&](const char* key, const Dual& value, double least, double most) {
    if (value.value > least && value.value < most) return;
    const auto at = part.fields.find(key);
    throw InputError(
        definition_.place(at == part.fields.end() ? part.line : at->second.line),
        where(key) + " = " + shown(value.value) + " is not between " + shown(least) + " and " + shown(most));
  };
  for (const auto& [key, shapes] : {std::pair("duty", "square triangle trapezoid"), std::pair("rise", "trapezoid")})
    if (part.fields.contains(key) && std::string_view(shapes).find(shape) == std::string_view::npos)
      throw InputError(definition_.place(part.fields.find(key)->second.line),
                       where(key) + ": a " + shape + " has none (" + shapes + ")");
  demand("duty", duty, 0.0, 1.0);
  if (shape == "trapezoid") demand("rise", rise, 0.0, std::min(duty.value, 1.0 - duty.value));
  Points points;
  if (shape == "square") points = {{none, high}, {duty, high}, {duty, low}, {whole, low}};
  if (shape == "triangle") points = {{none, low}, {duty, high}, {whole, low}};
  if (shape == "sawtooth") points = {{none, low}, {whole, high}};
  if (shape == "trapezoid") points = {{none, low}, {rise, high}, {duty, high}, {duty + rise, low}, {whole, low}};
  const Dual round = field(part, "period", whole), shift = field(part, "phase") / Dual{2.0 * std::numbers::pi};
  for (auto& [time, value] : points) time = (time - shift) * round;
  return points;
}

ModelBuilder::Points ModelBuilder::signal_points(const Part& part) const {
  if (has_shape(part)) return shape_points(part);
  Points points;
  for (const auto& [time, value] : part.samples) points.emplace_back(Dual{time}, Dual{value});
  for (const Point& point : part.points) {
    const std::string place = where("points") + ": point " + std::to_string(points.size() + 1);
    points.emplace_back(dual(point.at, place + ": time"), dual(point.force, place + ": value"));
  }
  return points;
}

bool ModelBuilder::drives(const Part& signal) const {
  const auto follows = [&](const Part& part) {
    const auto named = part.texts.find("signal");
    return named != part.texts.end() && named->second == signal.name && !always_zero(part, "amplitude");
  };
  if (silent_signal(static_cast<int>(&signal - definition_.of("signal").data()))) return false;
  return ranges::any_of(definition_.of("force"), follows) || ranges::any_of(definition_.of("base"), follows);
}

std::optional<Dual> ModelBuilder::common_round() {
  const auto turns = [&](const Part& part) {  // a constant does not
    if (part.texts.contains("signal") || always_zero(part, "amplitude")) return false;
    return part.fields.contains("frequency") || !part.band.empty() || !always_zero(part, "harmonic");
  };
  const auto turns_at = [&](const Part& base) { return !base.band.empty() || ranges::any_of(base.harmonics, turns); };
  if (ranges::any_of(definition_.of("force"), turns)) return std::nullopt;
  if (ranges::any_of(definition_.of("base"), turns_at)) return std::nullopt;
  std::vector<Dual> rounds;
  bool in_time = true;
  each("signal", [&](const Part& part) {
    if (!drives(part)) return;
    in_time = in_time && repeats(part) && !in_periods(part);
    if (!in_time) return;
    const Points points = signal_points(part);
    rounds.push_back(points.back().first - points.front().first);
  });
  each("impulse", [&](const Part& part) {
    if (always_zero(part, "momentum")) return;
    in_time = in_time && part.fields.contains("period");
    if (in_time) rounds.push_back(field(part, "period"));
  });
  if (!in_time || rounds.empty()) return std::nullopt;
  const auto shorter = [](const Dual& a, const Dual& b) { return a.value < b.value; };
  const Dual longest = *std::max_element(rounds.begin(), rounds.end(), shorter);
  const auto fits = [&](const Dual& round) {
    return round.value > 0.0 && times_within(round.value, longest.value) > 0.0;
  };
  return ranges::all_of(rounds, fits) ? std::optional(longest) : std::nullopt;
}

/// Point (t, v) of round j of q is (t_0 / T + (j + (t - t_0) / length) / q, v). Between two rounds there is one point,
/// or a step. A line that always takes most of the period gets a point in its middle: see mode/drive.hpp.
ModelBuilder::Points ModelBuilder::over_a_period(const Part& part, Points points, const Dual& period) const {
  const auto at_one_time = [](const auto& a, const auto& b) { return a.first.value == b.first.value; };
  // At the ends of a round the step is that between two rounds: its outer values are never taken.
  if (points.size() > 2 && at_one_time(points[0], points[1])) points.erase(points.begin());
  if (points.size() > 2 && at_one_time(points.end()[-2], points.back())) points.pop_back();
  const Dual first = points.front().first, length = points.back().first - first;
  const double rounds = length.value > 0.0 ? times_within(length.value, period.value) : 0.0;
  if (rounds == 0.0)
    throw InputError(definition_.place(part.line),
                     where("in_periods") + ": from the first point to the last there are " + shown(length.value) +
                         " forcing periods; a period must hold a whole number of rounds (a record over two periods: "
                         "halve omega, and double the harmonics)");
  const bool joins = is_continuous(part, points.front().second.value, points.back().second.value);
  constexpr double longest_gap =
      0.75;  // a point more is a coincidence more on branches, so no point is added without need
  Points all;
  for (double round = 0.0; round < rounds; round += 1.0) {
    if (round > 0.0 && joins) all.pop_back();
    for (const auto& [time, value] : points) {
      const Dual at = first / period + (Dual{round} + (time - first) / length) / Dual{rounds};
      if (!all.empty() && has_fixed_times(part) && at.value - all.back().first.value > longest_gap)
        all.emplace_back(Dual{0.5} * (all.back().first + at), Dual{0.5} * (all.back().second + value));
      all.emplace_back(at, value);
    }
  }
  return all;
}

void ModelBuilder::add_signals(Model& model) {
  each("signal", [&](const Part& part) {
    Points points = signal_points(part);
    Signal signal{part.name, {}, repeats(part), in_periods(part) || (round_ && drives(part))};
    if (signal.in_periods && !definition_.omega && !round_)
      throw InputError(definition_.place(part.line),
                       where("in_periods") + ": its times are in forcing periods, and the file has no 'omega'" +
                           (has_shape(part) ? "; or give its 'period'" : ""));
    if (signal.in_periods && signal.repeats)
      points = over_a_period(part, std::move(points), in_periods(part) ? Dual{1.0} : *round_);
    for (const auto& [time, value] : points) signal.knots.push_back({written(time), written(value)});
    origins_["signal"].push_back({kind_, index_});
    model.signals.push_back(std::move(signal));
    knots_.push_back(std::move(points));
  });
  signals_ = model.signals;
}

/// (time, momentum). One that repeats is in the middle of its round, where it is no end of a line: half a round before
/// and behind it there is nothing. One that comes once has nothing at the start.
ModelBuilder::Points ModelBuilder::impulse_points(const Part& part) const {
  const Dual momentum = field(part, "momentum"), none{0.0};
  if (part.fields.contains("phase")) {
    Dual turns = field(part, "phase") / Dual{2.0 * std::numbers::pi};
    turns.value -= std::floor(turns.value);
    return {{turns - Dual{0.5}, none}, {turns, momentum}, {turns + Dual{0.5}, none}};
  }
  const Dual time = field(part, "time"), period = field(part, "period");
  const auto demand_positive = [&](const char* key, const Dual& number) {
    if (number.value > 0.0) return;
    throw InputError(definition_.place(part.fields.find(key)->second.line),
                     where(key) + " = " + shown(number.value) + " is not positive");
  };
  if (!part.fields.contains("period")) {
    demand_positive("time", time);
    return {{none, none}, {time, momentum}};
  }
  demand_positive("period", period);
  return {{time - Dual{0.5} * period, none}, {time, momentum}, {time + Dual{0.5} * period, none}};
}

/// An impulse is a force that follows a signal of pulses.
void ModelBuilder::add_impulses(Model& model) {
  each("impulse", [&](const Part& part) {
    const bool by_phase = part.fields.contains("phase"), comes_back = by_phase || part.fields.contains("period");
    const bool silent = always_zero(part, "momentum");
    Points points = impulse_points(part);
    Signal signal{part.name, {}, comes_back, by_phase || (comes_back && round_ && !silent)};
    if (signal.in_periods && !definition_.omega && !round_)
      throw InputError(
          definition_.place(part.fields.find("phase")->second.line),
          where("phase") + ": a phase of the forcing, and the file has no 'omega': give a time and a period");
    if (signal.in_periods) points = over_a_period(part, std::move(points), by_phase ? Dual{1.0} : *round_);
    for (const auto& [time, momentum] : points) signal.knots.push_back({written(time), 0.0, written(momentum)});
    origins_["signal"].push_back({kind_, index_});
    model.signals.push_back(std::move(signal));
    const double whole = written(Dual{1.0});
    add_force(model, {part.a, 0, whole, 0.0, 0.0, static_cast<int>(model.signals.size()) - 1}, silent);
  });
}

/// (time, jump of the slope). Of a signal that repeats the round begins and ends within its first line, where there is
/// no jump: its own ends have one.
ModelBuilder::Points ModelBuilder::speed_jumps(int signal) const {
  const Points& knots = knots_[static_cast<std::size_t>(signal)];
  const Signal& of = signals_[static_cast<std::size_t>(signal)];
  const Dual unit = of.in_periods ? Dual{2.0 * std::numbers::pi} / omega_ : Dual{1.0}, none{0.0};
  const std::size_t lines = knots.size() - 1;
  const auto slope = [&](std::size_t i) {
    return (knots[i + 1].second - knots[i].second) / ((knots[i + 1].first - knots[i].first) * unit);
  };
  Points jumps;
  if (!of.repeats) jumps.emplace_back(knots.front().first, slope(0));
  for (std::size_t i = 1; i < lines; ++i) jumps.emplace_back(knots[i].first, slope(i) - slope(i - 1));
  jumps.emplace_back(knots.back().first, (of.repeats ? slope(0) : none) - slope(lines - 1));
  if (!of.repeats) return jumps;
  const Dual middle = Dual{0.5} * (knots[0].first + knots[1].first);
  jumps.emplace(jumps.begin(), middle, none);
  jumps.emplace_back(middle + (knots.back().first - knots.front().first), none);
  return jumps;
}

int ModelBuilder::acceleration_of(Model& model, int signal, std::string_view base) {
  if (const auto made = accelerations_.find(signal); made != accelerations_.end()) return made->second;
  const Signal& of = signals_[static_cast<std::size_t>(signal)];
  const auto at_once = [](const auto& a, const auto& b) { return a.first.value == b.first.value; };
  const Points& points = knots_[static_cast<std::size_t>(signal)];
  if (std::adjacent_find(points.begin(), points.end(), at_once) != points.end() ||
      (of.repeats && points.front().second.value != points.back().second.value))
    throw InputError(definition_.place(definition_.of(kind_)[index_].line),
                     where("base") + ": " + in_quotes(base) + " moves by signal " + in_quotes(of.name) +
                         ", which steps: what is measured from it would be elsewhere at once; write a ramp");
  Signal jumps{of.name + "''", {}, of.repeats, of.in_periods, true};
  for (const auto& [time, jump] : speed_jumps(signal)) jumps.knots.push_back({written(time), 0.0, written(jump)});
  origins_["signal"].push_back({kind_, index_});
  model.signals.push_back(std::move(jumps));
  return accelerations_[signal] = static_cast<int>(model.signals.size()) - 1;
}

/// A piece of a record that is too steep, with the row of its file.
void ModelBuilder::demand_resolved_records(const Model& model) {
  each("signal", [&](const Part& part) {
    if (part.record.empty()) return;
    Signal round{part.name, {}};
    for (const auto& [time, value] : signal_points(part)) round.knots.push_back({time.value, value.value});
    const auto steep = first_steep_piece(round, in_periods(part) ? 1.0 : model.forcing_period());
    if (steep)
      throw InputError(definition_.place(part.line),
                       where("file") + ": " + line_of(part.record, part.rows[steep->end]) + steep->what);
  });
}

}  // namespace slapstick
