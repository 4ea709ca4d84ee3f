/// What a change of events is called, and that it is called the same from wherever a branch comes.
#include "change/change_kind.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "families.hpp"
#include "orbit/record.hpp"

namespace slapstick::test {
namespace {

using mode::FrictionState;
using orbit::CurveEnd, orbit::Jump, orbit::Occurrence, orbit::Passage, orbit::Sliding, orbit::SpecialType;

/// A cycle of one friction contact and one stop by the contact's states, a letter each (- s +), and how long they last;
/// '!' after one: an impact ends it.
orbit::Orbit cycle(std::string_view states, const std::vector<double>& durations) {
  orbit::Orbit orbit;
  orbit.t = {0.0};
  for (const char letter : states) {
    if (letter == '!') {
      orbit.shape.legs.back().strikes = {{1U, false}};
      continue;
    }
    orbit::Leg leg;
    leg.states.stops = {mode::StopState::open};
    leg.states.frictions = {letter == 's'   ? FrictionState::stick
                            : letter == '-' ? FrictionState::slip_minus
                                            : FrictionState::slip_plus};
    orbit.t.push_back(orbit.t.back() + durations.at(orbit.shape.legs.size()));
    orbit.shape.legs.push_back(leg);
  }
  return orbit;
}

/// Each kind by its definition, from either side, wherever the cycles begin.
TEST(KindOfSliding, IsReadFromTheSequences) {
  struct Case {
    orbit::Orbit with, without;
    Sliding sliding;
  };
  const std::vector<Case> cases = {
      {cycle("+s-", {1, 1e-3, 1}), cycle("-+", {1, 1}), Sliding::crossing},
      {cycle("+s+-", {1, 1e-3, 1, 1}), cycle("+-", {2, 1}), Sliding::grazing},
      {cycle("+-+", {1, 1e-3, 1}), cycle("+", {2}), Sliding::grazing},
      {cycle("+-s", {1, 1e-3, 1}), cycle("s+", {1, 1}), Sliding::switching},
      {cycle("s+s-", {1, 1e-3, 1, 1}), cycle("s-", {2, 1}), Sliding::adding},
      {cycle("s+s+", {1, 1e-3, 1, 1}), cycle("+s", {1, 2}), Sliding::adding},
      {cycle("s+s+", {1e-3, 1, 1, 1}), cycle("+s", {2, 1}), Sliding::grazing},
      {cycle("+s-s", {1, 1e-3, 1, 1e-3}), cycle("+-", {1, 1}), Sliding::crossing},  // of a symmetric orbit, twice
  };
  for (const Case& c : cases)
    for (const bool back : {false, true}) {
      const auto change = back ? compare_events(c.without, c.with) : compare_events(c.with, c.without);
      EXPECT_EQ(change.type, SpecialType::SL) << name(c.sliding);
      EXPECT_EQ(change.sliding, c.sliding) << (back ? "from without" : "from with");
    }
}

/// Where events are exchanged no state comes or goes; an impact says more than what friction does at it.
TEST(TypeOfChange, IsThatOfWhatComesOrGoes) {
  EXPECT_EQ(compare_events(cycle("+s-", {1, 1, 1}), cycle("s-+", {2, 1, 1})).type, SpecialType::CO);
  EXPECT_EQ(compare_events(cycle("+!-", {1, 1}), cycle("+", {2})).type, SpecialType::GR);
  EXPECT_EQ(compare_events(cycle("+!+", {1, 1}), cycle("+", {2})).type, SpecialType::GR);
}

struct Case {
  std::string model, parameter;
  double from, to;
  std::vector<double> starts;
};

orbit::Branch followed(const Case& c, double start) {
  const Posed posed(c.model, {}, {c.parameter}, {start});
  const auto first = posed.settled();
  if (!first) throw std::runtime_error("the motion does not settle");
  return orbit::follow(*posed.problem, first->orbit, {.from = c.from, .to = c.to});
}

/// A branch has a special point, by the same name.
void expect_in(const orbit::Branch& branch, const orbit::SpecialPoint& a, double range, const std::string& model) {
  const auto here = [&](const orbit::SpecialPoint& b) {
    return std::abs(b.value - a.value) < 1e-9 * range + a.error + b.error;
  };
  const auto b = std::ranges::find_if(branch.special, here);
  ASSERT_NE(b, branch.special.end()) << model << " " << name(a.type) << " " << a.value;
  EXPECT_EQ(name(a.type), name(b->type)) << model << " " << a.value;
  EXPECT_EQ(name(a.passage), name(b->passage)) << model << " " << a.value;
  EXPECT_EQ(name(a.sliding), name(b->sliding)) << model << " " << a.value;
}

/// What a branch has, and what it is called, must not depend on the side it is come to from.
void expect_one_name(const Case& c) {
  const orbit::Branch one = followed(c, c.starts[0]), other = followed(c, c.starts[1]);
  EXPECT_FALSE(one.failed()) << ended(one);
  EXPECT_FALSE(other.failed()) << ended(other);
  const double range = c.to - c.from;
  long compared = 0;
  for (const auto& [these, those] : {std::pair(&one, &other), std::pair(&other, &one)})
    for (const orbit::SpecialPoint& a : these->special) {
      const bool near_onset = std::ranges::any_of(these->special, [&](const orbit::SpecialPoint& onset) {
        return onset.type == SpecialType::CH && std::abs(onset.value - a.value) < 1e-5 * range;
      });
      if (near_onset || a.passage == Passage::cascade)
        continue;  // how far a cascade is followed is a matter of rounding
      expect_in(*those, a, range, c.model);
      ++compared;
    }
  EXPECT_GT(compared, 8) << c.model;
}

/// Two changes 1e-7 apart, and the cascade at the onset of a chatter that is come to from within the chatter.
TEST(Change, HasOneNameFromEitherSide) {
  expect_one_name({"impact-friction-oscillator", "clearance", -0.85, 0.2, {-0.8, 0.0}});
}

/// A graze at which the parameter is the square of the impact's speed.
TEST(Change, OfASpoolHasOneNameFromEitherSide) {
  expect_one_name({"spool", "frequency", 150.0, 300.0, {155.0, 290.0}});
}

/// A fold 1e-7 beside two events that meet lies between the change and the first orbit looked at behind it.
TEST(Fold, BesideAChangeIsSeenFromEitherSide) {
  const orbit::Branch one = followed({"two-blocks-on-belt", "coupling", 0.33, 3.6, {}}, 1.2),
                      other = followed({"two-blocks-on-belt", "coupling", 0.33, 3.6, {}}, 1.3);
  const auto folds = [](const orbit::Branch& branch) {
    return std::ranges::count_if(branch.special, [](const orbit::SpecialPoint& point) {
      return point.type == SpecialType::LP && std::abs(point.value - 1.17811599995) < 1e-9;
    });
  };
  EXPECT_EQ(folds(one), 1) << ended(one);
  EXPECT_EQ(folds(other), 1) << ended(other);
}

/// Instants are compared against the cycle, not against a unit of time that it may be a ten-thousandth of.
TEST(Verification, OfAFastCycleTakesNoOtherInstants) {
  const Posed posed(SLAPSTICK_ORBIT_MODELS "fast-belt.toml", {}, {}, {});
  const auto first = posed.settled(0, 1);
  ASSERT_TRUE(first);
  ASSERT_GT(first->orbit.legs(), 1U);
  EXPECT_LT(first->cycle, 1e-3);
  EXPECT_TRUE(orbit::verify(posed.system, first->orbit).is_motion);
  orbit::Orbit late = first->orbit;
  late.t[1] += 1e-6 * first->cycle;
  EXPECT_FALSE(orbit::verify(posed.system, late).is_motion);
}

/// A velocity that passes zero where static friction holds it is no motion, also where a check of the cycle ends just
/// behind it.
TEST(Verification, RefusesAReversalThatStaticFrictionForbids) {
  const Posed posed(SLAPSTICK_ORBIT_MODELS "hammer-drill.toml", {{"gap", 0.005}}, {"frequency"}, {21.159});
  const auto found = orbit::search(*posed.problem, posed.system, posed.start(), {.most_n = 1, .starts = 100}).orbits;
  ASSERT_FALSE(found.empty());
  const orbit::ModeSet set(posed.family, posed.values);
  for (const orbit::Solution& solution : found)
    for (const orbit::TestValue& test : orbit::test_values(set, solution.orbit))
      EXPECT_TRUE(test.test != orbit::Test::no_stick || test.value > 0.0) << solution.label << ": " << test.value;
}

/// A stop that is called anvil was hit "at impact anvil", and a release whose force only touches its limit had a "rate
/// of the guard".
TEST(KindOfChange, SaysInTheFieldsWordsWhatGoesToZero) {
  const Posed posed(SLAPSTICK_ORBIT_MODELS "hammer-drill.toml", {}, {"frequency"}, {14.0});
  orbit::Itinerary shape = cycle("+s", {0.5, 0.5}).shape;
  const auto says = [&](EventKind event, int contact, orbit::Test test, mode::GuardKind kind) {
    shape.legs[0].event = event;
    shape.legs[0].event_contact = contact;
    return orbit::describe(orbit::used({test, 0, kind, 0}), shape, posed.system);
  };
  using enum mode::GuardKind;
  EXPECT_EQ(says(EventKind::impact, 0, orbit::Test::speed, gap), "the speed of the impact at anvil goes to zero");
  EXPECT_EQ(says(EventKind::release, 1, orbit::Test::speed, stick_above),
            "the release of guide becomes tangential: its holding force only touches static friction");
  EXPECT_EQ(says(EventKind::stick, 1, orbit::Test::speed, slip),
            "the stick of guide becomes tangential: its velocity only touches zero");
  EXPECT_EQ(says(EventKind::slip_minus, 1, orbit::Test::no_stick, slip),
            "the holding force of guide comes to static friction at its reversal (slip-)");
}

/// An orbit that reverses without stick had no margin for it: nothing said how near it was to sticking. The tool rests
/// for an instant, so that what would hold it is its spring's force.
TEST(Margins, HaveTheForceThatKeepsAReversalFromSticking) {
  const Posed posed(SLAPSTICK_ORBIT_MODELS "hammer-drill.toml", {}, {"frequency"}, {14.0});
  const auto found = posed.settled();
  ASSERT_TRUE(found);
  double least = INFINITY;
  for (const orbit::EventOfOrbit& event : orbit::events(*posed.problem, found->orbit))
    if (event.kind == EventKind::slip_plus || event.kind == EventKind::slip_minus)
      least = std::min(least, 40000.0 * std::abs(event.before[2]) - 1.25 * 30.0);
  const auto margins = orbit::margins(*posed.problem, found->orbit);
  const auto reversal = std::ranges::find(margins, true, &orbit::Margin::reversal);
  ASSERT_NE(reversal, margins.end());
  ASSERT_GT(least, 0.0);
  EXPECT_NEAR(reversal->value, least, 1e-9 * least);
  EXPECT_EQ(std::ranges::count(margins, true, &orbit::Margin::reversal), 1);
}

}  // namespace
}  // namespace slapstick::test
