/// Which orbit is meant, and what is said when it is not found.
#include "orbit_choice.hpp"

#include <algorithm>
#include <cstdio>

#include "base/ranges.hpp"
#include "base/text.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::app {
namespace {

constexpr double default_seconds = 10.0;
constexpr int longest_unnamed = 4;  ///< forcing periods of an orbit whose N is not given

bool chooses(const OrbitOptions& options) { return options.unstable || options.symmetric || options.nearest; }

double seconds_of(const OrbitOptions& options) {
  if (options.seconds > 0.0) return options.seconds;
  return options.starts > 0 ? 0.0 : default_seconds;
}

std::string count(long number, const std::string& what) {
  return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

}  // namespace

void OrbitOptions::declare(Arguments& arguments) {
  arguments.text("--orbit", orbit, "N-P",
                 "forcing periods and impacts per cycle, e.g. 1-1 or 2-inf; 1-1-I without stick, 1-1-II with; N alone "
                 "for any impacts (what the motion settles on)");
  arguments.flag("--stable", stable, "a stable orbit");
  arguments.flag("--unstable", unstable, "an unstable orbit");
  arguments.flag("--symmetric", symmetric, "an orbit that is its own image half a forcing period later");
  arguments.flag("--nearest", nearest, "of the orbits that a search finds, the nearest to --state");
  arguments.count("--transient", transient, 0, 1'000'000'000,
                  "forcing periods to leave out before the first try (500)");
  arguments.count("--starts", starts, 1, 1'000'000, "motions that a search looks through, however long it takes (64)");
  arguments.number("--seconds", seconds, "S", "end the search after this time (10; with --starts no limit)");
  arguments.count("--seed", seed, 0, 4'000'000'000, "of the starts of a search (1)");
}

orbit::SearchOptions OrbitOptions::search(const std::atomic<bool>& stop) const {
  orbit::SearchOptions search;
  if (starts > 0) search.starts = static_cast<int>(starts);
  search.seed = static_cast<std::uint32_t>(seed);
  search.stop = &stop;
  const double limit = seconds_of(*this);
  if (limit > 0.0) {
    const std::chrono::duration<double> length(std::min(limit, 1e9));
    search.until =
        std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(length);
  }
  return search;
}

orbit::OrbitChoice choice_of(const OrbitOptions& options, const State& start) {
  orbit::OrbitChoice choice;
  if (options.seconds < 0.0) throw InputError("--seconds: " + shown(options.seconds) + " is negative");
  if (options.stable && options.unstable) throw InputError("--stable and --unstable exclude one another");
  if (options.stable || options.unstable) choice.stable = options.stable;
  if (options.symmetric) choice.symmetric = true;
  if (options.nearest) choice.nearest = start;
  if (options.orbit.empty()) return choice;
  const std::vector<std::string> parts = split(options.orbit, '-');
  if (parts.size() > 3 || (parts.size() == 3 && parts[2] != "I" && parts[2] != "II"))
    throw InputError("--orbit: " + in_quotes(options.orbit) +
                     " is not of the form N-P, N-P-I or N-P-II, as 1-1, 2-inf or 1-1-II");
  choice.n = static_cast<int>(parse_integer("--orbit N-P", parts[0], 1, 1000));
  if (parts.size() == 1) return choice;
  if (parts[1] == "inf")
    choice.chatter = true;
  else
    choice.p = parse_integer("--orbit N-P", parts[1], 0, 100'000);
  if (parts.size() == 3) choice.sticking = parts[2] == "II";
  return choice;
}

namespace {

/// "unstable 1-1 orbit"
std::string called(const OrbitOptions& options) {
  std::string text = options.stable ? "stable " : options.unstable ? "unstable " : "";
  if (options.symmetric) text += "symmetric ";
  return text + (options.orbit.empty() ? "periodic" : options.orbit) + " orbit";
}

/// What became of the motion from the start.
std::string settled_on(const orbit::Settled& settled) {
  const std::string cycle = "the motion settles on a cycle of " + count(settled.n, "period");
  switch (settled.end) {
    case orbit::SettleEnd::orbit:
      return "the motion settles on " + (settled.orbit ? settled.orbit->label : "another");
    case orbit::SettleEnd::no_orbit:
      return cycle + " whose equations are not solved";
    case orbit::SettleEnd::time:
      return "the time was over before the motion had settled (--seconds)";
    case orbit::SettleEnd::no_cycle:
    case orbit::SettleEnd::stopped:
      break;
  }
  return "the motion does not settle on a cycle within " + count(settled.periods, "period") + " (--transient)";
}

std::string labels(const std::vector<orbit::Solution>& orbits) {
  std::vector<std::string> all;
  for (const orbit::Solution& orbit : orbits) {
    const std::string text = orbit.label + (orbit.stable() ? "" : " unstable");
    if (ranges::find(all, text) == all.end()) all.push_back(text);
  }
  std::string list;
  for (const std::string& text : all) list += (list.empty() ? "" : ", ") + text;
  return list;
}

[[noreturn]] void refuse(const orbit::Chosen& chosen, const OrbitOptions& options, bool forced) {
  const std::string none = "no " + called(options) + ": " + settled_on(chosen.settled);
  if (!chosen.search) throw NumericalError(none + (forced ? "; --orbit N-P or --unstable searches for others" : ""));
  const std::string found = labels(chosen.others);
  throw NumericalError(none + "; a search tried " + tried(*chosen.search, options) +
                       (found.empty() ? "" : " (found: " + found + ")") +
                       "; more --starts or --seconds, another --state or parameter may help");
}

}  // namespace

orbit::Chosen find_orbit(const orbit::Problem& problem, const System& system, const State& start,
                         const OrbitOptions& options, const std::atomic<bool>& stop) {
  const orbit::OrbitChoice choice = choice_of(options, start);
  const bool forced = system.model().forced();
  if (!forced && (choice.n || chooses(options)))
    throw InputError((choice.n ? "--orbit" : "--unstable, --symmetric, --nearest") + std::string(": model ") +
                     in_quotes(system.model().name) +
                     " has no forcing, so its cycles have no number of forcing periods and no phase; what the motion "
                     "settles on is found without");
  orbit::SearchOptions search = options.search(stop);
  search.most_n = longest_unnamed;
  orbit::Chosen chosen =
      orbit::choose(problem, system, start, choice,
                    {.transient = static_cast<long>(options.transient), .stop = &stop, .until = search.until}, search);
  if (!chosen.orbit) refuse(chosen, options, forced);
  if (options.nearest && chosen.search && chosen.search->end == orbit::SearchEnd::time)
    std::fprintf(stderr, "slapstick: --nearest: there may be nearer orbits: a search tried %s\n",
                 tried(*chosen.search, options).c_str());
  return chosen;
}

std::string tried(const orbit::SearchReport& report, const OrbitOptions& options) {
  std::string text = count(report.motions, "motion") + ", " + count(report.returns, "near return") + ", " +
                     count(report.newton_runs, "run") + " of Newton's method";
  std::string part;
  const auto add = [&](long number, const std::string& what) {
    if (number > 0) part += (part.empty() ? "" : ", ") + std::to_string(number) + " " + what;
  };
  add(report.diverged, "without convergence");
  add(report.known, "to orbits found before");
  add(report.shorter, "to shorter orbits several times over");
  add(report.no_motions, "to what is no motion");
  add(report.other, "to orbits that were not meant");
  if (!part.empty()) text += " (" + part + ")";
  if (report.end == orbit::SearchEnd::time)
    text += "; it ended after " + shown(seconds_of(options)) +
            " s (--seconds), not by itself: on a faster machine it "
            "tries more";
  return text;
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
