/// What a mode promises, all along every segment: gaps open, velocities of slip with their sign, rest at rest, contact
/// forces within their laws.
///
/// The stated bound: a stored number is m + 16 roundings of a window's terms away from the exact one
/// (docs/developers/proofs.md, section 3), which are together at most e^|A H| < 8 times what they start from; so much
/// may a guard be below zero. Forces are Newton's, from the coordinates (newton.hpp), not the engine's.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flow/compiled_system.hpp"
#include "flow/engine.hpp"
#include "mode/mode.hpp"
#include "property/newton.hpp"
#include "property/property.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::test {
namespace {

using mode::CompliantState;
using mode::FrictionState;
using mode::StopState;

constexpr long most_segments = 600;
constexpr int samples = 16;  ///< of a segment

class Watchman {
 public:
  explicit Watchman(const Machine& machine)
      : system_(machine.model), newton_(system_.model()), motion_(system_, machine.start), x_(machine.start) {}

  std::string run() {
    long seen = 0;
    Instant last{};
    for (Outcome outcome = Outcome::event; outcome == Outcome::event && segments < most_segments;) {
      outcome = motion_.advance({4, 0.0});
      if (outcome == Outcome::event && motion_.event().time < last) wrong_ = "time runs backwards";
      last = motion_.time();
      if (motion_.counters().segments == seen) continue;
      seen = motion_.counters().segments;
      if (motion_.segment().duration == 0.0) continue;  // what hits at its start has no motion in that mode
      ++segments;
      look(motion_.segment());
    }
    return wrong_;
  }

  long segments = 0, forces = 0, loads = 0;
  double worst = 0.0;

 private:
  /// value >= -allowed
  void expect(const std::string& what, double value, double allowed) {
    worst = std::max(worst, -value / allowed);
    if (value >= -allowed || !wrong_.empty()) return;
    char text[200];
    std::snprintf(text, sizeof text, ": %.3g below zero, %.3g allowed; at %.17g periods, mode %s", -value, allowed,
                  static_cast<double>(motion_.time().period) + motion_.time().fraction,
                  system_.mode_name(motion_.segment().mode).c_str());
    wrong_ = what + text;
  }

  void look(const Motion::Segment& segment) {
    const mode::Mode& mode = system_.compiled().mode(segment.mode);
    const double H = std::min(mode.window(), segment.duration);
    Sizes sizes;
    for (int i = 0; i <= samples; ++i) motion_.sample(segment.duration * i / samples, x_), sizes.note(x_);
    // Velocities are sums of the accelerations' terms, and positions of the velocities', too.
    sizes.v += H * newton_.acceleration_size(sizes);
    sizes.x += H * sizes.v;
    // What depends on others (contacts in loops) keeps the rounding of what it was before.
    greatest_ = {std::max(greatest_.x, sizes.x + newton_.least().x),
                 std::max(greatest_.v, sizes.v + newton_.least().v)};
    guards(mode);
    const double unit = 0x1p-50 * (system_.compiled().frame().size() + 16) * (1.0 + segment.duration / mode.window());
    for (int i = 0; i <= samples && wrong_.empty(); ++i) {
      const double s = segment.duration * i / samples;
      const double theta = 2 * std::numbers::pi * segment.start.fraction + system_.model().omega * s;
      motion_.sample(s, x_);
      positions(mode.states(), unit * greatest_.x, unit * greatest_.v);
      limits(newton_.held(x_, mode.states(), theta, sizes), unit);
    }
  }

  /// The engine's own guards where the segment starts: also of contacts whose forces Newton does not determine.
  void guards(const mode::Mode& mode) {
    const Eigen::Map<const Eigen::RowVectorXd> X(motion_.engine().extended_at_start().data(), mode.size());
    for (const mode::Guard& guard : mode.guards()) {
      const double size = guard.row.cwiseAbs().dot(X.cwiseAbs().cwiseMax(1.0));
      expect("guard", guard.row.dot(X), 0x1p-50 * (mode.size() + 16) * size);
    }
  }

  void positions(const mode::ContactStates& contacts, double x, double v) {
    const Model& m = system_.model();
    for (std::size_t i = 0; i < m.stops.size(); ++i) {
      const double gap = m.stops[i].clearance - Newton::difference(x_, m.stops[i].a, m.stops[i].b, 0);
      expect("gap of " + m.stops[i].name, gap, x);
      if (contacts.stops[i] == StopState::closed) expect("closed gap of " + m.stops[i].name, -gap, x);
    }
    for (std::size_t i = 0; i < m.frictions.size(); ++i) {
      const FrictionContact& f = m.frictions[i];
      const double w = Newton::difference(x_, f.a, f.b, 1) - f.belt_speed;
      load(contacts, i, x, v);
      if (contacts.frictions[i] == FrictionState::stick)
        expect("slip in stick of " + f.name, -std::abs(w), v);
      else if (contacts.frictions[i] != FrictionState::unloaded)
        expect("slip of " + f.name, static_cast<int>(contacts.frictions[i]) * w, v);
    }
    for (std::size_t i = 0; i < m.compliant_stops.size(); ++i) {
      const CompliantStop& c = m.compliant_stops[i];
      const double delta = Newton::difference(x_, c.a, c.b, 0) - c.clearance;
      const double force = c.stiffness * delta + c.damping * Newton::difference(x_, c.a, c.b, 1);
      const CompliantState state = contacts.compliant[i];
      expect("depth of " + c.name, state == CompliantState::off ? -delta : delta, x);
      if (c.pulls || state == CompliantState::off) continue;
      if (c.bounded && c.damping > 0.0) {
        bounds(c, state, c.stiffness * delta, c.damping * Newton::difference(x_, c.a, c.b, 1),
               c.stiffness * x + c.damping * v);
        continue;
      }
      expect("push of " + c.name, state == CompliantState::on ? force : -force, c.stiffness * x + c.damping * v);
    }
  }

  /// N >= 0 of a contact that carries friction, N <= 0 of one that is unloaded.
  void load(const mode::ContactStates& contacts, std::size_t i, double x, double v) {
    const FrictionContact& f = system_.model().frictions[i];
    if (!f.normal) return;
    const double sign = contacts.frictions[i] == FrictionState::unloaded ? -1.0 : 1.0;
    double allowed = newton_.load_size({}, i) * 0x1p-44 + 0x1p-44;
    for (const NormalForce::Term& term : f.normal->terms)
      allowed += std::abs(term.stiffness) * x + std::abs(term.damping) * v;
    if (const int stop = f.normal->compliant_stop; stop >= 0)
      allowed += 2.0 * (system_.model().compliant_stops[stop].stiffness * x +
                        system_.model().compliant_stops[stop].damping * v);
    expect("load of " + f.name, sign * newton_.load(x_, contacts, i), allowed);
    loads += f.normal.has_value();
  }

  void bounds(const CompliantStop& c, CompliantState state, double spring, double damper, double allowed) {
    if (state == CompliantState::on) expect("bounded push of " + c.name, spring - std::abs(damper), allowed);
    if (state == CompliantState::bounded) expect("bound of " + c.name, damper - spring, allowed);
    if (state == CompliantState::detached) expect("detached " + c.name, -damper - spring, allowed);
  }

  /// |f0| <= f_s in stick; on a closed stop N >= 0: the pair's force on a is at most what friction can add to a push.
  void limits(const std::vector<Newton::Held>& held, double unit) {
    for (const Newton::Held& pair : held) {
      const double allowed = unit * (pair.size + pair.limit);
      if (!pair.high) expect("force of a held pair above its limit", pair.limit - pair.force, allowed);
      if (!pair.low) expect("force of a held pair below its limit", pair.limit + pair.force, allowed);
      forces += std::isfinite(allowed);
    }
  }

  System system_;
  Newton newton_;
  Motion motion_;
  State x_;
  Sizes greatest_;  ///< of all segments so far
  std::string wrong_;
};

void expect_lawful(const Shape& shape, int machines, long least_segments, long least_forces) {
  long segments = 0, forces = 0;
  double worst = 0.0;
  expect_of_all(shape, machines, [&](const Machine& machine) {
    Watchman watchman(machine);
    const std::string wrong = watchman.run();
    segments += watchman.segments, forces += watchman.forces;
    worst = std::max(worst, watchman.worst);
    return wrong;
  });
  std::printf("%ld segments, %ld forces of held pairs; the deepest violation is %.2f of the bound\n", segments, forces,
              worst);
  EXPECT_GE(segments, least_segments);
  EXPECT_GE(forces, least_forces);
}

TEST(Law, OfContactHoldsAllAlongTheSegmentsOfSmallMachines) { expect_lawful({}, 300, 6000, 12'000); }

TEST(Law, OfContactHoldsWithEveryLawOfForce) {
  expect_lawful({.most_stops = 2, .most_frictions = 2, .most_compliant = 2, .laws = true}, 300, 6000, 6000);
}

TEST(Law, OfContactHoldsInNetworks) {
  expect_lawful(
      {.least_coordinates = 2, .most_coordinates = 8, .most_stops = 4, .most_frictions = 4, .most_compliant = 2}, 100,
      4000, 25'000);
}

}  // namespace
}  // namespace slapstick::test
