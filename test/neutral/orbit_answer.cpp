#include "neutral/orbit_answer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "slapstick/continuation/branch.hpp"
#include "slapstick/orbit/search.hpp"
#include "slapstick/quantity/cycle_energy.hpp"

namespace slapstick::neutral {
namespace {

const orbit::SettleOptions short_search{.transient = 100, .most_periods = 500, .most_n = 16};
/// A branch is followed so far on both sides of the parameter's value, relative to it.
constexpr double reach = 0.2;
constexpr int most_points = 80;

void add_energy(const System& system, const CycleEnergy& energy, Answer& answer) {
  const Model& m = system.model();
  answer.numbers.push_back({"input", "", energy.input, dim::energy});
  answer.numbers.push_back({"damping", "", energy.damping, dim::energy});
  const std::vector<std::string> names = friction_names(m);
  for (std::size_t i = 0; i < names.size(); ++i)
    answer.numbers.push_back({"friction", names[i], energy.friction[i], dim::energy});
  for (std::size_t i = 0; i < energy.impacts.size(); ++i)
    answer.numbers.push_back({"impacts", m.stops[i].name, energy.impacts[i], dim::energy});
}

struct Followed {
  std::shared_ptr<const orbit::Problem> problem;
  std::optional<orbit::Branch> branch;
};

/// The first `count` parameters of the file vary.
Followed follow(const ModelDefinition& definition, std::size_t count) {
  Followed found;
  std::vector<std::string> names;
  std::vector<double> values;
  for (const Parameter& parameter : definition.parameters())
    if (names.size() < count) names.push_back(parameter.name), values.push_back(parameter.value);
  found.problem = orbit::pose(definition.family(names), values);
  const orbit::Settled settled =
      orbit::settle(*found.problem, System(definition.build()), definition.start(), short_search);
  if (!settled.orbit || !settled.orbit->isolated()) return found;
  const auto [from, to] = range_of(values[0]);
  found.branch = orbit::follow(*found.problem, settled.orbit->orbit,
                               {.from = from, .to = to, .most_points = most_points, .longest_step = 0.05});
  return found;
}

}  // namespace

std::array<double, 2> range_of(double value) {
  const double far = value == 0.0 ? reach : reach * std::abs(value);
  return {value - far, value + far};
}

void answer_orbit(const ModelDefinition& definition, Answer& answer) {
  const System system(definition.build());
  const auto problem = orbit::pose(definition.family({}), {});
  const orbit::Settled settled = orbit::settle(*problem, system, definition.start(), short_search);
  answer.words["orbit"] = settled.orbit ? "yes" : "no";
  if (!settled.orbit) return;
  const orbit::Solution& found = *settled.orbit;
  answer.words["class"] = found.label;
  answer.multipliers = found.multipliers;
  answer.numbers.push_back({"period", "", found.cycle, dim::time});
  answer.numbers.push_back({"family", "", static_cast<double>(found.family), dim::pure});
  if (!found.chatter) answer.numbers.push_back({"p", "", static_cast<double>(found.impacts), dim::pure});
  add_energy(system, cycle_energy(*problem, found.orbit), answer);
  for (std::size_t i = 0; i < found.drift.size(); ++i)
    answer.numbers.push_back(
        {"drift", named(system.model(), i).name, found.drift[i], dim::length, named(system.model(), i).odd});
  const std::vector<orbit::Range> ranges = orbit::ranges(*problem, found.orbit);
  const auto& bodies = system.model().coordinates;
  for (std::size_t i = 0; i < bodies.size() && found.drift.empty(); ++i)
    for (const bool position : {true, false}) {
      const orbit::Range& range = ranges[position ? i : i + bodies.size()];
      const Dimension d = position ? dim::length : dim::speed;
      const auto [name, odd] = named(system.model(), i);
      answer.numbers.push_back({position ? "x min" : "v min", name, range.least, d, odd});
      answer.numbers.push_back({position ? "x max" : "v max", name, range.most, d, odd});
    }
}

void answer_branch(const ModelDefinition& definition, Answer& answer) {
  const Followed found = follow(definition, 1);
  answer.words["branch"] = found.branch ? "yes" : "no";
  if (!found.branch) return;
  std::vector<orbit::SpecialPoint> special = found.branch->special;
  std::ranges::stable_sort(special, {}, &orbit::SpecialPoint::value);
  for (std::size_t i = 0; i < special.size(); ++i) {
    answer.words["special point " + std::to_string(i + 1)] = orbit::name(special[i].type);
    answer.numbers.push_back({"special point", "", special[i].value, dim::pure, false, static_cast<int>(i)});
  }
  answer.words["special points"] = std::to_string(special.size());
  answer.words["down"] = orbit::name(found.branch->down.kind);
  answer.words["up"] = orbit::name(found.branch->up.kind);
}

void answer_curve(const ModelDefinition& definition, Answer& answer) {
  const Followed found = follow(definition, 2);
  answer.words["curve"] = "no";
  if (!found.branch || found.branch->special.empty()) return;
  const auto& parameters = definition.parameters();
  const auto [from, to] = range_of(parameters[0].value);
  const auto [second_from, second_to] = range_of(parameters[1].value);
  std::vector<orbit::SpecialPoint> special = found.branch->special;
  std::ranges::stable_sort(special, {}, &orbit::SpecialPoint::value);
  const orbit::Curve curve = orbit::locus(*found.problem, special[0],
                                          {.from = from,
                                           .to = to,
                                           .second_from = second_from,
                                           .second_to = second_to,
                                           .longest_step = 0.05,
                                           .most_points = 40});
  std::vector<orbit::CurveEvent> met = curve.met;
  std::ranges::stable_sort(met, {}, [](const orbit::CurveEvent& event) { return event.values[1]; });
  answer.words["curve"] = orbit::name(special[0].type);
  for (std::size_t i = 0; i < met.size(); ++i) {
    answer.words["met " + std::to_string(i + 1)] = orbit::name(met[i].met[0]);
    answer.numbers.push_back({"met, first", "", met[i].values[0], dim::pure, false, static_cast<int>(i)});
    answer.numbers.push_back({"met, second", "", met[i].values[1], dim::pure, false, static_cast<int>(i)});
  }
  for (const auto* end : {&curve.down, &curve.up}) answer.words["ends"] += std::string(orbit::name(end->kind)) + " ";
}

}  // namespace slapstick::neutral
