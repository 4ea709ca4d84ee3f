/// Builds what drives a model: signals, bases, forces, and bands of harmonics with random phases.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include "base/elementary.hpp"
#include "base/text.hpp"
#include "io/model_builder.hpp"

namespace slapstick {
namespace {

/// Numbers in [0, 1) that follow from a seed: SplitMix64 (Steele, Lea, Flood 2014).
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : state_(seed) {}
  double next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

/// The signal at a time, by its straight lines.
double value_at(const Signal& signal, double time) {
  const auto& knots = signal.knots;
  const double first = knots.front().time, length = knots.back().time - first;
  if (signal.repeats) time -= length * std::floor((time - first) / length);
  const auto above =
      std::find_if(knots.begin(), knots.end(), [&](const Signal::Knot& knot) { return knot.time > time; });
  if (above == knots.begin()) return knots.front().value;
  if (above == knots.end()) return knots.back().value;
  const Signal::Knot& below = *(above - 1);
  return below.value + (above->value - below.value) * ((time - below.time) / (above->time - below.time));
}

}  // namespace

ModelBuilder::Points ModelBuilder::signal_points(const Part& part) const {
  Points points;
  for (const auto& [time, value] : part.samples) points.emplace_back(Dual{time}, Dual{value});
  for (const Point& point : part.points) {
    const std::string place = where("points") + ": point " + std::to_string(points.size() + 1);
    points.emplace_back(dual(point.at, place + ": time"), dual(point.force, place + ": value"));
  }
  return points;
}

namespace {

/// How often one length goes into another, if it is a whole number of times but for rounding; else 0.
double times_within(double length, double whole) {
  constexpr double rounding = 0x1p-46;  // of decimal numbers: 0.333333333333333 goes three times into 1
  const double times = std::nearbyint(whole / length);
  return std::abs(whole / length - times) <= rounding * times ? times : 0.0;
}

}  // namespace

std::optional<Dual> ModelBuilder::common_round() {
  const auto own = [](const Part& part) { return part.fields.contains("frequency"); };
  const auto& signals = definition_.of("signal");
  if (definition_.omega || signals.empty()) return std::nullopt;
  if (std::ranges::any_of(definition_.of("force"), own)) return std::nullopt;
  for (const Part& base : definition_.of("base"))
    if (std::ranges::any_of(base.harmonics, own)) return std::nullopt;
  const auto in_time = [](const Part& part) { return part.flag("repeats") && !part.flag("in_periods"); };
  if (!std::ranges::all_of(signals, in_time)) return std::nullopt;
  std::vector<Dual> rounds;
  each("signal", [&](const Part& part) {
    const Points points = signal_points(part);
    rounds.push_back(points.back().first - points.front().first);
  });
  const auto shorter = [](const Dual& a, const Dual& b) { return a.value < b.value; };
  const Dual longest = *std::ranges::max_element(rounds, shorter);
  const auto fits = [&](const Dual& round) { return round.value > 0.0 && times_within(round.value, longest.value) > 0.0; };
  return std::ranges::all_of(rounds, fits) ? std::optional(longest) : std::nullopt;
}

/// Point (t, v) of round j of q is (t_0 / T + (j + (t - t_0) / length) / q, v). Between two rounds there is one point, or
/// a step.
ModelBuilder::Points ModelBuilder::over_a_period(const Part& part, const Points& points, const Dual& period) const {
  const Dual first = points.front().first, length = points.back().first - first;
  const double rounds = length.value > 0.0 ? times_within(length.value, period.value) : 0.0;
  if (rounds == 0.0)
    throw InputError(definition_.place(part.line),
                     where("in_periods") + ": from the first point to the last there are " + shown(length.value) +
                         " forcing periods; a period must hold a whole number of rounds (a record over two periods: "
                         "halve omega, and double the harmonics)");
  const bool steps = points.back().second.value != points.front().second.value;
  Points all;
  for (double round = 0.0; round < rounds; round += 1.0) {
    if (round > 0.0 && !steps) all.pop_back();
    for (const auto& [time, value] : points)
      all.emplace_back(first / period + (Dual{round} + (time - first) / length) / Dual{rounds}, value);
  }
  return all;
}

void ModelBuilder::add_signals(Model& model) {
  each("signal", [&](const Part& part) {
    Points points = signal_points(part);
    Signal signal{part.name, {}, part.flag("repeats"), part.flag("in_periods") || round_.has_value()};
    if (signal.in_periods && !definition_.omega && !round_)
      throw InputError(definition_.place(part.line), where("in_periods") + ": the file has no 'omega'");
    if (signal.in_periods && signal.repeats) points = over_a_period(part, points, round_.value_or(Dual{1.0}));
    for (const auto& [time, value] : points) signal.knots.push_back({written(time), written(value)});
    origins_["signal"].push_back({kind_, index_});
    model.signals.push_back(std::move(signal));
  });
  signals_ = model.signals;
}

int ModelBuilder::signal(const Part& part) const {
  const auto named = part.texts.find("signal");
  if (named == part.texts.end()) return -1;
  const auto& all = definition_.of("signal");
  const auto found = std::find_if(all.begin(), all.end(), [&](const Part& one) { return one.name == named->second; });
  return static_cast<int>(found - all.begin());
}

/// Of a force, or of one harmonic of a base. @param place  "force 1: " or "base 'road': harmonics 2: "
ModelBuilder::Term ModelBuilder::term(const Part& part, const std::string& place) const {
  const auto of = [&](const char* key) { return at(part, key, {}, [&] { return place + key; }); };
  Term term{of("amplitude"), 0, of("phase")};
  term.frequency = of("frequency");
  term.signal = signal(part);
  const bool timed = part.fields.contains("frequency") || term.signal >= 0;
  if (part.fields.contains("frequency") && !(term.frequency.value > 0.0))
    throw InputError(definition_.place(part.fields.at("frequency").line),
                     place + "frequency = " + shown(term.frequency.value) + " is not positive");
  if (!timed) term.harmonic = harmonic(part, [&] { return place + "harmonic"; });
  return term;
}

/// Harmonics from `from` to `to` of equal amplitude, sqrt(2 / lines) rms, with phases drawn from the seed: the rms of
/// their sum over a period is `rms`.
std::vector<ModelBuilder::Term> ModelBuilder::band(const Part& part) const {
  const auto whole = [&](const char* key, double fallback) {
    const auto found = part.band.find(key);
    return found == part.band.end() ? fallback : found->second.number;
  };
  const double from = whole("from", 1), to = whole("to", 1), lines = whole("lines", to - from + 1);
  const Dual amplitude = dual(part.band.at("rms"), where("band") + ": rms") * Dual{std::sqrt(2.0 / lines)};
  Draw draw(static_cast<std::uint64_t>(whole("seed", 0)));
  std::vector<Term> terms;
  for (double k = 0; k < lines; ++k) {
    const double order = lines == 1 ? from : from + std::floor(k * (to - from) / (lines - 1) + 0.5);
    terms.push_back({amplitude, static_cast<int>(order), Dual{2.0 * std::numbers::pi * draw.next()}});
  }
  return terms;
}

void ModelBuilder::add_bases() {
  each("base", [&](const Part& part) {
    auto& terms = bases_.emplace_back(part.band.empty() ? std::vector<Term>{} : band(part));
    if (const int of = signal(part); of >= 0) terms.push_back({Dual{1.0}, 0, {}, {}, of});
    for (const auto& one : part.harmonics)
      terms.push_back(term(one, where("harmonics ") + std::to_string(terms.size() + 1) + ": "));
  });
}

void ModelBuilder::add_forces(Model& model) {
  each("force", [&](const Part& part) {
    const std::vector<Term> terms = part.band.empty() ? std::vector{term(part, where(""))} : band(part);
    for (const Term& one : terms) {
      origins_["force"].push_back({kind_, index_});
      model.forces.push_back({part.a, one.harmonic, written(one.amplitude), written(one.phase), written(one.frequency),
                              one.signal, false});
    }
  });
}

double ModelBuilder::base(std::size_t k, double omega, double time) const {
  double sum = 0.0;
  for (const Term& term : bases_[k]) {
    const double turning = term.frequency.value != 0.0 ? term.frequency.value : term.harmonic * omega;
    const auto at = [&](const Signal& signal) {
      return value_at(signal, signal.in_periods ? time * omega / (2.0 * std::numbers::pi) : time);
    };
    sum += term.amplitude.value * (term.signal >= 0  ? at(signals_[static_cast<std::size_t>(term.signal)])
                                   : turning == 0.0 ? 1.0
                                                    : fixed::sin(turning * time + term.phase.value));
  }
  return sum;
}

}  // namespace slapstick
