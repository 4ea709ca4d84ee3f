/// slapstick orbit MODEL
#include <algorithm>

#include "orbit_options.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "slapstick/base/error.hpp"
#include "verb.hpp"
#include "work.hpp"

namespace slapstick::app {
namespace {

struct Options {
  ModelOptions model;
  OrbitOptions orbit;
  std::string out;
  bool all = false, progress = false;
  long long most_n = 0, most_p = -1;  ///< as given; without --all they have no meaning
};

Json whole_json(const orbit::Problem& problem, const orbit::Solution& solution, const System& system) {
  Json json = point_json(problem, solution, system.model());
  json.set("events", events_json(problem, solution, system)).set("impacts", impacts_json(problem, solution, system));
  json.set("energy", energy_json(orbit::energy(problem, solution.orbit), system.model()));
  json.set("margins", margins_json(orbit::margins(problem, solution.orbit), system));
  return json;
}

Json head_json(const ChosenModel& chosen) {
  Json json = Json::object(), parameters = Json::object();
  for (const auto& [name, value] : chosen.definition.values(chosen.overrides)) parameters.set(name, value);
  return json.set("model", chosen.model.name).set("parameters", std::move(parameters));
}

/// --all: everything that a search finds.
Json search_json(const Options& options, const orbit::Problem& problem, const System& system, const State& start,
                 const std::atomic<bool>& stop) {
  Progress progress("motions", static_cast<double>(options.orbit.starts), options.progress);
  orbit::SearchOptions search;
  search.most_n = static_cast<int>(std::max(1LL, options.most_n));
  search.starts = static_cast<int>(options.orbit.starts);
  search.seed = static_cast<std::uint32_t>(options.orbit.seed);
  search.stop = &stop;
  search.progress = [&](int motions) { progress.update(motions); };
  Json list = Json::list();
  for (const orbit::Solution& found : orbit::search(problem, system, start, search))
    if (options.most_p < 0 || found.impacts <= options.most_p) list.push(whole_json(problem, found, system));
  return list;
}

}  // namespace

Action add_orbit(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  options->model.declare(arguments);
  options->model.declare_state(arguments);
  options->orbit.declare(arguments);
  arguments.flag("--all", options->all, "list every orbit that a search finds, instead of one");
  arguments.count("--max-n", options->most_n, 1, 64, "with --all: most forcing periods per cycle (1)");
  arguments.count("--max-p", options->most_p, 0, 1'000'000, "with --all: most impacts per cycle");
  arguments.text("--out", options->out, "FILE", "write the JSON there instead of to standard output");
  arguments.flag("--progress", options->progress, "show progress even if standard error is not a terminal");
  arguments.footer(
      "A periodic orbit, stable or not, by Newton's method on the closed form of its legs, checked by a simulation.\n"
      "Without --orbit: the one that the motion settles on. A search that finds nothing is no proof that there is "
      "nothing.\n"
      "  slapstick orbit vibro-impact --set omega=2.9 --orbit 1-1");
  return [options](const Context& context) {
    FileRoles roles;
    roles.add("MODEL", options->model.source);
    roles.add("--out", options->out);
    Output out(options->out);
    const ChosenModel chosen = options->model.load();
    const State start = options->model.start(chosen);
    if (options->all && !options->orbit.orbit.empty())
      throw InputError("--all lists every orbit; --orbit has no meaning with it");
    if (!options->all && (options->most_n > 0 || options->most_p >= 0))
      throw InputError("--max-n and --max-p need --all");
    if (options->all && !chosen.model.forced())
      throw InputError("--all: model '" + chosen.model.name +
                       "' has no forcing, so there are no n-period orbits to search for");
    const System system =
        affordable_system(chosen, {static_cast<double>(options->orbit.transient) + 1.0, "--transient"});
    const auto problem = orbit::pose(chosen.definition.family({}, chosen.overrides), {});
    Json json = head_json(chosen);
    if (options->all) {
      json.set("orbits", search_json(*options, *problem, system, start, context.stop));
      json.set("note", "found from " + std::to_string(options->orbit.starts) +
                           " motions; a search is no proof of completeness");
    } else {
      const orbit::Solution found = find_orbit(*problem, system, start, options->orbit, context.stop);
      json.set("converged", true);
      const Json whole = whole_json(*problem, found, system);
      for (const auto& [key, value] : std::get<Json::Object>(whole.value())) json.set(key, value);
    }
    if (context.stop.load()) return interrupted;
    out.write(json.dump() + "\n");
    out.commit();
    return done;
  };
}

}  // namespace slapstick::app
