/// Which orbit is meant, and what is said when there is none.
#include <algorithm>
#include <charconv>

#include "orbits.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::python {
namespace {

constexpr double default_seconds = 10.0;
constexpr int longest_unnamed = 4;  ///< forcing periods of an orbit whose N is not given

std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char letter : text)
    if (letter == '-')
      parts.emplace_back();
    else
      parts.back() += letter;
  return parts;
}

int count_of(const std::string& text, const std::string& wish, int least) {
  int number = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size() && number >= least) return number;
  throw InputError("orbit: '" + wish + "' is not of the form N-P, N-P-I or N-P-II, as 1-1, 2-inf or 1-1-II");
}

orbit::OrbitChoice choice_of(const OrbitWish& wish, const State& start) {
  orbit::OrbitChoice choice;
  choice.stable = wish.stable;
  choice.symmetric = wish.symmetric;
  if (wish.nearest) choice.nearest = start;
  if (wish.orbit.empty()) return choice;
  const std::vector<std::string> parts = parts_of(wish.orbit);
  if (parts.size() > 3 || (parts.size() == 3 && parts[2] != "I" && parts[2] != "II"))
    static_cast<void>(count_of("", wish.orbit, 0));
  choice.n = count_of(parts[0], wish.orbit, 1);
  if (parts.size() == 1) return choice;
  if (parts[1] == "inf")
    choice.chatter = true;
  else
    choice.p = count_of(parts[1], wish.orbit, 0);
  if (parts.size() == 3) choice.sticking = parts[2] == "II";
  return choice;
}

}  // namespace

orbit::SearchOptions search_options(const OrbitWish& wish, const std::atomic<bool>* stop) {
  orbit::SearchOptions search;
  if (wish.starts > 0) search.starts = wish.starts;
  search.most_n = longest_unnamed;
  search.seed = wish.seed;
  search.stop = stop;
  const double limit = wish.seconds > 0.0 ? wish.seconds : wish.starts > 0 ? 0.0 : default_seconds;
  using Clock = std::chrono::steady_clock;
  if (limit > 0.0)
    search.until =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(std::min(limit, 1e9)));
  return search;
}

namespace {

std::string called(const OrbitWish& wish) {
  std::string text = !wish.stable ? "" : *wish.stable ? "stable " : "unstable ";
  if (wish.symmetric) text += *wish.symmetric ? "symmetric " : "asymmetric ";
  return text + (wish.orbit.empty() ? "periodic" : wish.orbit) + " orbit";
}

std::string settled_on(const orbit::Settled& settled) {
  using enum orbit::SettleEnd;
  const std::string periods = std::to_string(settled.periods) + (settled.periods == 1 ? " period" : " periods");
  if (settled.end == orbit) return "the motion settles on " + (settled.orbit ? settled.orbit->label : "another");
  if (settled.end == no_orbit)
    return "the motion settles on a cycle of " + std::to_string(settled.n) + " periods whose equations are not solved";
  if (settled.end == time) return "the time was over before the motion had settled (seconds)";
  return "the motion does not settle on a cycle within " + periods + " (transient)";
}

[[noreturn]] void refuse(const orbit::Chosen& chosen, const OrbitWish& wish, bool forced) {
  const std::string none = "no " + called(wish) + ": " + settled_on(chosen.settled);
  if (!chosen.search) throw NumericalError(none + (forced ? "; orbit='N-P' or stable=False searches for others" : ""));
  std::string found;
  for (const orbit::Solution& other : chosen.others)
    found += (found.empty() ? "" : ", ") + other.label + (other.stable() ? "" : " unstable");
  throw NumericalError(none + "; a search tried " + std::to_string(chosen.search->motions) + " motions, " +
                       std::to_string(chosen.search->returns) + " near returns, " +
                       std::to_string(chosen.search->newton_runs) + " runs of Newton's method" +
                       (found.empty() ? "" : " (found: " + found + ")") +
                       "; more starts or seconds, another start or parameter may help");
}

}  // namespace

FoundOrbit find_orbit(SharedSetting of, const State& start, const OrbitWish& wish, const std::atomic<bool>* stop) {
  const orbit::OrbitChoice choice = choice_of(wish, start);
  const bool forced = of->system.model().forced();
  if (!forced && !choice.none())
    throw InputError("orbit: model '" + of->system.model().name +
                     "' has no forcing, so its cycles have no number of forcing periods and no phase; what the motion "
                     "settles on is found without");
  const orbit::SearchOptions search = search_options(wish, stop);
  orbit::Chosen chosen = orbit::choose(*of->problem, of->system, start, choice,
                                       {.transient = wish.transient, .stop = stop, .until = search.until}, search);
  if (stopped(stop)) return {std::move(of), {}};
  if (!chosen.orbit) refuse(chosen, wish, forced);
  return {std::move(of), std::move(*chosen.orbit), chosen.settles};
}

}  // namespace slapstick::python
