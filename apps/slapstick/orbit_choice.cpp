/// The options that say which orbit is meant.
#include "orbit_choice.hpp"

#include <cstdio>

#include "slapstick/base/error.hpp"

namespace slapstick::app {
namespace {

/// The start of a motion is the option --state.
std::string spelled(std::string_view option) { return "--" + std::string(option == "start" ? "state" : option); }

}  // namespace

void OrbitOptions::declare(Arguments& arguments) {
  declare_choice(arguments);
  arguments.count("--transient", transient, 0, 1'000'000'000,
                  "forcing periods to leave out before the first try (500); of a motion without a drive its returns; "
                  "0: an orbit at --state is taken first");
}

void OrbitOptions::declare_choice(Arguments& arguments) {
  arguments.text("--orbit", orbit, "N-P",
                 "forcing periods (without a drive returns) and impacts per cycle, e.g. 1-1 or 2-inf; 1-1-I without "
                 "stick, 1-1-II with; N alone "
                 "for any impacts (what the motion settles on)");
  arguments.flag("--stable", stable, "a stable orbit").without({"--unstable"});
  arguments.flag("--unstable", unstable, "an unstable orbit");
  arguments.flag("--symmetric", symmetric,
                 "an orbit that is its own image half a forcing period later (without a drive half a cycle)");
  arguments.flag("--nearest", nearest, "of the orbits that a search finds, the nearest to --state");
  arguments.count("--starts", starts, 1, 1'000'000, "motions that a search looks through, however long it takes (64)");
  arguments.number("--seconds", seconds, "S", "end the search after this time (10; with --starts no limit)");
  arguments.count("--seed", seed, 0, 4'000'000'000, "of the starts of a search (1)");
}

orbit::OrbitWish OrbitOptions::wish() const {
  orbit::OrbitWish wish{.orbit = orbit, .nearest = nearest};
  if (stable || unstable) wish.stable = stable;
  if (symmetric) wish.symmetric = true;
  wish.transient = static_cast<long>(transient);
  wish.starts = static_cast<int>(starts);
  wish.seconds = seconds;
  wish.seed = static_cast<std::uint32_t>(seed);
  return wish;
}

orbit::OrbitChoice choice_of(const OrbitOptions& options, const State& start) {
  return orbit::choice_of(options.wish(), start, spelled);
}

orbit::Chosen find_orbit(const orbit::Problem& problem, const System& system, const State& start,
                         const OrbitOptions& options, const std::atomic<bool>& stop) {
  orbit::Chosen chosen = orbit::find_orbit(problem, system, start, options.wish(), &stop, spelled);
  if (options.nearest && chosen.search && chosen.search->end == orbit::SearchEnd::time)
    std::fprintf(stderr, "slapstick: --nearest: there may be nearer orbits: a search tried %s\n",
                 tried(*chosen.search, options).c_str());
  return chosen;
}

std::string tried(const orbit::SearchReport& report, const OrbitOptions& options) {
  return orbit::tried(report, options.wish(), spelled);
}

Json report_json(const orbit::SearchReport& report) {
  constexpr const char* ends[] = {"all motions", "found", "time", "stopped"};
  Json json = Json::object();
  json.set("ended", ends[static_cast<int>(report.end)]);
  json.set("motions", report.motions).set("broken_off", report.broken_off).set("near_returns", report.returns);
  json.set("newton_runs", report.newton_runs).set("diverged", report.diverged).set("known", report.known);
  json.set("shorter", report.shorter).set("no_motions", report.no_motions).set("found", report.found);
  return json.set("other", report.other);
}

}  // namespace slapstick::app
