/// Observables that name quantities: they are those quantities, in the mode of the instant.
#include "slapstick/quantity/observables.hpp"

#include <gtest/gtest.h>

#include "settled.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::test {
namespace {

std::string with(const std::string& observables) {
  return load_model("vibro-impact").to_toml({{"omega", 0.552}}) + observables;
}

std::string refused(const std::string& expression) {
  try {
    (void)ModelDefinition::parse(with("[[observable]]\nname = \"o\"\nvalue = \"" + expression + "\"\n"), "m.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Through stick, a closed stop and chatter: the expression of quantities is that of their values.
TEST(Observables, OfQuantitiesAreThoseOfTheirValues) {
  const ModelDefinition definition = ModelDefinition::parse(
      with("[[observable]]\nname = \"lost\"\nvalue = \"F_friction * w_friction - power_friction\"\n"
           "[[observable]]\nname = \"balance\"\nvalue = \"F_stop + 2 * a1 + omega * x1\"\n"), "m.toml");
  const System system(definition.build());
  const auto all = quantities(definition);
  Observables observables(system, definition.observer());
  Reader reader(system, {find_quantity(all, "F_stop"), find_quantity(all, "a1"), find_quantity(all, "x1")});
  SampledMotion sampled(Motion(system, definition.start()), 50);
  long samples = 0, pressed = 0;
  for (auto item = sampled.next({6, 0.0}); item != SampledMotion::Item::end; item = sampled.next({6, 0.0})) {
    if (item != SampledMotion::Item::sample) continue;
    const auto values = observables.within(sampled.motion(), sampled.sample());
    const auto& read = reader.within(sampled.motion(), sampled.sample().within);
    EXPECT_NEAR(values[0], 0.0, 1e-15);
    EXPECT_DOUBLE_EQ(values[1], read[0] + 2.0 * read[1] + 0.552 * read[2]);
    ++samples;
    pressed += read[0] > 0.0 ? 1 : 0;
  }
  EXPECT_GT(samples, 290);
  EXPECT_GT(pressed, 5);
}

TEST(Observables, UnknownQuantitiesAreAnsweredWithTheNearestAndTheLine) {
  EXPECT_NE(refused("F_stpo").find("F_stop"), std::string::npos) << refused("F_stpo");
  EXPECT_EQ(refused("F_stpo").find("m.toml:"), 0U) << refused("F_stpo");
  EXPECT_NE(refused("2 * impulse").find("at impacts"), std::string::npos) << refused("2 * impulse");
  EXPECT_NE(refused("stiffnes").find("unknown name"), std::string::npos) << refused("stiffnes");
}

TEST(Observables, NeedTheQuantitiesThatTheyName) {
  const ModelDefinition definition = ModelDefinition::parse(with("[[observable]]\nname = \"o\"\nvalue = \"F_stop\"\n"), "m.toml");
  Observer observer = definition.observer();
  ASSERT_EQ(observer.quantities().size(), 1U);
  EXPECT_THROW((void)observer.read(0.0, {0, 0, 0, 0}), InputError);
  EXPECT_EQ(observer.read(0.0, {0, 0, 0, 0}, {2.5})[0], 2.5);
}

}  // namespace
}  // namespace slapstick::test
