#include "orbit_options.hpp"

#include <algorithm>
#include <cmath>

#include "slapstick/base/error.hpp"
#include "slapstick/base/text.hpp"

namespace slapstick::app {

void OrbitOptions::declare(Arguments& arguments) {
  arguments.text(
      "--orbit", orbit, "N-P",
      "forcing periods and impacts per cycle, e.g. 1-1 or 2-inf; N alone for any impacts (what the motion settles on)");
  arguments.count("--transient", transient, 0, 1'000'000'000,
                  "forcing periods to leave out before the first try (500)");
  arguments.count("--starts", starts, 1, 1'000'000, "motions that a search looks through (64)");
  arguments.count("--seed", seed, 0, 4'000'000'000, "of the starts of a search (1)");
}

bool OrbitClass::admits(const orbit::Solution& solution) const {
  if (n != 0 && solution.orbit.shape.n != n) return false;
  if (chatter) return solution.chatter;
  return !p || (!solution.chatter && solution.impacts == *p);
}

OrbitClass parse_orbit(const std::string& text) {
  if (text.empty()) return {};
  const std::vector<std::string> parts = split(text, '-');
  const std::string form = "--orbit: " + in_quotes(text) + " is not of the form N-P, as 1-1 or 2-inf";
  if (parts.size() > 3 || (parts.size() == 3 && parts[2] != "I" && parts[2] != "II")) throw InputError(form);
  OrbitClass wanted;
  wanted.n = static_cast<int>(parse_integer("--orbit N-P", parts[0], 1, 1000));
  if (parts.size() == 1) return wanted;
  if (parts[1] == "inf")
    wanted.chatter = true;
  else
    wanted.p = parse_integer("--orbit N-P", parts[1], 0, 100'000);
  return wanted;
}

ParameterRange parse_range(const std::string& argument, const std::string& text) {
  if (text.empty()) throw InputError(argument + " is needed: A:B");
  const auto parts = split(text, ':');
  if (parts.size() != 2) throw InputError(argument + ": " + in_quotes(text) + " is not of the form A:B");
  const ParameterRange range{parse_number(argument + " A", parts[0]), parse_number(argument + " B", parts[1])};
  if (!(range.from < range.to))
    throw InputError(argument + ": A = " + shown(range.from) + " is not below B = " + shown(range.to));
  return range;
}

namespace {

/// The one value that the members of a group have that move with it: those that are not set themselves.
double value_of_group(const ChosenModel& chosen, const std::string& argument, const Group& group,
                      const Overrides& values) {
  std::vector<std::string> moving;
  std::string all;
  for (const std::string& member : group.members) {
    if (chosen.overrides.contains(member)) continue;
    moving.push_back(member);
    all += (all.empty() ? "" : ", ") + member + " = " + shown(values.at(member));
  }
  if (moving.empty()) return values.at(group.members.front());
  const double value = values.at(moving.front());
  for (const std::string& member : moving)
    if (values.at(member) != value)
      throw InputError(argument + ": the members of " + group.name + " differ: " + all +
                       "; give them one value by --set " + group.name + "=VALUE, or name one of them");
  return value;
}

/// The parameters that a name stands for.
std::vector<std::string> members(const ModelDefinition& definition, const std::string& name) {
  for (const Group& group : definition.groups())
    if (group.name == name) return group.members;
  return {name};
}

}  // namespace

double present_value(const ChosenModel& chosen, const std::string& argument, const std::string& parameter) {
  if (parameter.empty()) throw InputError(argument + " is needed: the name of a parameter");
  const auto values = chosen.definition.values(chosen.overrides);
  for (const Group& group : chosen.definition.groups())
    if (group.name == parameter) return value_of_group(chosen, argument, group, values);
  const auto found = values.find(parameter);
  if (found != values.end()) return found->second;
  try {
    (void)chosen.definition.values({{parameter, 1.0}});
  } catch (const InputError& error) {
    throw InputError(argument + ": " + without_place(error.what()));
  }
  throw InputError(argument + ": model " + in_quotes(chosen.model.name) + " has no parameter " + in_quotes(parameter));
}

double value_inside(const ChosenModel& chosen, const std::string& argument, const std::string& parameter,
                    const ParameterRange& range) {
  const double value = present_value(chosen, argument, parameter);
  if (value < range.from || value > range.to)
    throw InputError("--range: " + parameter + " = " + shown(value) + ", where the first orbit is sought, is outside " +
                     shown(range.from) + ":" + shown(range.to) + "; give a value inside by --set " + parameter +
                     "=VALUE");
  for (const std::string& member : members(chosen.definition, parameter)) {
    for (const Parameter& own : chosen.definition.parameters()) {
      if (own.name != member) continue;
      for (const double end : {range.from, range.to})
        if (!own.admits(end))
          throw InputError("--range: " + parameter + " = " + shown(end) + " is outside " + own.range());
    }
  }
  return value;
}

orbit::Solution find_orbit(const orbit::Problem& problem, const System& system, const State& start,
                           const OrbitOptions& options, const std::atomic<bool>& stop) {
  const OrbitClass wanted = parse_orbit(options.orbit);
  if (wanted.n != 0 && !system.model().forced())
    throw InputError("--orbit: model " + in_quotes(system.model().name) +
                     " has no forcing, so its cycles have no number of forcing periods; leave --orbit out");
  std::string seen;
  const auto note = [&](const orbit::Solution& found) { seen += (seen.empty() ? "" : ", ") + found.label; };
  if (auto found = orbit::settle(problem, system, start, options.transient, 0, &stop)) {
    if (wanted.admits(*found)) return *found;
    note(*found);
  }
  if (wanted.n == 0)
    throw NumericalError("no periodic orbit: the motion does not settle on one within " +
                         std::to_string(options.transient) + " periods (--transient)" +
                         (system.model().forced() ? "; --orbit N-P searches for unstable ones" : ""));
  orbit::SearchOptions search;
  search.only_n = wanted.n;
  search.starts = static_cast<int>(options.starts);
  search.seed = static_cast<std::uint32_t>(options.seed);
  search.stop = &stop;
  search.enough = [&](const orbit::Solution& found) { return wanted.admits(found); };
  for (const orbit::Solution& found : orbit::search(problem, system, start, search)) {
    if (wanted.admits(found)) return found;
    note(found);
  }
  throw NumericalError("no " + options.orbit + " orbit found from " + std::to_string(options.starts) + " motions" +
                       (seen.empty() ? "" : " (found: " + seen + ")") +
                       "; more --starts, another --state or parameter may help");
}

Json solution_json(const orbit::Solution& solution) {
  Json json = Json::object(), multipliers = Json::list();
  for (const auto& multiplier : solution.multipliers)
    multipliers.push(Json::list(std::vector<double>{multiplier.real(), multiplier.imag()}));
  json.set("class", solution.label);
  if (solution.orbit.shape.n > 0) json.set("n", solution.orbit.shape.n);
  json.set("p", solution.chatter ? Json("inf") : Json(solution.impacts)).set("sticking", solution.sticking);
  json.set("stable", solution.stable()).set("period", solution.cycle).set("multipliers", std::move(multipliers));
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
    list.push(std::move(item));
  }
  return list;
}

Json energy_json(const orbit::Energy& energy, const Model& model) {
  Json json = Json::object(), friction = Json::object(), impacts = Json::object();
  for (std::size_t i = 0; i < energy.friction.size(); ++i) friction.set(model.frictions[i].name, energy.friction[i]);
  for (std::size_t i = 0; i < energy.impacts.size(); ++i) impacts.set(model.stops[i].name, energy.impacts[i]);
  json.set("input", energy.input).set("damping", energy.damping);
  json.set("friction", std::move(friction)).set("impacts", std::move(impacts)).set("balance", energy.balance());
  return json;
}

Json margins_json(const std::vector<orbit::Margin>& margins, const System& system) {
  Json list = Json::list();
  const Model& model = system.model();
  const int stops = static_cast<int>(model.stops.size()), frictions = static_cast<int>(model.frictions.size());
  for (const orbit::Margin& margin : margins) {
    const bool friction = mode::of_friction(margin.kind);
    const bool stop = margin.kind == mode::GuardKind::gap || margin.kind == mode::GuardKind::press;
    const int contact = margin.contact + (stop ? 0 : friction ? stops : stops + frictions);
    Json item = Json::object();
    item.set("guard", margin.reversal ? "reversal" : std::string(mode::name(margin.kind)))
        .set("contact", system.contact_name(contact))
        .set("value", margin.value);
    list.push(std::move(item));
  }
  return list;
}

}  // namespace slapstick::app
