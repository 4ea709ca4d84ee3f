/// What must not matter: which way an axis points, which partner of a contact is called a, where a run is cut, and
/// whether it is started anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "property/property.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::test {
namespace {

constexpr std::size_t most_events = 300;

struct Step {
  Event event;
  State before, after;
};

std::vector<Step> follow(const System& system, const State& start, Instant end, Instant begin = {},
                         const std::vector<Instant>& cuts = {}) {
  Motion motion(system, start, begin);
  std::vector<Step> steps;
  const auto until = [&](Instant t) {
    while (steps.size() < most_events && motion.advance(t) == Outcome::event)
      steps.push_back({motion.event(), {motion.before().begin(), motion.before().end()}, motion.state()});
  };
  for (const Instant cut : cuts) until(cut);
  until(end);
  return steps;
}

std::string say(const Step& s) {
  char text[120];
  std::snprintf(text, sizeof text, "%s of contact %d at %ld + %.17g, w = %.17g",
                std::string(name(s.event.kind)).c_str(), s.event.contact, static_cast<long>(s.event.time.period),
                s.event.time.fraction, s.event.w);
  return text;
}

std::string differ(std::size_t i, const std::vector<Step>& a, const std::vector<Step>& b) {
  return "event " + std::to_string(i) + ": " + (i < a.size() ? say(a[i]) : "none") + " and " +
         (i < b.size() ? say(b[i]) : "none");
}

EventKind turned(EventKind kind) {
  if (kind == EventKind::slip_plus) return EventKind::slip_minus;
  return kind == EventKind::slip_minus ? EventKind::slip_plus : kind;
}

State negative(State s) {
  for (double& x : s) x = -x;
  return s;
}

/// The machine seen in a mirror: x -> -x. Stops and polylines are on the other side; friction contacts stay as they are
/// and slip the other way.
Machine mirrored(Machine machine) {
  machine.start = negative(machine.start);
  for (Force& f : machine.model.forces) f.amplitude = -f.amplitude;
  for (FrictionContact& f : machine.model.frictions) f.belt_speed = -f.belt_speed;
  for (Stop& s : machine.model.stops) std::swap(s.a, s.b);
  for (CompliantStop& c : machine.model.compliant_stops) std::swap(c.a, c.b);
  for (Characteristic& c : machine.model.characteristics) std::swap(c.a, c.b);
  for (FrictionContact& f : machine.model.frictions) {
    if (!f.normal) continue;
    for (NormalForce::Term& t : f.normal->terms) t.stiffness = -t.stiffness, t.damping = -t.damping;
  }
  return machine;
}

bool same_bits(const Step& a, const Step& b, double sign_of_friction, int stops, int frictions) {
  const bool friction = a.event.contact >= stops && a.event.contact < stops + frictions;
  return a.event.time == b.event.time && a.event.contact == b.event.contact &&
         a.event.w == (friction ? sign_of_friction : 1.0) * b.event.w && a.event.error == b.event.error;
}

/// Machines of a shape, and those that have every law of force besides.
void expect_of_both(Shape shape, int count, const Law& law) {
  expect_of_all(shape, count, law);
  shape.most_compliant = 2, shape.laws = true;
  expect_of_all(shape, count, law);
}

TEST(Symmetry, AMirroredMachineHasTheMirroredBits) {
  expect_of_both({.most_frictions = 3, .loops = false}, 300, [](const Machine& machine) -> std::string {
    const Machine image = mirrored(machine);
    const System system(machine.model), other(image.model);
    const auto a = follow(system, machine.start, {5, 0.0}), b = follow(other, image.start, {5, 0.0});
    const int stops = static_cast<int>(machine.model.stops.size()),
              frictions = static_cast<int>(machine.model.frictions.size());
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
      if (i >= a.size() || i >= b.size() || a[i].event.kind != turned(b[i].event.kind) ||
          !same_bits(a[i], b[i], -1.0, stops, frictions) || a[i].after != negative(b[i].after) ||
          a[i].before != negative(b[i].before))
        return differ(i, a, b);
    }
    return "";
  });
}

TEST(Symmetry, WhichPartnerOfAFrictionContactIsCalledAIsAConvention) {
  expect_of_both({.most_frictions = 3, .loops = false}, 200, [](const Machine& machine) -> std::string {
    Machine image = machine;
    for (FrictionContact& f : image.model.frictions) std::swap(f.a, f.b), f.belt_speed = -f.belt_speed;
    const System system(machine.model), other(image.model);
    const auto a = follow(system, machine.start, {5, 0.0}), b = follow(other, image.start, {5, 0.0});
    const int stops = static_cast<int>(machine.model.stops.size()),
              frictions = static_cast<int>(machine.model.frictions.size());
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
      if (i >= a.size() || i >= b.size() || a[i].event.kind != turned(b[i].event.kind) ||
          !same_bits(a[i], b[i], -1.0, stops, frictions) || a[i].after != b[i].after || a[i].before != b[i].before)
        return differ(i, a, b);
    }
    return "";
  });
}

/// Bounces just before the limit of a chatter: a cut among them spends one proof, and one bounce more is listed.
std::vector<Step> without_last_bounces(std::vector<Step> steps) {
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i].event.kind != EventKind::chatter) continue;
    std::size_t first = i;
    while (first > 0 && steps[i].event.time.since(steps[first - 1].event.time) < 1e-6) --first;
    steps.erase(steps.begin() + static_cast<long>(first), steps.begin() + static_cast<long>(i));
    i = first;
  }
  return steps;
}

TEST(Symmetry, ACutAnywhereChangesNoBit) {
  expect_of_both({}, 300, [](const Machine& machine) -> std::string {
    const System system(machine.model);
    std::mt19937_64 random(machine.seed);
    const auto plain = follow(system, machine.start, {5, 0.0});
    std::vector<Instant> cuts;
    for (int i = 0; i < 40; ++i) cuts.push_back(Instant{}.plus(std::uniform_real_distribution<double>(0, 5)(random)));
    for (std::size_t i = 0; i < plain.size(); i += 7) cuts.push_back(plain[i].event.time);
    std::ranges::sort(cuts);
    const auto a = without_last_bounces(plain),
               b = without_last_bounces(follow(system, machine.start, {5, 0.0}, {}, cuts));
    bool same = true;  // up to a chatter inside which a cut fell
    for (std::size_t i = 0; i < std::min(a.size(), b.size()) && same; ++i) {
      if (a[i].event.kind != b[i].event.kind || a[i].event.contact != b[i].event.contact) return differ(i, a, b);
      same = a[i].event.kind != EventKind::chatter || (a[i].event.time == b[i].event.time && a[i].after == b[i].after);
      if (same && (a[i].event.time != b[i].event.time || a[i].after != b[i].after)) return differ(i, a, b);
    }
    return "";
  });
}

/// A restart knows the coordinates to a rounding only: a contact at rest may find itself an ulp beside it and come to
/// rest again, which is over within `settled`. Then all goes on as before, up to what a rounding can move: the time of
/// an event by its root (of a touch).
TEST(Symmetry, ARunStartedAnewAnywhereHasTheSameEvents) {
  constexpr double settled = 1e-6, moved = 1e-7;
  long compared = 0;
  expect_of_both({.loops = false}, 300, [&](const Machine& machine) -> std::string {
    const System system(machine.model);
    std::mt19937_64 random(machine.seed);
    Motion motion(system, machine.start);
    const Instant cut = Instant{}.plus(std::uniform_real_distribution<double>(0, 3)(random));
    for (std::size_t i = 0; i < most_events && motion.advance(cut) == Outcome::event; ++i) continue;
    if (motion.time() != cut) return "";
    const State at_cut = motion.state();
    std::vector<Step> a = follow(system, machine.start, cut.plus(1.0)), b = follow(system, at_cut, cut.plus(1.0), cut);
    const auto early = [&](const Step& s) { return s.event.time < cut.plus(settled); };
    if (std::ranges::any_of(a, [&](const Step& s) { return std::abs(s.event.time.since(cut)) < 2 * settled; }))
      return "";
    std::erase_if(a, early), std::erase_if(b, early);
    for (std::size_t i = 0; i < std::min(a.size(), std::size_t{5}); ++i, ++compared) {
      const bool touch = a[i].event.kind == EventKind::impact && a[i].event.w < 1e-6;
      if (touch || a[i].event.kind == EventKind::graze || a[i].event.kind == EventKind::chatter) return "";
      if (a[i].event.time > cut.plus(1.0 - settled)) return "";
      if (i >= b.size() || a[i].event.kind != b[i].event.kind || a[i].event.contact != b[i].event.contact ||
          std::abs(a[i].event.time.since(b[i].event.time)) > moved)
        return differ(i, a, b);
    }
    return "";
  });
  std::printf("%ld events compared\n", compared);
  EXPECT_GE(compared, 600);
}

}  // namespace
}  // namespace slapstick::test
