/// Which orbit is meant, and what is said when it is not found.
#include "slapstick/orbit/find.hpp"

#include <algorithm>

#include "base/decimal.hpp"
#include "base/ranges.hpp"
#include "base/text.hpp"
#include "orbit/equations.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::orbit {
namespace {

constexpr double default_seconds = 10.0;
constexpr int longest_unnamed = 4;  ///< forcing periods or returns of an orbit whose N is not given

double seconds_of(const OrbitWish& wish) {
  if (wish.seconds > 0.0) return wish.seconds;
  return wish.starts > 0 ? 0.0 : default_seconds;
}

std::string count(long number, const std::string& what) {
  return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

/// A whole number of [least, most] within "N-P-I".
int part_of(const OrbitWish& wish, const std::string& part, long long least, long long most, const Spelling& spelling) {
  long long number = 0;
  if (read_decimal(part, number) == std::errc() && number >= least && number <= most) return static_cast<int>(number);
  throw InputError(spelling("orbit") + ": " + in_quotes(wish.orbit) +
                   " is not of the form N-P, N-P-I or N-P-II, as 1-1, 2-inf or 1-1-II, with N in [1, 1000] and P in "
                   "[0, 100000]; without a drive also free-P-I");
}

void read_class(const OrbitWish& wish, const Spelling& spelling, OrbitChoice& choice) {
  const std::vector<std::string> parts = split(wish.orbit, '-');
  if (parts.size() > 3 || (parts.size() == 3 && parts[2] != "I" && parts[2] != "II"))
    static_cast<void>(part_of(wish, "", 0, 0, spelling));
  if (parts[0] != "free" || parts.size() == 1) choice.n = part_of(wish, parts[0], 1, 1000, spelling);
  if (parts.size() == 1) return;
  if (parts[1] == "inf")
    choice.chatter = true;
  else
    choice.p = part_of(wish, parts[1], 0, 100'000, spelling);
  if (parts.size() == 3) choice.sticking = parts[2] == "II";
}

/// "unstable 1-1 orbit"
std::string called(const OrbitWish& wish) {
  std::string text = !wish.stable ? "" : *wish.stable ? "stable " : "unstable ";
  if (wish.symmetric) text += *wish.symmetric ? "symmetric " : "asymmetric ";
  return text + (wish.orbit.empty() ? "periodic" : wish.orbit) + " orbit";
}

/// What became of the motion from the start.
std::string settled_on(const Settled& settled, bool free, const Spelling& spelling) {
  const std::string period = free ? "return" : "period";
  switch (settled.end) {
    case SettleEnd::orbit:
      return "the motion settles on " + (settled.orbit ? settled.orbit->label : "another");
    case SettleEnd::no_orbit:
      return "the motion settles on a cycle of " + count(settled.n, period) + " whose equations are not solved";
    case SettleEnd::time:
      return "the time was over before the motion had settled (" + spelling("seconds") + ")";
    case SettleEnd::rest:
      return "the motion has no more events: the motion comes to rest, or goes away for ever (classify says which)";
    case SettleEnd::no_cycle:
    case SettleEnd::stopped:
      break;
  }
  return "the motion does not settle on a cycle within " + count(settled.periods, period) + " (" +
         spelling("transient") + ")";
}

std::string labels(const std::vector<Solution>& orbits) {
  std::vector<std::string> all;
  for (const Solution& orbit : orbits) {
    const std::string text = orbit.label + (orbit.stable() ? "" : " unstable");
    if (ranges::find(all, text) == all.end()) all.push_back(text);
  }
  std::string list;
  for (const std::string& text : all) list += (list.empty() ? "" : ", ") + text;
  return list;
}

[[noreturn]] void refuse(const Chosen& chosen, const OrbitWish& wish, bool free, const Spelling& spelling) {
  const std::string none = "no " + called(wish) + ": " + settled_on(chosen.settled, free, spelling);
  if (!chosen.search)
    throw NumericalError(none + "; " + spelling("orbit") + " or " + spelling("unstable") + " searches for others");
  const std::string found = labels(chosen.others);
  throw NumericalError(none + "; a search tried " + tried(*chosen.search, wish, spelling) +
                       (found.empty() ? "" : " (found: " + found + ")") + "; more " + spelling("starts") + " or " +
                       spelling("seconds") + ", another " + spelling("start") + " or parameter may help");
}

}  // namespace

OrbitChoice choice_of(const OrbitWish& wish, const State& start, const Spelling& spelling) {
  if (wish.seconds < 0.0) throw InputError(spelling("seconds") + ": " + shown(wish.seconds) + " is negative");
  OrbitChoice choice;
  choice.stable = wish.stable;
  choice.symmetric = wish.symmetric;
  if (wish.nearest) choice.nearest = start;
  if (!wish.orbit.empty()) read_class(wish, spelling, choice);
  return choice;
}

SearchOptions search_options(const OrbitWish& wish, const std::atomic<bool>* stop) {
  constexpr double longest = 1e9;  // seconds: more would not fit the clock
  using Clock = std::chrono::steady_clock;
  SearchOptions search;
  if (wish.starts > 0) search.starts = wish.starts;
  search.most_n = longest_unnamed;
  search.seed = wish.seed;
  search.stop = stop;
  const double limit = seconds_of(wish);
  if (limit > 0.0)
    search.until = Clock::now() +
                   std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(std::min(limit, longest)));
  return search;
}

Chosen find_orbit(const Problem& problem, const System& system, const State& start, const OrbitWish& wish,
                  const std::atomic<bool>* stop, const Spelling& spelling) {
  const OrbitChoice choice = choice_of(wish, start, spelling);
  if (!problem.free() && wish.orbit.starts_with("free"))
    throw InputError(spelling("orbit") + ": model " + in_quotes(system.model().name) +
                     " is driven, so its cycles have whole numbers of forcing periods: N-P-I");
  const SearchOptions search = search_options(wish, stop);
  Chosen chosen = choose(problem, system, start, choice,
                         {.transient = wish.transient, .stop = stop, .until = search.until}, search);
  if (!chosen.orbit) refuse(chosen, wish, problem.free(), spelling);
  return chosen;
}

std::string tried(const SearchReport& report, const OrbitWish& wish, const Spelling& spelling) {
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
  if (report.end == SearchEnd::time)
    text += "; the search ended after " + shown(seconds_of(wish)) + " s (" + spelling("seconds") +
            "), not by itself: a faster machine tries more";
  return text;
}

}  // namespace slapstick::orbit
