/// The generator itself: valid machines of every kind, and small ones where a law is broken.
#include "property/machine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "property/property.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick::test {
namespace {

TEST(Generator, MakesOnlyWhatItsShapeAllows) {
  const Shape shapes[] = {{},
                          {.most_stops = 1, .most_frictions = 1, .most_compliant = 0, .least_gap = 1e-3},
                          {.one_restitution = true, .one_friction = true, .at_rest = false, .sequence = false}};
  for (const Shape& shape : shapes) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      const Machine machine = random_machine(seed, shape);
      ASSERT_TRUE(is_of(shape, machine)) << machine;
      for (const Machine& smaller : simpler(machine, shape)) ASSERT_TRUE(is_of(shape, smaller)) << machine << smaller;
    }
  }
}

TEST(Generator, KnowsEveryKindOfContactAndStart) {
  int belts = 0, two_sided = 0, shared = 0, touching = 0, at_rest = 0, pulling = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    const Machine machine = random_machine(seed, {});
    const Model& m = machine.model;
    at_rest += std::ranges::all_of(machine.start, [](double x) { return x == 0.0; });
    belts += std::ranges::any_of(m.frictions, [](const FrictionContact& f) { return f.belt_speed != 0.0; });
    pulling += std::ranges::any_of(m.compliant_stops, &CompliantStop::pulls);
    for (const Stop& s : m.stops) {
      const auto same = [&](const auto& c) { return (c.a == s.a && c.b == s.b) || (c.a == s.b && c.b == s.a); };
      two_sided += std::ranges::count_if(m.stops, same) > 1;
      shared += std::ranges::any_of(m.frictions, same);
      touching += s.clearance == 0.0 && machine.start == State(machine.start.size(), 0.0);
    }
  }
  for (const int count : {belts, two_sided, shared, touching, at_rest, pulling}) EXPECT_GE(count, 15);
}

TEST(Generator, ShrinksToTheOneContactThatBreaksALaw) {
  rc::detail::TestParams params;
  params.seed = 1;
  const auto result = rc::detail::checkTestable(
      [] {
        const Machine machine = *machines({});
        RC_ASSERT(std::ranges::none_of(machine.model.frictions, [](const auto& f) { return f.static_friction > 0.3; }));
      },
      rc::detail::TestMetadata{}, params);
  rc::detail::FailureResult failure;
  ASSERT_TRUE(result.match(failure));
  const std::string text = failure.counterExample.at(0).second;
  const auto definition = ModelDefinition::parse(text, "counterexample");  // the counterexample is a model file ..
  const Model m = definition.build({});
  EXPECT_EQ(m.size(), 1) << text;  // .. of one body and one contact
  EXPECT_EQ(m.stops.size() + m.frictions.size() + m.compliant_stops.size(), 1) << text;
  EXPECT_TRUE(m.springs.empty() && m.dampers.empty()) << text;
  EXPECT_TRUE(m.forces.empty() && m.omega == 0.0) << text;
  EXPECT_EQ(m.frictions.at(0).static_friction, 1.0) << text;
}

}  // namespace
}  // namespace slapstick::test
