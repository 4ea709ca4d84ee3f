/// Parameters and ranges of `continue` and `curve`, and orbits as JSON.
#include "orbit_options.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/orbit/special_point.hpp"

namespace slapstick::app {

ParameterRange parse_range(const std::string& argument, const std::string& text) {
  const auto parts = split(text, ':');
  if (parts.size() != 2) throw InputError(argument + ": " + in_quotes(text) + " is not of the form A:B");
  const ParameterRange range{parse_number(argument + " A", parts[0]), parse_number(argument + " B", parts[1])};
  if (!(range.from < range.to))
    throw InputError(argument + ": A = " + shown(range.from) + " is not below B = " + shown(range.to));
  return range;
}

namespace {

/// call(), whose errors name the argument.
template <class Call>
auto named(const std::string& argument, const Call& call) {
  try {
    return call();
  } catch (const InputError& error) {
    throw InputError(argument + ": " + error.message());
  }
}

}  // namespace

double present_value(const ChosenModel& chosen, const std::string& argument, const std::string& parameter) {
  return named(argument, [&] { return chosen.definition.present_value(parameter, chosen.overrides, "--set "); });
}

double value_inside(const ChosenModel& chosen, const std::string& argument, const std::string& parameter,
                    const ParameterRange& range) {
  const double value = present_value(chosen, argument, parameter);
  named("--range", [&] { chosen.definition.check_range(parameter, chosen.overrides, range.from, range.to, "--set "); });
  return value;
}

Json solution_json(const orbit::Solution& solution) {
  Json json = Json::object(), multipliers, stable;
  const bool known = orbit::differentiable(solution.orbit.shape);
  if (known) {
    multipliers = Json::list();
    stable = solution.stable();
  }
  for (const auto& multiplier : solution.multipliers)
    multipliers.push(Json::list(std::vector<double>{multiplier.real(), multiplier.imag()}));
  json.set("class", solution.label);
  const orbit::Itinerary& shape = solution.orbit.shape;
  json.set("n", shape.n > 0 ? shape.n : orbit::returns(shape));
  json.set("p", solution.chatter ? Json("inf") : Json(solution.impacts)).set("sticking", solution.sticking);
  if (!solution.isolated()) json.set("family", solution.family);
  json.set("stable", std::move(stable)).set("period", solution.cycle).set("multipliers", std::move(multipliers));
  if (!known) json.set("why_no_multipliers", no_derivative);
  json.set("is_motion", solution.is_motion);
  if (!solution.is_motion) json.set("why", solution.why);
  if (!solution.drift.empty()) json.set("drift", Json::list(solution.drift));
  return json;
}

Json state_json(const State& state, const Model& model) {
  const auto names = state_names(model);
  Json json = Json::object();
  for (std::size_t i = 0; i < names.size(); ++i) json.set(names[i], state[i]);
  return json;
}

Json point_json(const orbit::Problem& problem, const orbit::Solution& solution, const Model& model) {
  return solution_json(solution).set("state", state_json(orbit::at_phase_zero(problem, solution.orbit), model));
}

Json impacts_json(const orbit::Problem& problem, const orbit::Solution& solution, const System& system) {
  Json list = Json::list();
  for (const orbit::EventOfOrbit& event : orbit::events(problem, solution.orbit)) {
    if (event.kind != EventKind::impact && event.kind != EventKind::engage) continue;
    Json item = Json::object();
    item.set("time", event.t * system.period()).set("phase", event.t - std::floor(event.t)).set("w", event.w);
    item.set("contact", system.contact_name(event.contact)).set("state", state_json(event.before, system.model()));
    list.push(std::move(item));
  }
  return list;
}

Json events_json(const orbit::Problem& problem, const orbit::Solution& solution, const System& system) {
  Json list = Json::list();
  for (const orbit::EventOfOrbit& event : orbit::events(problem, solution.orbit)) {
    Json item = Json::object();
    item.set("time", event.t * system.period()).set("kind", std::string(name(event.kind)));
    item.set("contact", system.contact_name(event.contact))
        .set("mode_after", system.mode_name(system.mode_id(event.after)));
    item.set("w", event.w).set("state", state_json(event.before, system.model()));
    list.push(std::move(item));
  }
  return list;
}

Json extremes_json(const orbit::Problem& problem, const orbit::Solution& solution, const Model& model) {
  const std::vector<orbit::Range> ranges = orbit::ranges(problem, solution.orbit);
  const std::vector<std::string> names = state_names(model);  // x_1, v_1, x_2, ..
  const std::size_t n = model.coordinates.size();
  Json json = Json::object();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const orbit::Range& range = ranges[i / 2 + (i % 2 == 0 ? 0 : n)];
    json.set(names[i], Json::object().set("min", range.least).set("max", range.most));
  }
  return json;
}

Json energy_json(const CycleEnergy& energy, const Model& model) {
  Json json = Json::object(), friction = Json::object(), impacts = Json::object();
  const std::vector<std::string> names = friction_names(model);
  for (std::size_t i = 0; i < names.size(); ++i) friction.set(names[i], energy.friction[i]);
  for (std::size_t i = 0; i < energy.impacts.size(); ++i) impacts.set(model.stops[i].name, energy.impacts[i]);
  json.set("input", energy.input).set("damping", energy.damping);
  json.set("friction", std::move(friction)).set("impacts", std::move(impacts)).set("balance", energy.balance());
  return json;
}

Json margins_json(const std::vector<orbit::Margin>& margins, const System& system) {
  Json list = Json::list();
  for (const orbit::Margin& margin : margins) {
    const int contact = mode::contact_index(margin.kind, margin.contact, system.model());
    Json item = Json::object();
    item.set("guard", margin.reversal ? "reversal" : std::string(mode::name(margin.kind)))
        .set("contact", system.contact_name(contact))
        .set("value", margin.value);
    list.push(std::move(item));
  }
  return list;
}

}  // namespace slapstick::app
