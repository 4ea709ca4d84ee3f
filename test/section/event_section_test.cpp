#include "slapstick/section/event_section.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "slapstick/base/error.hpp"

namespace slapstick {
namespace {

/// A mass on a spring, dragged by a belt of speed v until its friction f_s gives way to f_k.
Model mass_on_a_belt(double v, double f_s, double f_k) {
  Model model;
  model.name = "belt";
  model.coordinates = {{"x", 1.0}};
  model.springs = {{0, ground, 1.0}};
  model.frictions = {{"belt", 0, ground, v, f_s, f_k}};
  return model;
}

TEST(EventSection, ReturnTimeOfTheBeltIsItsClosedForm) {
  // Slip is a circle about f_k from (f_k + D, v) to (f_k - D, v), D = f_s - f_k: 2 pi - 2 atan(D / v). Stick leads back
  // at speed v: 2 D / v.
  for (const double v : {0.1, 0.5, 2.0}) {
    const System system(mass_on_a_belt(v, 1.5, 1.0));
    const double D = 0.5, period = 2.0 * std::numbers::pi - 2.0 * std::atan(D / v) + 2.0 * D / v;
    EventSection section(Motion(system, {1.2, v}), parse_event_choice("stick:belt", system));
    EventPoint point;
    ASSERT_TRUE(section.next({1000, 0.0}, point));
    EXPECT_TRUE(std::isnan(point.return_time)) << "the first point has none before it";
    for (int k = 0; k < 20; ++k) {
      ASSERT_TRUE(section.next({1000, 0.0}, point));
      EXPECT_NEAR(point.return_time, period, 1e-13 * period) << v;
      EXPECT_NEAR(point.state[0], 1.0 - D, 1e-14);
      EXPECT_NEAR(point.state[1], v, 1e-14);
      EXPECT_EQ(point.contact, 0);
    }
  }
}

TEST(EventSection, EndsAtTheEndIfNothingComes) {
  const System system(mass_on_a_belt(0.5, 1.5, 1.0));
  EventSection section(Motion(system, {1.2, 0.5}), {EventKind::impact, {}});
  EventPoint point;
  EXPECT_FALSE(section.next({30, 0.25}, point));
  EXPECT_EQ(section.motion().time(), (Instant{30, 0.25}));
}

TEST(EventSection, AnUnknownEventOrContactIsNamedWithWhatThereIs) {
  const System system(mass_on_a_belt(0.5, 1.5, 1.0));
  const auto refusal = [&](const std::string& text) {
    try {
      (void)parse_event_choice(text, system);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  EXPECT_NE(refusal("stik").find("'stik' is no kind of event; there are impact, slip+"), std::string::npos)
      << refusal("stik");
  EXPECT_NE(refusal("stick:brake").find("has no contact 'brake'; the model has belt"), std::string::npos)
      << refusal("stick:brake");
  EXPECT_EQ(refusal("slip+:belt"), "taken");
}

}  // namespace
}  // namespace slapstick
