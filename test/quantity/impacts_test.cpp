/// Impacts of single stops and engagements of compliant ones: against the impact section, and against the length of the
/// cycle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "settled.hpp"
#include "slapstick/flow/stage.hpp"
#include "slapstick/quantity/measure.hpp"
#include "slapstick/section/impact_section.hpp"

namespace slapstick::test {
namespace {

/// w, flight and sliding of the points of a section, each in order of size.
struct Points {
  std::vector<double> w, flight, sliding;

  Points(Motion motion, Instant end, StopChoice stops) {
    ImpactSection section(std::move(motion), stops);
    SectionPoint point;
    while (section.next(end, point)) {
      w.push_back(point.w);
      if (!std::isnan(point.flight)) flight.push_back(point.flight), sliding.push_back(point.sliding);
    }
    for (std::vector<double>* column : {&w, &flight, &sliding}) std::sort(column->begin(), column->end());
  }
};

void expect_same(const std::vector<double>& found, const std::vector<double>& expected, const std::string& what) {
  ASSERT_EQ(found.size(), expected.size()) << what;
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-9 * std::max(1.0, expected[i])) << what;
}

/// A motion of 60 periods after 200: what the section counts, `measure` counts, by all stops and by each.
TEST(Impacts, AreThoseOfTheImpactSection) {
  const std::pair<const char*, Overrides> cases[] = {{"gear-pair", {{"omega", 0.9}}},
                                                     {"two-sided-rattle", {}},
                                                     {"vibro-impact", {{"omega", 4.9}}},
                                                     {"gear-rattle", {{"unevenness", 300.0}}}};
  for (const auto& [name, values] : cases) {
    const ModelDefinition definition = load_model(name);
    const System system(definition.build(values));
    Motion motion(system, definition.start(values));
    (void)run_to(motion, {200, 0.0}, nullptr, [] {});
    const Instant end{260, 0.0};
    const auto all = quantities(definition, values);
    std::vector<std::pair<std::string, StopChoice>> choices = {{"", {}}};
    for (const int contact : stop_contacts(system.model())) {
      const std::string& stop = stop_name(system.model(), contact);
      choices.emplace_back("_" + stop, StopChoice(system.model(), {stop}));
    }
    for (const auto& [suffix, choice] : choices) {
      const Points expected(motion, end, choice);
      const std::vector<Quantity> of = {find_quantity(all, suffix.empty() ? "w" : "speed" + suffix),
                                        find_quantity(all, "flight" + suffix), find_quantity(all, "sliding" + suffix)};
      const Measured found = measure(motion, end, of);
      const std::string what = name + suffix;
      if (suffix.empty()) {
        EXPECT_GT(expected.w.size(), 20U) << what;
      }
      expect_same(found.of[0].values, expected.w, what + " w");
      expect_same(found.of[1].values, expected.flight, what + " flight");
      expect_same(found.of[2].values, expected.sliding, what + " sliding");
    }
  }
}

/// The flights of a cycle fill the cycle, of all stops and of each one that is hit; none begins before it.
TEST(Impacts, OfACycleHaveFlightsThatFillIt) {
  const std::pair<const char*, Overrides> cases[] = {
      {"gear-pair", {{"omega", 0.9}}}, {"two-sided-rattle", {}}, {"gear-rattle", {}}, {"impact-absorber", {}}};
  for (const auto& [name, values] : cases) {
    const SettledCycle cycle(load_model(name), values);
    std::vector<Quantity> of = {cycle.named("flight")};
    for (const int contact : stop_contacts(cycle.model))
      of.push_back(cycle.named("flight_" + stop_name(cycle.model, contact)));
    const Measured found = measure(*cycle.problem, cycle.solution.orbit, of);
    EXPECT_GT(found.of[0].impulses, 0) << name;
    for (std::size_t k = 0; k < of.size(); ++k) {
      const double whole = found.of[k].impulses > 0 ? cycle.solution.cycle / cycle.system.period() : 0.0;
      EXPECT_NEAR(found.of[k].impulse, whole, 1e-9) << name << " " << of[k].name;
    }
    long sum = 0;
    for (const StopStatistics& stop : found.stops) sum += stop.w.impulses;
    EXPECT_EQ(sum, found.of[0].impulses) << name;
  }
}

/// The impulses and losses of single stops are those of all, told apart.
TEST(Impacts, OfEachStopAreThoseOfAll) {
  const SettledCycle cycle(load_model("gear-rattle"));
  const Measured found =
      measure(*cycle.problem, cycle.solution.orbit,
              {cycle.named("impulse"), cycle.named("impulse_teeth_upper"), cycle.named("impulse_teeth_lower"),
               cycle.named("energy_lost_teeth_upper"), cycle.named("power_teeth_upper")});
  EXPECT_EQ(found.of[1].impulses, 3);
  EXPECT_EQ(found.of[2].impulses, 1);
  EXPECT_NEAR(found.of[1].impulse + found.of[2].impulse, found.of[0].impulse, 1e-12 * found.of[0].impulse);
  EXPECT_NEAR(found.of[3].impulse, found.of[4].mean * found.duration, 1e-9 * found.of[3].impulse);
  // what the drag of the loose gear needs in a cycle, the upper flank less the lower one gives
  EXPECT_NEAR(found.of[1].impulse - found.of[2].impulse, 0.1 / 0.05 * found.duration, 1e-9);
}

}  // namespace
}  // namespace slapstick::test
