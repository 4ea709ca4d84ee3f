/// Guesses the orbits beyond a change from motions near it.
#include "change/nearby_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/ranges.hpp"
#include "change/jump.hpp"
#include "orbit/cyclic.hpp"
#include "orbit/record.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::orbit {
namespace {

/// The legs that a motion from inside the first leg shows, until it ends one of the orbit's own legs as the orbit does;
/// the rest as in the orbit. Unlike a whole cycle of the motion it needs no stability.
std::optional<Orbit> spliced(const Orbit& orbit, Motion motion) {
  constexpr int most_events = 12;
  constexpr double at_its_time = 0.02;  // of a cycle
  const double cycle = orbit.t.back() - orbit.t.front();
  const Instant end = Instant{}.plus(orbit.t.back());
  EventReader reader(motion, 0);
  Orbit other = orbit;
  other.shape.legs.clear();
  other.x = {orbit.x[0]};
  other.t = {orbit.t[0]};
  for (int k = 0; k < most_events; ++k) {
    const std::optional<Seen> seen = reader.next(end);
    if (!seen) return std::nullopt;
    other.shape.legs.push_back(seen->leg);
    other.t.push_back(seen->t);
    for (std::size_t i = 0; i + 1 < orbit.legs(); ++i) {
      if (!(orbit.shape.legs[i] == seen->leg) || std::abs(orbit.t[i + 1] - seen->t) > at_its_time * cycle) continue;
      const auto from = static_cast<std::ptrdiff_t>(i) + 1;
      Orbit whole = other;
      whole.shape.legs.insert(whole.shape.legs.end(), orbit.shape.legs.begin() + from, orbit.shape.legs.end());
      whole.x.insert(whole.x.end(), orbit.x.begin() + from, orbit.x.end());
      whole.t.insert(whole.t.end(), orbit.t.begin() + from + 1, orbit.t.end());
      if (!(whole.shape.legs == orbit.shape.legs)) return whole;
    }
    other.x.push_back(seen->x);
  }
  return std::nullopt;
}

constexpr std::size_t most_shapes = 24;        ///< of a long, unstable cycle each motion near it is another
constexpr std::array parts = {0.5, 0.1, 0.9};  ///< of a leg's length, at which motions are begun

/// Cycles of other shapes that motions from inside an orbit's legs show, each shape once: whole cycles, and, from about
/// the leg at which the events change, pieces in place of the orbit's own.
class NearbyShapes {
 public:
  NearbyShapes(const Problem& problem, const Orbit& orbit)
      : orbit_(orbit), system_(problem.family().model(orbit.values)), set_(constant_family(system_.model()), {}) {}

  [[nodiscard]] std::vector<Orbit> about(std::size_t changed) {
    for (std::size_t before = 0; before < std::min<std::size_t>(3, orbit_.legs()); ++before) {
      Orbit turned = orbit_;
      rotate(turned, (changed + orbit_.legs() - before) % orbit_.legs());
      from(turned, 0, [&](const Motion& motion) {
        std::optional<Orbit> there = spliced(turned, motion);
        if (there) add(mended(*there));
        return there;
      });
    }
    for (std::size_t i = 0; i < orbit_.legs() && shapes_.size() < most_shapes; ++i)
      from(orbit_, (changed + i) % orbit_.legs(), [&](const Motion& motion) { return record(motion, orbit_.shape.n); });
    return std::move(shapes_);
  }

 private:
  template <class See>
  void from(const Orbit& orbit, std::size_t leg, const See& see) {
    for (const double part : parts) {
      try {
        if (const std::optional<Motion> motion = motion_from(system_, set_, orbit, leg, part)) add(see(*motion));
      } catch (const InputError&) {  // behind a stop
      } catch (const NumericalError&) {
      }
    }
  }

  /// A piece has been put in place of what is no motion in one leg. An orbit with a symmetry changes in several places
  /// at once: pieces there too.
  std::optional<Orbit> mended(Orbit orbit) const {
    constexpr int most_places = 8;
    for (int count = 0; count < most_places; ++count) {
      const std::vector<TestValue> tests = test_values(set_, orbit);
      const auto wrong =
          ranges::find_if(tests, [](const TestValue& test) { return test.test == Test::guard && test.value < 0.0; });
      if (wrong == tests.end()) return count > 0 ? std::optional(orbit) : std::nullopt;
      rotate(orbit, wrong->leg);
      std::optional<Orbit> next;
      for (const double part : parts) {
        const std::optional<Motion> motion = motion_from(system_, set_, orbit, 0, part);
        if (motion) next = spliced(orbit, *motion);
        if (next) break;
      }
      if (!next) return std::nullopt;
      orbit = std::move(*next);
    }
    return std::nullopt;
  }

  void add(std::optional<Orbit> seen) {
    const auto known = [&](const Orbit& other) { return same_cycle(other, *seen); };
    if (!seen || same_cycle(orbit_, *seen) || ranges::any_of(shapes_, known)) return;
    seen->values = orbit_.values;
    shapes_.push_back(std::move(*seen));
  }

  const Orbit& orbit_;
  System system_;
  ModeSet set_;
  std::vector<Orbit> shapes_;
};

}  // namespace

std::vector<Orbit> guess_sequences(const Problem& problem, const Orbit& orbit, std::size_t changed) {
  try {
    return NearbyShapes(problem, orbit).about(changed);
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace slapstick::orbit
