/// Classes of motions with several stops, and with compliant ones.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "model/twins.hpp"
#include "slapstick/attractor/classify.hpp"

namespace slapstick {
namespace {

/// A linear oscillator, x = sin(t + ..) of amplitude 1 in the limit, with pads at +-clearance so soft that they only
/// watch.
Model watched(double upper, double lower) {
  constexpr double omega = 1.0, damping = 0.25;
  Model model;
  model.name = "watched";
  model.coordinates = {{"x", 1.0}};
  model.springs = {{0, ground, omega * omega}};  // resonance: amplitude = force / (damping omega)
  model.dampers = {{0, ground, damping}};
  model.forces = {{0, 1, damping * omega, 0.0}};
  model.compliant_stops = {{"upper", 0, ground, upper, 1e-9, 0.0, false},
                           {"lower", ground, 0, lower, 1e-9, 0.0, false}};
  model.omega = omega;
  return model;
}

/// Two elastic-plastic walls and a strong symmetric drive: one impact on each per period.
Model rattle() {
  Model model;
  model.name = "rattle";
  model.coordinates = {{"x", 1.0}};
  model.springs = {{0, ground, 1.0}};
  model.dampers = {{0, ground, 0.2}};
  model.forces = {{0, 1, 1.0, 0.0}};
  model.stops = {{"right", 0, ground, 0.3, 0.7}, {"left", ground, 0, 0.3, 0.7}};
  model.omega = 2.0;
  return model;
}

Classification of(const Model& model, const std::vector<std::string>& stops) {
  return classify(System(model), State(2 * static_cast<std::size_t>(model.size()), 0.0), {.stops = {model, stops}});
}

TEST(classify_stops, engagements_of_a_linear_motion_are_its_upward_crossings) {
  const Model model = watched(0.5, 0.8);
  const Classification both = of(model, {});
  EXPECT_EQ(both.label, "1-2-I");
  ASSERT_EQ(both.impacts.size(), 2U);
  for (const CycleImpact& impact : both.impacts) {
    const double at = impact.contact == 0 ? 0.5 : 0.8;
    EXPECT_NEAR(impact.w, std::sqrt(1.0 - at * at), 1e-7) << "cos of the phase at which sin is " << at;
  }
  EXPECT_NE(both.impacts[0].contact, both.impacts[1].contact);
  EXPECT_EQ(of(watched(0.5, 1.1), {}).label, "1-1-I") << "the lower pad is out of reach";
  EXPECT_EQ(of(watched(1.1, 1.1), {}).label, "1-0-I");
  EXPECT_EQ(of(watched(0.5, 1.1), {"lower"}).label, "1-0-I");
}

/// Two equal bodies that meet their stops at the same instant: p counts both, whether the stops are rigid or not.
TEST(classify_stops, two_equal_stops_that_are_met_at_once_count_twice) {
  Model soft = test::twins(), model = soft;
  soft.compliant_stops = {{"l", 0, ground, 0.3, 40.0, 2.0}, {"r", 1, ground, 0.3, 40.0, 2.0}};
  model.stops = {{"l", 0, ground, 0.3, 0.6}, {"r", 1, ground, 0.3, 0.6}};
  EXPECT_EQ(of(model, {}).label, "1-2-I");
  EXPECT_EQ(of(soft, {}).label, "1-2-I");
  EXPECT_EQ(of(soft, {"r"}).label, "1-1-I");
}

TEST(classify_stops, a_chosen_stop_changes_the_count_and_not_the_verdict) {
  const Classification all = of(rattle(), {});
  ASSERT_EQ(all.attractor, Attractor::periodic);
  long sum = 0;
  for (const char* name : {"right", "left"}) {
    const Classification one = of(rattle(), {name});
    EXPECT_EQ(one.n, all.n);
    EXPECT_EQ(one.state, all.state);
    EXPECT_EQ(one.multipliers, all.multipliers);
    EXPECT_EQ(one.p, static_cast<long>(one.impacts.size()));
    for (const CycleImpact& impact : one.impacts) EXPECT_EQ(rattle().stops[impact.contact].name, name);
    sum += one.p;
  }
  EXPECT_EQ(sum, all.p);
  EXPECT_EQ(all.p, 2);
}

TEST(classify_stops, the_verdict_without_a_cycle_is_the_same_too) {
  Model model = rattle();
  model.springs.clear();
  model.dampers.clear();
  model.stops[0].restitution = model.stops[1].restitution = 1.0;  // Fermi and Ulam: no attractor, no cycle found
  const ClassifyOptions quick{.transient_periods = 10, .most_periods = 600};
  ClassifyOptions right = quick;
  right.stops = {model, {"right"}};
  const System system(model);
  const State start{0.1, 1.7};
  const Classification all = classify(system, start, quick), one = classify(system, start, right);
  ASSERT_NE(all.attractor, Attractor::periodic);
  EXPECT_EQ(one.attractor, all.attractor);
  EXPECT_EQ(one.exponent, all.exponent);
  EXPECT_EQ(one.digits, all.digits);
}

TEST(classify_stops, a_complete_chatter_is_that_of_its_stop) {
  // The chatter of the quasi-static end is on the right; the left wall is out of reach.
  Model model = rattle();
  model.omega = 0.05;
  model.stops[1].clearance = 5.0;
  EXPECT_EQ(of(model, {}).chatter, Chatter::complete);
  EXPECT_EQ(of(model, {"right"}).label, "1-inf-II");
  const Classification left = of(model, {"left"});
  EXPECT_EQ(left.chatter, Chatter::none);
  EXPECT_EQ(left.label, "1-0-II") << "it is at rest all the same";
}

}  // namespace
}  // namespace slapstick
