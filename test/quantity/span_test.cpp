/// What is measured of a model with a record.
#include "slapstick/quantity/span.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "slapstick/base/error.hpp"

namespace slapstick::test {
namespace {

/// A free mass that a pulse pushes: v = s^2 / 2 while it rises, s = t - 1.
ModelDefinition pushed(const std::string& more = "") {
  return ModelDefinition::parse(more +
                                    "name = 'm'\n[[coordinate]]\nname = 'x'\nmass = 1\n"
                                    "[[signal]]\nname = 'push'\npoints = [[1, 0], [2, 1], [3, 0]]\n"
                                    "[[force]]\non = 'x'\nsignal = 'push'\namplitude = 1\n",
                                "m.toml");
}

/// Behind the record the mass goes on at v = 1; in it the mean force is 1 / 2 and the mean square 1 / 3.
TEST(Span, OfARecordIsTheRecord) {
  const ModelDefinition definition = pushed();
  const System system(definition.build());
  const std::optional<Span> span = find_span(definition, {}, system, definition.start(), {});
  ASSERT_TRUE(span && span->motion);
  EXPECT_EQ(span->motion->time().since({}), 1.0);
  EXPECT_EQ(span->periods(), 2.0);
  const std::vector<Quantity> all = quantities(definition);
  const Measured found = measure(*span, {find_quantity(all, "a"), find_quantity(all, "v")});
  EXPECT_NEAR(found.of[0].mean, 0.5, 1e-15);
  EXPECT_NEAR(found.of[0].rms, 1.0 / std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(found.of[1].greatest, 1.0, 1e-15);
}

/// A transient of 1.5 leaves the second half of the rise: a = 1/2 .. 1 .. 0, mean (3/8 + 1/2) / 1.5.
TEST(Span, MayBeginWithinARecord) {
  const ModelDefinition definition = pushed();
  const std::optional<Span> span =
      find_span(definition, {}, System(definition.build()), definition.start(), {.transient = 1.5});
  ASSERT_TRUE(span);
  EXPECT_NEAR(measure(*span, {find_quantity(quantities(definition), "a")}).of[0].mean, 0.875 / 1.5, 1e-15);
}

TEST(Span, BehindARecordIsRefusedUnlessALengthIsAskedFor) {
  const Model model = pushed().build();
  try {
    (void)stretch_of(model, 500.0, 0.0, 1000.0);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("signal 'push' ends after 3 units of time"), std::string::npos)
        << error.what();
  }
  EXPECT_EQ(stretch_of(model, 500.0, 7.0, 1000.0).periods, 7.0);
  EXPECT_THROW((void)stretch_of(model, 3.0, 0.0, 1000.0), InputError);
}

/// In forcing periods where there is a forcing; a signal that repeats is no record.
TEST(Span, CountsARecordInForcingPeriods) {
  const std::string force = "[[force]]\non = 'x'\namplitude = 1\n";
  const Model forced = ModelDefinition::parse("omega = 2\n" + pushed().to_toml() + force, "m.toml").build();
  const Stretch of = stretch_of(forced, {}, 0.0, 1000.0);
  EXPECT_NEAR(of.transient, 1.0 / std::numbers::pi, 1e-15);
  EXPECT_NEAR(of.periods, 2.0 / std::numbers::pi, 1e-15);
  Model repeated = pushed().build();
  repeated.signals[0].repeats = true;
  EXPECT_EQ(stretch_of(repeated, {}, 0.0, 1000.0).transient, 500.0);
  EXPECT_FALSE(record_of(repeated).has_value());
}

}  // namespace
}  // namespace slapstick::test
