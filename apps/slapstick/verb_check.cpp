/// slapstick check FILE
#include "model_options.hpp"
#include "output.hpp"
#include "slapstick/flow/motion.hpp"
#include "io/json.hpp"
#include "verb.hpp"
#include "work.hpp"

namespace slapstick::app {

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
    const Motion motion(system, options->start(chosen));
    Json parameters = Json::object();
    for (const auto& [name, value] : chosen.definition.values(chosen.overrides)) parameters.set(name, value);
    Json result = Json::object();
    result.set("sound", true).set("name", chosen.model.name);
    result.set("coordinates", chosen.model.size())
        .set("stops", chosen.model.stops.size())
        .set("compliant_stops", chosen.model.compliant_stops.size())
        .set("frictions", chosen.model.frictions.size());
    result.set("period", chosen.model.forcing_period())
        .set("forced", chosen.model.forced())
        .set("parameters", std::move(parameters));
    Output out("");
    out.write(result.dump() + "\n");
    out.commit();
    return done;
  };
}

}  // namespace slapstick::app
