/// slapstick orbit MODEL
#include <algorithm>
#include <cstdio>
#include <optional>

#include "measured_json.hpp"
#include "motion_plot.hpp"
#include "orbit_choice.hpp"
#include "orbit_options.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "slapstick/base/error.hpp"
#include "stop_options.hpp"
#include "verb.hpp"
#include "work.hpp"

namespace slapstick::app {
namespace {

struct Options {
  ModelOptions model;
  OrbitOptions orbit;
  std::string of, out, plot, plot_size, show;
  std::vector<std::string> sensitivity;
  bool all = false, progress = false;
  long long most_n = 0, most_p = -1;  ///< as given; without --all they have no meaning
};

/// The statistics that are wanted of each orbit.
struct Asked {
  const ChosenModel& chosen;
  std::vector<Wanted> wanted;
  std::vector<std::string> sensitivity;
};

Json whole_json(const orbit::Problem& problem, const orbit::Solution& solution, const System& system,
                const Asked& asked) {
  Json json = point_json(problem, solution, system.model());
  json.set("sticks", solution.sticks).set("reversals", solution.reversals).set("chatters", solution.chatters);
  json.set("symmetric", orbit::symmetric(problem, solution.orbit));
  json.set("events", events_json(problem, solution, system)).set("impacts", impacts_json(problem, solution, system));
  json.set("extremes", extremes_json(problem, solution, system.model()));
  json.set("energy", energy_json(cycle_energy(problem, solution.orbit), system.model()));
  json.set("margins", margins_json(orbit::margins(problem, solution.orbit), system));
  if (asked.wanted.empty()) return json;
  const Measured found = measure(problem, solution.orbit, quantities_of(asked.wanted));
  json.set("values", values_json(asked.wanted, found)).set("units", units_json(asked.wanted));
  if (asked.sensitivity.empty()) return json;
  const Sensitivity rates = sensitivity_of(asked.sensitivity, asked.chosen, solution.orbit, asked.wanted);
  return json.set("sensitivity", sensitivity_json(asked.wanted, found, rates));
}

Json head_json(const ChosenModel& chosen) {
  Json json = Json::object(), parameters = Json::object();
  for (const auto& [name, value] : chosen.definition.values(chosen.overrides)) parameters.set(name, value);
  return json.set("model", chosen.model.name).set("parameters", std::move(parameters));
}

/// --all: every orbit that a search finds, as far as it is admitted.
void search_all(const Options& options, const orbit::Problem& problem, const System& system, const State& start,
                const Asked& asked, const std::atomic<bool>& stop, Json& json) {
  orbit::SearchOptions search = orbit::search_options(options.orbit.wish(), &stop);
  search.most_n = static_cast<int>(std::max(1LL, options.most_n));
  Progress progress("motions", static_cast<double>(search.starts), options.progress);
  search.progress = [&](int motions) { progress.update(motions); };
  const orbit::OrbitChoice choice = choice_of(options.orbit, start);
  const orbit::SearchResult result = orbit::search(problem, system, start, search);
  Json list = Json::list();
  for (const orbit::Solution& found : result.orbits)
    if (choice.admits(problem, found) && (options.most_p < 0 || found.impacts <= options.most_p))
      list.push(whole_json(problem, found, system, asked));
  json.set("orbits", std::move(list)).set("search", report_json(result.report));
  json.set("note", "found from " + tried(result.report, options.orbit) + "; a search is no proof of completeness");
}

/// The cycle as a motion from the orbit's state on: in one cycle an unstable one is not yet lost.
figure::Figure cycle_figure(const Options& options, const orbit::Problem& problem, const orbit::Solution& solution,
                            const System& system, const ChosenModel& chosen) {
  const RelativeMotion pair(chosen.model, shown_contact(chosen.model, StopOptions{}.choice(chosen.model)));
  MotionRecord record(system, options.show.empty() ? shown_pair(pair, chosen)
                                                   : shown_by_name(options.show, all_contacts(chosen.model), chosen));
  const int n = solution.orbit.shape.n;
  const Instant end = n > 0 ? Instant{n, 0.0} : Instant{}.plus(solution.cycle / system.period());
  record.keep({}, end);
  Motion motion(system, orbit::at_phase_zero(problem, solution.orbit));
  for (Outcome outcome = Outcome::event; outcome == Outcome::event;) {
    outcome = motion.advance(end);
    record.add_segment(motion);
    if (outcome == Outcome::event) record.add_event(motion);
  }
  return motion_figure(record);
}

int draw(const Plot& plot, const Options& options, const orbit::Problem& problem, const orbit::Solution& solution,
         const System& system, const ChosenModel& chosen) {
  if (!plot.wanted()) return done;
  if (!solution.is_motion) {
    std::fprintf(stderr, "slapstick: --plot: the orbit is no motion (%s), so its picture is not made\n",
                 solution.why.c_str());
    return nothing_to_draw;
  }
  plot.write(cycle_figure(options, problem, solution, system, chosen));
  return done;
}

int run(const Options& options, const Context& context) {
  FileRoles roles;
  roles.add("MODEL", options.model.source);
  roles.add("--out", options.out);
  roles.add_plot(options.plot);
  Output out(options.out);
  const Plot plot(options.plot, options.plot_size);
  const ChosenModel chosen = options.model.load();
  const State start = options.model.start(chosen);
  const Asked asked{chosen, parse_of(options.of, chosen), options.sensitivity};
  const System system = affordable_system(chosen, {static_cast<double>(options.orbit.transient) + 1.0, "--transient"});
  const auto problem = orbit::pose(chosen.definition.family({}, chosen.overrides), {});
  Json json = head_json(chosen);
  std::optional<orbit::Solution> drawn;
  if (options.all) {
    search_all(options, *problem, system, start, asked, context.stop, json);
  } else {
    const orbit::Chosen found = find_orbit(*problem, system, start, options.orbit, context.stop);
    json.set("converged", true);
    const Json whole = whole_json(*problem, *found.orbit, system, asked);
    for (const auto& [key, value] : std::get<Json::Object>(whole.value())) json.set(key, value);
    json.set("settles", found.settles);
    if (found.search) json.set("search", report_json(*found.search));
    drawn = *found.orbit;
  }
  if (context.stop.load()) return interrupted;
  out.write(json.dump() + "\n");
  out.commit();
  return drawn ? draw(plot, options, *problem, *drawn, system, chosen) : done;
}

}  // namespace

Action add_orbit(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  options->model.declare(arguments);
  options->model.declare_state(arguments);
  options->orbit.declare(arguments);
  arguments.flag("--all", options->all, "list every orbit that a search finds, instead of one")
      .without({"--orbit", "--plot", "--nearest"});
  arguments.count("--max-n", options->most_n, 1, 64, "most forcing periods, or returns, per cycle (1)").with({"--all"});
  arguments.count("--max-p", options->most_p, 0, 1'000'000, "most impacts per cycle").with({"--all"});
  declare_of(arguments, options->of);
  declare_sensitivity(arguments, options->sensitivity);
  arguments.text("--out", options->out, "FILE", "write the JSON there instead of to standard output");
  arguments.text("--plot", options->plot, "F.png", "picture of the cycle: .png, .pdf or .svg, as of `simulate`");
  declare_plot_size(arguments, options->plot_size);
  arguments.text("--show", options->show, "Q,X:Y,..", "panels of the picture, as of `simulate`").with({"--plot"});
  arguments.flag("--progress", options->progress, "show progress even if standard error is not a terminal");
  arguments.footer(
      "A periodic orbit, stable or not, by Newton's method on the closed form of its legs, checked by a simulation.\n"
      "Of a motion without a drive N counts returns: how often the rarest of its events happens in a cycle.\n"
      "Without --orbit: the one that the motion settles on. A search that finds nothing is no proof that there is "
      "nothing.\n"
      "  slapstick orbit vibro-impact --set omega=2.9 --orbit 1-1");
  return [options](const Context& context) { return run(*options, context); };
}

}  // namespace slapstick::app
