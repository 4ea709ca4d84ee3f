/// The margins of an orbit: least values of guards, speeds of events, lengths of legs.
#include "orbit/margins.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/ranges.hpp"
#include "base/set_bits.hpp"
#include "orbit/equations.hpp"
#include "orbit/leg_flow.hpp"
#include "slapstick/orbit/periodic_orbit.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using mode::GuardKind;

constexpr double samples_per_step =
    8.0;  ///< of ModeRates::longest_step: what a guard does between them is found by its slope

bool of_gap(GuardKind kind) { return kind == GuardKind::gap || kind == GuardKind::engage || kind == GuardKind::leave; }

/// The displacement of a guard's contact, of all except corners.
int displacement(const mode::Frame& frame, GuardKind kind, int contact) {
  if (mode::of_friction(kind)) return frame.frictions[contact].own;
  if (kind == GuardKind::gap || kind == GuardKind::press) return frame.stops[contact].own;
  return frame.compliant[contact].own;
}

/// Is a contact's state another one than before, and this guard its own?
bool of_contact_that_changed(const mode::ContactStates& a, const mode::ContactStates& b, const mode::Guard& guard) {
  const auto i = static_cast<std::size_t>(guard.contact);
  if (guard.kind == GuardKind::slip) return a.frictions[i] != b.frictions[i];
  if (guard.kind == GuardKind::gap) return a.stops[i] != b.stops[i];
  return false;
}

/// Is this guard zero where a guard of this kind and contact has ended the leg before?
bool zero_with(const mode::Frame& frame, GuardKind kind, int contact, const mode::Guard& guard) {
  if (of_crossing(kind) || of_crossing(guard.kind)) {  // the line just crossed, seen from its other side
    const bool same = (of_corner(kind) && of_corner(guard.kind)) || (of_load(kind) && of_load(guard.kind)) ||
                      (of_bound(kind) && of_bound(guard.kind));
    return same && kind != guard.kind && contact == guard.contact;
  }
  const int was = displacement(frame, kind, contact), is = displacement(frame, guard.kind, guard.contact);
  if (frame.parallel(was, is) == 0) return false;
  if (of_gap(guard.kind))
    return of_gap(kind) || kind == GuardKind::press || kind == GuardKind::let_go || kind == GuardKind::push;
  if (guard.kind == GuardKind::slip)
    return frame.in_step(was, is) && (mode::of_friction(kind) || kind == GuardKind::press);
  return false;
}

/// Is this guard zero at a leg's start because of the event there?
/// At a knot of a signal a force may jump: a contact that lets go there begins at zero.
bool zero_by_event(const mode::Frame& frame, const Leg& before, const Leg& behind, const mode::Guard& guard) {
  if (before.ending == Ending::cut) return false;
  if (before.ending == Ending::knot) return of_contact_that_changed(before.states, behind.states, guard);
  if (before.ending != Ending::chatter) return zero_with(frame, before.kind, before.contact, guard);
  return ranges::any_of(set_bits(before.chattering),
                        [&](int stop) { return zero_with(frame, GuardKind::gap, stop, guard); });
}

/// .. because of one of the events there?
bool zero_by_events(const mode::Frame& frame, const Itinerary& shape, std::size_t leg, const mode::Guard& guard) {
  return ranges::any_of(ended_at_start(shape, leg), [&](std::size_t before) {
    return zero_by_event(frame, shape.legs[before], shape.legs[leg], guard);
  });
}

/// Is this the relative velocity of the pair whose gap ends the leg? Its value there is the speed of the impact, which
/// is watched by itself.
bool is_speed_of(const mode::Frame& frame, const Leg& leg, const mode::Guard& guard) {
  if (leg.ending != Ending::guard || !of_gap(leg.kind) || guard.kind != GuardKind::slip) return false;
  return frame.in_step(displacement(frame, leg.kind, leg.contact), frame.frictions[guard.contact].own);
}

/// A leg sampled: the extended state at equal distances.
struct Course {
  Course(const ModeSet& set, const Leg& leg, const VectorXd& x, double t_begin, double duration)
      : mode(set.mode(leg.states)) {
    const double s = duration * set.period();
    const auto count =
        static_cast<std::size_t>(std::max(4.0, std::ceil(samples_per_step * std::abs(s) / mode.longest_step)));
    step = s / static_cast<double>(count);
    Jet X = leg_start(set, leg, x, t_begin);
    Jet bare(X.all.rows(), 0, 0);
    bare.value() = X.value();
    const Eigen::MatrixXd move = is_long(mode, s) ? short_flow(mode, step) : Eigen::MatrixXd();
    for (std::size_t i = 0; i <= count; ++i) {
      states.emplace_back(bare.value());
      if (i == count) break;
      if (move.size() > 0)
        bare.value() = move * states.back();
      else
        flow(mode, step, bare);
    }
  }

  const ModeRates& mode;
  double step = 0.0;
  std::vector<VectorXd> states;
};

struct Least {
  double value = std::numeric_limits<double>::infinity();
  double at = 0.0;  ///< time from the leg's start
  void take(double candidate, double when) {
    if (candidate >= value) return;
    value = candidate;
    at = when;
  }
};

/// A sum of a state's components along one step of a course.
class AlongStep {
 public:
  AlongStep(const Course& course, const mode::RowVector& row, std::size_t i)
      : course_(course), row_(row), start_(course.states[i]) {}

  [[nodiscard]] double at(double s) const {
    Jet X(start_.size(), 0, 0);
    X.value() = start_;
    flow(course_.mode, s, X);
    return row_.dot(X.value());
  }

  /// Where it is zero between two places at which its signs differ; by the secant rule, kept within.
  [[nodiscard]] double zero(double a, double b) const {
    double f_a = at(a), f_b = at(b), s = a;
    for (int k = 0; k < 60; ++k) {
      s = a + (b - a) * std::clamp(f_a / (f_a - f_b), 0.01, 0.99);
      const double f = at(s);
      if (f == 0.0 || b - a < 1e-14 * std::abs(course_.step)) break;
      const bool left = (f < 0.0) == (f_a < 0.0);
      (left ? a : b) = s;
      (left ? f_a : f_b) = f;
    }
    return s;
  }

 private:
  const Course& course_;
  const mode::RowVector& row_;
  const VectorXd& start_;
};

/// What the value of a guard at the leg's end says.
enum class AtEnd {
  counts,      ///< a value as any other
  is_watched,  ///< nothing: it is the speed of the impact, a test of its own
  is_zero      ///< the guard ends the leg there, and its slope there is a test of its own
};

AtEnd at_end(const mode::Frame& frame, const Itinerary& shape, std::size_t leg, const mode::Guard& guard) {
  AtEnd found = AtEnd::counts;
  for (const std::size_t ended : ended_at_end(shape, leg)) {
    const Leg& one = shape.legs[ended];
    if (one.ending == Ending::guard && guard.kind == one.kind && guard.contact == one.contact) return AtEnd::is_zero;
    if (is_speed_of(frame, one, guard)) found = AtEnd::is_watched;
  }
  return found;
}

/// The least value of a guard along a leg: at its ends, and at its minima.
///
/// A guard that ends the leg falls to its zero from the last maximum on. A minimum behind that maximum is this zero
/// passed, by rounding or because the slope there has changed its sign: the slope at the end says it, and its place and
/// value are those of the end. So a minimum of such a guard counts once a maximum has followed it.
Least least_value(const Course& course, const mode::Guard& guard, bool with_start, AtEnd at_end) {
  constexpr double clear =
      1e-9;  // of the guard's size in the leg: what is nearer to a zero at the start is its rounding
  const mode::RowVector slope_row = guard.row * course.mode.outline.system,
                        bend_row = slope_row * course.mode.outline.system;
  const std::size_t last = course.states.size() - 1;
  std::vector<double> values, slopes, bends;
  for (const VectorXd& X : course.states) {
    values.push_back(guard.row.dot(X));
    slopes.push_back(slope_row.dot(X));
    bends.push_back(bend_row.dot(X));
  }
  double size = 0.0, highest = 0.0;
  for (const double value : values) size = std::max(size, std::abs(value));
  Least least, behind_maximum;
  if (with_start) least.take(values.front(), 0.0);
  if (at_end == AtEnd::counts) least.take(values.back(), static_cast<double>(last) * course.step);
  const auto take_maximum = [&] { least.take(behind_maximum.value, behind_maximum.at); };
  for (std::size_t i = 0; i < last; ++i) {
    const AlongStep value(course, guard.row, i), slope(course, slope_row, i);
    const auto take_minimum = [&](double a, double b) {
      // The slope goes to zero from the end of the step that is the minimum's own.
      const double falls_to =
          a == 0.0 ? values[i] + slopes[i] * course.step : values[i + 1] - slopes[i + 1] * course.step;
      if (falls_to > least.value || (!with_start && !(highest > clear * size))) return;
      const double s = slope.zero(a, b);
      (at_end == AtEnd::is_zero ? behind_maximum : least).take(value.at(s), static_cast<double>(i) * course.step + s);
    };
    highest = std::max(highest, values[i]);
    if (slopes[i] < 0.0 && slopes[i + 1] >= 0.0) take_minimum(0.0, course.step);
    if (slopes[i] > 0.0 && slopes[i + 1] <= 0.0) take_maximum();
    // A minimum and a maximum in one step: the slope turns back between them.
    if (slopes[i] * slopes[i + 1] <= 0.0 || bends[i] * bends[i + 1] >= 0.0 || bends[i] * slopes[i] > 0.0) continue;
    const double from_left = slopes[i] + bends[i] * course.step,
                 from_right = slopes[i + 1] - bends[i + 1] * course.step;
    if (from_left * slopes[i] > 0.0 || from_right * slopes[i] > 0.0) continue;  // the slope keeps its sign
    const double turn = AlongStep(course, bend_row, i).zero(0.0, course.step);
    if (slope.at(turn) * slopes[i] >= 0.0) continue;
    highest = std::max(highest, value.at(turn));
    if (slopes[i] > 0.0) take_maximum();
    slopes[i] < 0.0 ? take_minimum(0.0, turn) : take_minimum(turn, course.step);
    if (slopes[i] < 0.0) take_maximum();
  }
  return least;
}

/// What a pair could hold is exceeded by so much at X, where it is at rest and does not stay so.
/// @param held  the states of the contacts if it stayed
double beyond_hold(const ModeSet& set, const mode::ContactStates& held, int own, const VectorXd& X) {
  const mode::Outline& outline = set.mode(held).outline;
  double least = std::numeric_limits<double>::infinity();
  for (const mode::Guard& guard : outline.guards) {
    const bool force =
        guard.kind == GuardKind::stick_above || guard.kind == GuardKind::stick_below || guard.kind == GuardKind::press;
    if (force && set.frame().parallel(displacement(set.frame(), guard.kind, guard.contact), own) != 0)
      least = std::min(least, guard.row.dot(X));
  }
  return -least;
}

/// Static friction is exceeded by so much where a contact slips on behind the end of a leg, and is at rest there.
double beyond_stick(const ModeSet& set, const Orbit& orbit, std::size_t leg, int contact, const VectorXd& X_end) {
  mode::ContactStates stuck = orbit.shape.legs[(leg + 1) % orbit.legs()].states;
  stuck.frictions[contact] = mode::FrictionState::stick;
  return beyond_hold(set, stuck, set.frame().frictions[contact].own, X_end);
}

/// A stop that a signal's point lets go would have to pull so hard for its pair to stay. The pair's friction would then
/// stick as before.
double beyond_press(const ModeSet& set, const Orbit& orbit, std::size_t leg, int stop, const VectorXd& X_behind) {
  const mode::Frame& frame = set.frame();
  const mode::ContactStates& before = orbit.shape.legs[leg].states;
  mode::ContactStates held = orbit.shape.legs[(leg + 1) % orbit.legs()].states;
  held.stops[stop] = mode::StopState::closed;
  for (std::size_t i = 0; i < held.frictions.size(); ++i)
    if (frame.parallel(frame.stops[stop].own, frame.frictions[i].own) != 0) held.frictions[i] = before.frictions[i];
  return beyond_hold(set, held, frame.stops[stop].own, X_behind);
}

bool passes_without_stick(const Orbit& orbit, std::size_t leg) {
  const Leg& here = orbit.shape.legs[leg];
  if (here.ending != Ending::guard || here.kind != GuardKind::slip) return false;
  return orbit.shape.legs[(leg + 1) % orbit.legs()].states.frictions[here.contact] != mode::FrictionState::stick;
}

/// Does a blow at the instant at which a leg starts move a contact's pair? Then it goes at once, whatever holds it.
bool is_blown(const ModeSet& set, const Itinerary& shape, std::size_t leg, int own) {
  const std::vector<std::size_t> ends = ended_at_end(shape, ended_at_start(shape, leg).back());
  return ranges::any_of(ends, [&](std::size_t end) {
    const std::vector<Pulse> all = pulses(set, shape.legs[end]);
    return ranges::any_of(all, [&](const Pulse& pulse) {
      return !shape.legs[end].strikes.empty() ||
             set.frame().free(own, set.frame().signal(static_cast<std::size_t>(pulse.signal))) != 0.0;
    });
  });
}

/// The contacts that a signal's point lets go, since the force jumps past their limit, and by how much.
std::vector<TestValue> let_go_at_knot(const ModeSet& set, const Orbit& orbit, std::size_t leg) {
  std::vector<TestValue> all;
  if (orbit.shape.legs[leg].ending != Ending::knot) return all;
  const std::size_t next = (leg + 1) % orbit.legs();
  const mode::ContactStates &before = orbit.shape.legs[leg].states, &behind = orbit.shape.legs[next].states;
  const VectorXd X = leg_start(set, orbit.shape.legs[next], orbit.x[next], orbit.t[next]).value();
  const auto add = [&](GuardKind kind, std::size_t contact, double value) {
    all.push_back({Test::no_stick, leg, kind, static_cast<int>(contact), value, orbit.duration(leg)});
  };
  const auto blown = [&](const mode::ContactRow& contact) { return is_blown(set, orbit.shape, next, contact.own); };
  for (std::size_t i = 0; i < before.frictions.size(); ++i)
    if (before.frictions[i] == mode::FrictionState::stick && behind.frictions[i] != before.frictions[i] &&
        !blown(set.frame().frictions[i]))
      add(GuardKind::stick_above, i, beyond_stick(set, orbit, leg, static_cast<int>(i), X));
  for (std::size_t i = 0; i < before.stops.size(); ++i)
    if (before.stops[i] == mode::StopState::closed && behind.stops[i] != before.stops[i] &&
        !blown(set.frame().stops[i]))
      add(GuardKind::press, i, beyond_press(set, orbit, leg, static_cast<int>(i), X));
  return all;
}

}  // namespace

std::vector<TestValue> test_values(const ModeSet& set, const Orbit& orbit) {
  std::vector<TestValue> all;
  for (std::size_t i = 0; i < orbit.legs(); ++i) {
    const Leg& leg = orbit.shape.legs[i];
    const Course course(set, leg, orbit.x[i], orbit.t[i], orbit.duration(i));
    const auto& guards = course.mode.outline.guards;
    for (const mode::Guard& guard : guards) {
      Least least;
      if (!leg.tied)
        least = least_value(course, guard, !zero_by_events(set.frame(), orbit.shape, i, guard),
                            at_end(set.frame(), orbit.shape, i, guard));
      all.push_back({Test::guard, i, guard.kind, guard.contact, least.value, least.at / set.period()});
    }
    bool starts_at_end = false;
    if (leg.ending == Ending::guard) {
      const mode::Guard& end = guards[course.mode.guard(leg.kind, leg.contact)];
      starts_at_end = !leg.tied && zero_by_events(set.frame(), orbit.shape, i, end);
      all.push_back({Test::speed, i, leg.kind, leg.contact,
                     -end.row.dot(course.mode.outline.system * course.states.back()), orbit.duration(i),
                     starts_at_end});
    }
    if (leg.ending != Ending::cut)
      all.push_back({Test::duration, i, leg.kind, leg.contact,
                     leg.tied ? std::numeric_limits<double>::infinity() : orbit.duration(i), orbit.duration(i),
                     starts_at_end});
    if (passes_without_stick(orbit, i))
      all.push_back({Test::no_stick, i, leg.kind, leg.contact,
                     beyond_stick(set, orbit, i, leg.contact, course.states.back()), orbit.duration(i)});
    ranges::copy(let_go_at_knot(set, orbit, i), std::back_inserter(all));
  }
  return all;
}

std::vector<Margin> margins(const Problem& problem, const Orbit& orbit) {
  const ModeSet set(problem.family(), orbit.values);
  std::vector<Margin> least;
  for (const TestValue& test : test_values(set, orbit)) {
    const bool reversal = test.test == Test::no_stick;
    if ((test.test != Test::guard && !reversal) || !std::isfinite(test.value)) continue;
    const auto same = ranges::find_if(least, [&](const Margin& m) {
      return m.kind == test.kind && m.contact == test.contact && m.reversal == reversal;
    });
    if (same == least.end())
      least.push_back({test.kind, test.contact, test.value, reversal});
    else
      same->value = std::min(same->value, test.value);
  }
  return least;
}

}  // namespace slapstick::orbit
