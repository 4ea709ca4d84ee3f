/// Reads the shape of a cycle from a motion, and verifies orbits by running them.
#include "orbit/record.hpp"

#include <algorithm>
#include <cmath>

#include "base/ranges.hpp"
#include "flow/contact_state.hpp"
#include "orbit/equations.hpp"
#include "orbit/short_legs.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::VectorXd;

constexpr double far_off = 0.3;        ///< a cycle's length may be this much off, relative to it
constexpr double same_instant = 1e-8;  ///< of a cycle
constexpr long most_events_autonomous = 400;

}  // namespace

Orbit orbit_of(const std::vector<Seen>& events, std::size_t k, int n) {
  Orbit orbit;
  orbit.shape.n = n;
  for (std::size_t i = 0; i <= k; ++i) {
    orbit.t.push_back(events[i].t);
    if (i < k) orbit.x.push_back(events[i].x);
    if (i > 0) orbit.shape.legs.push_back(events[i].leg);
  }
  const double whole = n > 0 ? std::floor(orbit.t[0]) : orbit.t[0];
  for (double& t : orbit.t) t -= whole;
  for (std::size_t i = 0; i < k && orbit.tied(0); ++i) rotate(orbit, 1);  // begins behind all events of an instant
  return orbit;
}

namespace {

/// The linear response: one leg from phase 0 to phase 0.
Orbit without_events(const Motion& motion, int n) {
  Orbit orbit;
  Leg leg;
  leg.states = motion.system().compiled().mode(motion.mode_id()).states();
  leg.ending = Ending::cut;
  orbit.shape = {{leg}, n};
  orbit.x = {flow::contact_state(motion)};
  orbit.t = {0.0, static_cast<double>(n)};
  return orbit;
}

/// The next event; none of a motion that cannot be followed any more, as one that has left an unstable orbit for ever.
std::optional<Seen> next_or_lost(EventReader& reader, Instant end) {
  try {
    return reader.next(end);
  } catch (const NumericalError&) {
    return std::nullopt;
  }
}

std::optional<Orbit> record_autonomous(const Motion& motion, EventReader& reader, std::vector<Seen> events,
                                       Instant end) {
  const std::int64_t zero = motion.time().period;
  reader.count_from(zero);
  events.front().t = motion.time().since({zero, 0.0});
  VectorXd size = events.front().x.cwiseAbs();
  std::size_t best = 0;
  double least = 0.1;
  for (long count = 0; count < most_events_autonomous; ++count) {
    const std::optional<Seen> seen = next_or_lost(reader, end);
    if (!seen) break;
    events.push_back(*seen);
    size = size.cwiseMax(seen->x.cwiseAbs());
    if (!(seen->leg == events.front().leg)) continue;
    const double distance = (seen->x - events.front().x).norm() / size.norm();
    if (distance < 0.5 * least) {
      least = distance;
      best = events.size() - 1;
    }
    if (distance < 1e-6) break;
  }
  if (best == 0) return std::nullopt;
  return orbit_of(events, best, 0);
}

}  // namespace

std::optional<Orbit> record(const Motion& start, int n, const std::atomic<bool>* stop) {
  Motion motion = start;
  EventReader reader(motion, motion.time().period, stop);
  const int cycle = std::max(1, n);
  constexpr int patience = 1'000'000;  // periods of 1 that an autonomous motion may take to its next event
  const Instant limit = motion.time().plus(n > 0 ? n : patience);
  std::vector<Seen> events;
  if (auto first = reader.next(limit)) events.push_back(std::move(*first));
  if (reader.touched() || stopped(stop)) return std::nullopt;
  if (events.empty()) {
    if (n == 0) return std::nullopt;
    if (!run_to(motion, {motion.time().period + 1, 0.0}, stop, [] {})) return std::nullopt;  // past what only touches
    return without_events(motion, n);
  }
  if (n == 0) return record_autonomous(motion, reader, events, motion.time().plus(patience));
  const Instant end = motion.time().plus(cycle * (1.0 + far_off));
  std::size_t best = 0;
  double least = far_off * cycle;
  while (auto seen = reader.next(end)) {
    events.push_back(std::move(*seen));
    const double off = std::abs(events.back().t - events.front().t - cycle);
    if (off > least || !(events.back().leg == events.front().leg)) continue;
    least = off;
    best = events.size() - 1;
  }
  if (reader.touched() || best == 0) return std::nullopt;
  return orbit_of(events, best, n);
}

Motion from_inside(const System& system, const ModeSet& set, const Orbit& orbit, std::size_t leg, double part) {
  const double after = part * orbit.duration(leg);
  return Motion(system, flow::user_state(system, contact_state(set, state_within(set, orbit, leg, after))),
                Instant{}.plus(orbit.t[leg] + after));
}

namespace {

Motion from_middle(const System& system, const Orbit& orbit, std::size_t leg) {
  return from_inside(system, ModeSet(constant_family(system.model()), {}), orbit, leg, 0.5);
}

std::string mismatch(const System& system, std::size_t i, const Leg* seen, const Leg* wanted) {
  const auto called = [&](const Leg* leg) {
    return leg == nullptr ? "nothing" : std::string(name(leg->event)) + " " + system.contact_name(leg->event_contact);
  };
  return "event " + std::to_string(i + 1) + ": " + called(seen) + " where the orbit has " + called(wanted);
}

/// Legs at which a check begins: those in which least is held, where a state in the user's coordinates loses nothing,
/// and no short flights of a burst, whose gap it would lose.
std::vector<std::size_t> starts(const System& system, const Orbit& orbit) {
  const ModeSet set(constant_family(system.model()), {});
  const std::size_t freest = freest_leg(set, orbit);
  const std::ptrdiff_t least = held(set, orbit.shape.legs[freest]);
  std::vector<std::size_t> legs;
  for (std::size_t i = 0; i < orbit.legs(); ++i)
    if (orbit.shape.legs[i].ending != Ending::chatter && held(set, orbit.shape.legs[i]) == least &&
        orbit.duration(i) > 1e-3 * (orbit.t.back() - orbit.t.front()))
      legs.push_back(i);
  if (legs.empty()) legs.push_back(freest);
  return legs;
}

/// One check: from the middle of a leg to the middle of the next check's.
class Check {
 public:
  Check(const System& system, const Orbit& orbit, Verification& result)
      : system_(system), orbit_(orbit), result_(result) {}

  /// @param next  the next check's leg; may be larger than the number of legs: then it is in the next cycle. @returns
  /// false on a mismatch
  bool run(std::size_t first, std::size_t next);

 private:
  [[nodiscard]] bool meets_all(EventReader& reader, std::vector<std::size_t> legs, double due, double tolerance,
                               std::optional<Seen>& other) const;
  [[nodiscard]] bool to_chatter(const Motion& motion, EventReader& reader, Seen seen, std::uint32_t stops) const;
  /// The motion has another number of impacts up to the limit of this burst.
  void pass_burst(std::size_t& leg) {
    result_.same_chatter = false;
    leg = limit_of_burst(leg);
  }
  [[nodiscard]] std::size_t limit_of_burst(std::size_t leg) const {
    while (orbit_.shape.legs[leg % orbit_.legs()].ending != Ending::chatter) ++leg;
    return leg;
  }
  /// The stops that chatter in the burst of a leg.
  [[nodiscard]] std::uint32_t burst_of(std::size_t leg) const {
    return orbit_.shape.legs[limit_of_burst(leg) % orbit_.legs()].chattering;
  }
  bool refuse(const std::string& why) {
    result_.why = why;
    return false;
  }

  const System& system_;
  const Orbit& orbit_;
  Verification& result_;
};

/// Runs on to the limit of the burst that an event is part of. Stops that chatter together in the orbit may come to
/// rest one after the other: their impacts are at one instant up to rounding.
bool Check::to_chatter(const Motion& motion, EventReader& reader, Seen seen, std::uint32_t stops) const {
  constexpr int most_impacts = 1000;
  const double cycle = orbit_.t.back() - orbit_.t.front();
  for (int k = 0; k < most_impacts; ++k) {
    if (seen.leg.ending == Ending::chatter) stops &= ~seen.leg.chattering;
    if (stops == 0) return true;
    auto next = reader.next(motion.time().plus(cycle));
    if (!next) return false;
    seen = std::move(*next);
  }
  return false;
}

/// Are these the next events, at one instant up to rounding? Which of them is seen first is rounding too.
/// @param other  what is seen in their place, if anything is
bool Check::meets_all(EventReader& reader, std::vector<std::size_t> legs, double due, double tolerance,
                      std::optional<Seen>& other) const {
  while (!legs.empty()) {
    std::optional<Seen> seen = reader.next(Instant{}.plus(due + 2.0 * tolerance));
    const auto same =
        ranges::find_if(legs, [&](std::size_t leg) { return seen && same_end(orbit_.shape.legs[leg], seen->leg); });
    if (same == legs.end() || std::abs(seen->t - due) > tolerance) {
      other = std::move(seen);
      return false;
    }
    legs.erase(same);
  }
  return true;
}

bool Check::run(std::size_t first, std::size_t next) {
  const double cycle = orbit_.t.back() - orbit_.t.front();
  Motion motion = from_middle(system_, orbit_, first);
  if (motion.mode_id() != system_.mode_id(orbit_.shape.legs[first].states))
    return refuse("leg " + std::to_string(first + 1) + " starts in mode " + system_.mode_name(motion.mode_id()));
  EventReader reader(motion, 0);
  for (std::size_t i = first; i < next; ++i) {
    const std::size_t leg = i % orbit_.legs();
    const double due = orbit_.t[leg + 1] + (i >= orbit_.legs() ? cycle : 0.0);
    const double tolerance = is_rounding_leg(orbit_, leg) ? 0.5 * cycle : same_instant * cycle;
    if (const std::vector<std::size_t> tied = ended_at_end(orbit_.shape, leg); tied.size() > 1) {
      std::optional<Seen> other;
      if (meets_all(reader, tied, due, tolerance, other)) {
        i += tied.size() - 1;
      } else if (!other || !in_burst(orbit_, leg) || !to_chatter(motion, reader, *other, burst_of(leg))) {
        return refuse("other events than the orbit's at one instant");
      } else {
        pass_burst(i);
      }
      continue;
    }
    const std::optional<Seen> seen = reader.next(Instant{}.plus(due + 2.0 * tolerance));
    if (reader.touched()) return refuse("the motion grazes in leg " + std::to_string(leg + 1));
    const Leg* wanted = &orbit_.shape.legs[leg];
    if (!seen || !(seen->leg == *wanted)) {
      const bool burst = in_burst(orbit_, leg) && seen &&
                         (seen->leg.ending == Ending::chatter || seen->leg.kind == mode::GuardKind::gap ||
                          seen->leg.kind == mode::GuardKind::slip);
      if (!burst || !to_chatter(motion, reader, *seen, burst_of(leg)))
        return refuse(mismatch(system_, leg, seen ? &seen->leg : nullptr, wanted));
      pass_burst(i);
      continue;
    }
    if (std::abs(seen->t - due) > tolerance)
      return refuse(mismatch(system_, leg, &seen->leg, wanted) + ", at another instant");
  }
  const std::size_t half = next % orbit_.legs();
  const double stop = orbit_.t[half] + 0.5 * orbit_.duration(half) + (next >= orbit_.legs() ? cycle : 0.0);
  const std::optional<Seen> early = reader.next(Instant{}.plus(stop));
  if (reader.touched()) return refuse("the motion grazes in leg " + std::to_string(half + 1));
  if (early) return refuse(mismatch(system_, half, &early->leg, nullptr));
  // The next check begins there by the orbit's own mode: what the last event led to shows in this one's.
  if (motion.mode_id() != system_.mode_id(orbit_.shape.legs[half].states))
    return refuse("the motion is in mode " + system_.mode_name(motion.mode_id()) + " in leg " +
                  std::to_string(half + 1));
  return true;
}

/// The motion's own cycle, where its number of impacts before a chatter's sum is another one.
Orbit as_seen(const System& system, const Orbit& orbit) {
  Orbit turned = orbit;
  rotate(turned, freest_leg(ModeSet(constant_family(system.model()), {}), orbit));
  return record(from_middle(system, turned, 0), orbit.shape.n).value_or(Orbit{});
}

}  // namespace

bool is_motion(const Problem& problem, const Orbit& orbit) {
  try {
    return verify(System(problem.family().model(orbit.values)), orbit).is_motion;
  } catch (const InputError&) {
    return false;
  }
}

Verification verify(const System& system, const Orbit& orbit) {
  Verification result;
  for (std::size_t i = 0; i < orbit.legs(); ++i) {
    if (orbit.duration(i) > 0.0 || orbit.tied(i)) continue;
    if (is_rounding_leg(orbit, i)) {
      result.same_chatter = false;
      continue;
    }
    result.why = "leg " + std::to_string(i + 1) + " has no positive duration";
    return result;
  }
  try {
    if (orbit.shape.legs[0].ending == Ending::cut) {
      Motion motion = from_middle(system, orbit, 0);
      EventReader reader(motion, 0);
      const std::optional<Seen> seen = reader.next(motion.time().plus(orbit.duration(0)));
      if (seen) result.why = mismatch(system, 0, &seen->leg, nullptr);
      result.is_motion = !seen && !reader.touched();
      return result;
    }
    const std::vector<std::size_t> legs = starts(system, orbit);
    Check check(system, orbit, result);
    for (std::size_t j = 0; j < legs.size(); ++j) {
      const std::size_t next = j + 1 < legs.size() ? legs[j + 1] : legs[0] + orbit.legs();
      if (!check.run(legs[j], next)) return result;
    }
    result.is_motion = true;
    if (!result.same_chatter) result.seen = as_seen(system, orbit);
  } catch (const InputError& error) {
    result.why = error.what();
  } catch (const NumericalError& error) {
    result.why = error.what();
  }
  return result;
}

}  // namespace slapstick::orbit
