/// slapstick check FILE
#include "io/json.hpp"
#include "model_options.hpp"
#include "output.hpp"
#include "slapstick/flow/energy_sources.hpp"
#include "slapstick/flow/motion.hpp"
#include "slapstick/flow/natural_modes.hpp"
#include "slapstick/flow/struck_together.hpp"
#include "verb.hpp"
#include "work.hpp"

namespace slapstick::app {

namespace {

/// What the file states; a text is empty where it states nothing.
Json units(const ChosenModel& chosen) {
  const StatedUnits stated = chosen.definition.stated_units();
  Json result = Json::object(), parameters = Json::object();
  result.set("time", stated.time);
  for (std::size_t i = 0; i < stated.coordinates.size(); ++i)
    result.set(chosen.model.coordinates[i].name, stated.coordinates[i]);
  for (const Parameter& parameter : chosen.definition.parameters()) parameters.set(parameter.name, parameter.unit);
  return result.set("parameters", std::move(parameters));
}

Json natural(const System& system, const State& start) {
  Json list = Json::list();
  for (const NaturalMode& mode : natural_modes(system, sliding_states(system, start))) {
    Json entry = Json::object();
    if (mode.oscillates()) entry.set("frequency", mode.frequency).set("damping_ratio", mode.damping_ratio());
    list.push(std::move(entry.set("decay", mode.decay)));
  }
  return list;
}

}  // namespace

Action add_check(Arguments& arguments) {
  auto options = std::make_shared<ModelOptions>();
  arguments.positional("FILE", options->source, "a model file (or a built-in model)");
  arguments.repeated("--set", options->sets, "NAME=VALUE", "give a parameter another value; may be repeated");
  arguments.footer(
      "Reads the file, checks every value, and prepares a motion from its start. Prints a short description as JSON; "
      "the\n"
      "exit status is 2, and the message names file, line and key, if it is not sound.");
  return [options](const Context&) {
    const ChosenModel chosen = options->load();
    const System system = affordable_system(chosen, {});
    const State start = options->start(chosen);
    const Motion motion(system, start);
    Json parameters = Json::object();
    for (const auto& [name, value] : chosen.definition.values(chosen.overrides)) parameters.set(name, value);
    Json result = Json::object();
    result.set("sound", true).set("name", chosen.model.name);
    int inner = 0;
    for (int i = 0; i < chosen.model.size(); ++i) inner += chosen.model.is_inner(i) ? 1 : 0;
    result.set("coordinates", chosen.model.size() - inner)
        .set("stops", chosen.model.stops.size())
        .set("compliant_stops", chosen.model.compliant_stops.size())
        .set("frictions", chosen.model.frictions.size())
        .set("characteristics", chosen.model.characteristics.size());
    Json feeds = Json::list(), rows = Json::list(), falls = Json::list(), laid = Json::object();
    for (const std::string& part : energy_sources(chosen.model)) feeds.push(part);
    for (const std::string& part : falling_forces(chosen.model)) falls.push(part);
    for (const LaidLaw& law : chosen.definition.laid_laws(chosen.overrides)) laid.set(law.friction, law.largest_error);
    for (const int stop : struck_together(chosen.model, start))
      rows.push(chosen.model.stops[static_cast<std::size_t>(stop)].name);
    result.set("impact_law", chosen.model.impact_law == ImpactLaw::sequence ? "sequence" : "moreau");
    if (!std::get<Json::List>(rows.value()).empty())
      result.set("struck_together", std::move(rows)).set("note", how_rows_are_struck);
    result.set("period", chosen.model.forcing_period())
        .set("forced", chosen.model.forced())
        .set("feeds_energy", std::move(feeds))
        .set("falling_forces", std::move(falls))
        .set("laid_errors", std::move(laid))
        .set("parameters", std::move(parameters))
        .set("units", units(chosen))
        .set("natural_modes", natural(system, start));
    Output out("");
    out.write(result.dump() + "\n");
    out.commit();
    return done;
  };
}

}  // namespace slapstick::app
