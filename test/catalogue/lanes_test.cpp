/// The failure catalogue through the lanes of a batch: every member whose model lanes can run has the events of its
/// motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <tuple>

#include "batch/same_events.hpp"
#include "catalogue/member.hpp"
#include "flow/compiled_system.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::catalogue {
namespace {

using library::number;
using library::Setup;

struct Tally {
  int in_lanes = 0, no_run = 0, too_stiff = 0, begins_later = 0, of_other_models = 0, unstable = 0;
  long lane_events = 0, motion_events = 0;
};

/// Long drifts and endless chatters are a motion's alone: this many periods and events are compared.
constexpr int most_periods = 200;
constexpr long most_events = 2000;
/// A batch runs whole periods; this many windows take some seconds.
constexpr double most_windows = 1e7;

std::vector<Event> events_up_to(const Setup& setup, int periods, double cap, long most) {
  Motion motion(System(setup.system.model(), {cap}), setup.start);
  std::vector<Event> events;
  while (static_cast<long>(events.size()) < most && motion.advance({periods, 0.0}) == Outcome::event)
    events.push_back(motion.event());
  return events;
}

/// Up to where the member runs, in periods; 0 if it runs nothing.
int periods_of(const Entry& entry, const Setup& setup) {
  if (!entry.contains("run") || entry.contains("fails")) return 0;
  const auto length = [&](const Entry& duration) {
    return duration.is_object() ? number(duration.at("periods"), setup.values)
                                : number(duration, setup.values) / setup.system.period();
  };
  const double all = length(entry["run"]) + (entry.contains("settle") ? length(entry["settle"]) : 0.0);
  return static_cast<int>(std::ceil(std::min(all, static_cast<double>(most_periods))));
}

long most_of(const Member& member) { return std::min(most_events, member.entry.value("most_events", most_events)); }

std::vector<Event> first_of(std::vector<Event> events, std::size_t most) {
  events.resize(std::min(events.size(), most));
  return events;
}

constexpr double tolerance = 1e-9;  ///< of times, in periods

/// A motion tells a graze where the gap's least value is zero within its rounding, and with it what else changes at
/// that instant. A lane's promise begins anew with each window, so its rounding is another one: what is told at such
/// instants is left out. Events of one instant have no order.
std::vector<Event> beside_grazes(std::vector<Event> events, const std::vector<Event>& other) {
  std::vector<Instant> grazes;
  for (const std::vector<Event>* told : {static_cast<const std::vector<Event>*>(&events), &other})
    for (const Event& event : *told)
      if (event.kind == EventKind::graze) grazes.push_back(event.time);
  const auto together = [](Instant a, Instant b) { return std::abs(a.since(b)) <= tolerance; };
  std::erase_if(events, [&](const Event& event) {
    return std::any_of(grazes.begin(), grazes.end(), [&](Instant graze) { return together(event.time, graze); });
  });
  for (auto first = events.begin(); first != events.end();) {
    const auto last =
        std::find_if(first, events.end(), [&](const Event& event) { return !together(event.time, first->time); });
    std::sort(first, last, [](const Event& a, const Event& b) {
      return std::tuple(a.kind, a.contact) < std::tuple(b.kind, b.contact);
    });
    first = last;
  }
  return events;
}

/// Where the motion does not depend on its own windows, the lane has its events. @returns whether it does
bool compare(const Member& member, const Setup& setup, int periods, const BatchRun& run,
             const std::vector<Event>& all) {
  const auto most = static_cast<long>(all.size());
  const bool whole = most < most_of(member);
  const std::vector<Event> expected = beside_grazes(all, run.events), told = beside_grazes(run.events, all);
  const std::vector<Event> found = whole ? told : first_of(told, expected.size());
  const std::size_t agreed = agreeing(expected, found, tolerance);
  if (agreed == expected.size() && agreed == found.size()) return true;
  bool stable = true;
  for (const double cap : {0.03, 0.11}) {
    const std::vector<Event> other = beside_grazes(events_up_to(setup, periods, cap, most), run.events);
    stable =
        stable && other.size() == expected.size() && agreeing(expected, other, 1e-3 * tolerance) == expected.size();
  }
  EXPECT_FALSE(stable) << member.name << ", event " << agreed << ": "
                       << (agreed < expected.size() ? text_of(expected[agreed]) : "none") << " | "
                       << (agreed < found.size() ? text_of(found[agreed]) : "none") << " " << run.failure;
  return false;
}

void examine(const Member& member, Tally& tally) {
  if (member.entry.contains("refused") || member.entry.contains("guards")) return void(++tally.no_run);
  const Setup setup(member.entry, {}, member.given);
  int periods = periods_of(member.entry, setup);
  if (periods < 1) return void(++tally.no_run);
  if (setup.system.windows_per_period() > most_windows) return void(++tally.too_stiff);
  if (setup.begin != Instant{}) return void(++tally.begins_later);
  const std::vector<Event> expected = events_up_to(setup, periods, INFINITY, most_of(member));
  if (static_cast<long>(expected.size()) == most_of(member))
    periods = static_cast<int>(expected.back().time.period) + 1;
  sweep::BatchProblem problem;
  problem.count = 1;
  problem.model_at = [&](std::size_t) { return setup.system.model(); };
  problem.start_at = [&](std::size_t) { return setup.start; };
  problem.plan = {.periods = periods, .events = true};
  problem.threads = 1;
  const BatchRun run = sweep::run_batch(problem).runs.front();
  if (!run.in_lanes) return void(++tally.of_other_models);
  ++tally.in_lanes;
  tally.lane_events += run.lane_events;
  tally.motion_events += run.motion_events;
  tally.unstable += compare(member, setup, periods, run, expected) ? 0 : 1;
}

TEST(CatalogueInLanes, has_the_events_of_its_motions) {
  Tally tally;
  for (const Member& member : all_members()) {
    SCOPED_TRACE(member.name);
    try {
      examine(member, tally);
    } catch (const NumericalError& error) {
      ADD_FAILURE() << error.what();
    }
  }
  std::cout << tally.in_lanes << " of " << all_members().size() << " members in lanes (" << tally.lane_events
            << " events by lanes, " << tally.motion_events << " by motions), " << tally.unstable << " not stable; "
            << tally.no_run << " run nothing, " << tally.begins_later << " begin later than phase 0, "
            << tally.too_stiff << " are too stiff for a period, " << tally.of_other_models
            << " have models of no lane\n";
  EXPECT_GE(3 * tally.in_lanes, static_cast<int>(all_members().size()));
  EXPECT_LE(20 * tally.unstable, tally.in_lanes);
}

}  // namespace
}  // namespace slapstick::catalogue
