/// Builds what drives a model: bases, forces, and bands of harmonics with random phases.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/elementary.hpp"
#include "base/ranges.hpp"
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
  term.silent = always_zero(part, "amplitude");
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
    terms.back().silent = always_zero(part.band.at("rms"));
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
    const auto& contacts = definition_.of("friction");
    const auto pressed = ranges::find(contacts, part.presses, &Part::name);
    const int presses = part.presses.empty() ? -1 : static_cast<int>(pressed - contacts.begin());
    for (const Term& one : terms) {
      if (presses >= 0 && (one.silent || silent_signal(one.signal))) continue;  // the contact's limits may be fixed
      add_force(model,
                {part.a, one.harmonic, written(one.amplitude), written(one.phase), written(one.frequency), one.signal,
                 false, presses},
                one.silent);
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
    sum += term.amplitude.value * (term.signal >= 0 ? at(signals_[static_cast<std::size_t>(term.signal)])
                                   : turning == 0.0 ? 1.0
                                                    : fixed::sin(turning * time + term.phase.value));
  }
  return sum;
}

}  // namespace slapstick
