/// Campaign `branches`: every built-in model is followed in every parameter, from the orbit that it settles on and from
/// near both ends of the branch found; first with the models' own values, then with random ones. Steps fall elsewhere
/// each time; special points must not.
#include <algorithm>
#include <cmath>
#include <set>

#include "base/text.hpp"
#include "batches.hpp"
#include "random.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/continuation/sentences.hpp"
#include "slapstick/io/model_file.hpp"
#include "slapstick/orbit/search.hpp"

namespace campaign {
namespace {

using namespace slapstick;
using namespace slapstick::orbit;

constexpr long transient = 500;
constexpr int most_points = 4000;

struct Case {
  std::string model, parameter;
};

/// Parameters that a group moves are not followed by themselves.
std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const std::string& model : builtin_models()) {
    const ModelDefinition definition = load_model(model);
    std::set<std::string> grouped;
    for (const Group& group : definition.groups()) {
      cases.push_back({model, group.name});
      grouped.insert(group.members.begin(), group.members.end());
    }
    for (const Parameter& parameter : definition.parameters())
      if (!grouped.contains(parameter.name)) cases.push_back({model, parameter.name});
  }
  return cases;
}

/// The parameter that a name stands for: of a group its first member.
const Parameter& parameter_of(const ModelDefinition& definition, std::string name) {
  for (const Group& group : definition.groups())
    if (group.name == name) name = group.members.front();
  return *std::ranges::find(definition.parameters(), name, &Parameter::name);
}

/// A third to three times a value, of zero -1 to 1, as far as the parameter admits.
std::pair<double, double> range_about(const Parameter& parameter, double value) {
  double from = value == 0.0 ? -1.0 : std::min(value / 3.0, 3.0 * value);
  double to = value == 0.0 ? 1.0 : std::max(value / 3.0, 3.0 * value);
  const double edge = 1e-3 * (to - from);
  from = std::max(from, parameter.min + (parameter.min_open ? edge : 0.0));
  to = std::min(to, parameter.max - (parameter.max_open ? edge : 0.0));
  return {from, to};
}

/// Values of all parameters but the one that is followed: the model's own, or up to a factor 1.2 from them.
Overrides values_of(const ModelDefinition& definition, const std::string& followed, const Options& options, long number,
                    bool own) {
  Overrides values;
  if (own) return values;
  Random random(options.seed, static_cast<std::uint64_t>(number));
  for (const Parameter& parameter : definition.parameters()) {
    const double value = parameter.value * std::exp2(random.uniform(-0.263, 0.263));
    if (parameter.expression.empty() && parameter.admits(value)) values[parameter.name] = value;
  }
  for (const Group& group : definition.groups())
    if (group.name == followed)
      for (const std::string& member : group.members) values.erase(member);
  return values;
}

struct Tally {
  long cases = 0, unsettled = 0, families = 0, followed = 0, points = 0, special = 0, vague = 0, differ = 0, named = 0,
       failed = 0;
  std::vector<std::string> notes;
  void add(const Tally& o) {
    cases += o.cases, unsettled += o.unsettled, families += o.families, followed += o.followed, points += o.points;
    special += o.special, vague += o.vague, differ += o.differ, named += o.named, failed += o.failed;
    notes.insert(notes.end(), o.notes.begin(), o.notes.end());
  }
};

/// Does the branch go past a special point of another? Where several branches meet, each may go on along another one.
bool goes_past(const Problem& problem, const Branch& branch, const Branch& other, const SpecialPoint& point) {
  const auto on_it = [&](std::size_t i) {
    const Orbit& orbit = other.points[i].orbit;
    return lies_on(problem, branch, orbit) || image_lies_on(problem, branch, orbit);
  };
  return point.after + 1 < other.points.size() && on_it(point.after) && on_it(point.after + 1);
}

/// Onsets of chatter, and what gathers there: their places are limits.
bool is_limit(const SpecialPoint& point) { return point.type == SpecialType::CH || point.passage == Passage::cascade; }

/// Where a motion dies out several margins vanish together: which of them is named may depend on the start.
bool may_have_another_name(const SpecialPoint& point) {
  return is_limit(point) || point.occurrence == Occurrence::death || !changes_events(point.type);
}

std::string words(const SpecialPoint& point) {
  return std::string(name(point.occurrence)) + ", " + std::string(name(point.sliding)) + ", " +
         std::string(name(point.passage));
}

/// A change of events has one name from wherever it is come to: type, kind of sliding, what the branch does there.
bool named_alike(const SpecialPoint& a, const SpecialPoint& b) {
  if (may_have_another_name(a) || may_have_another_name(b)) return true;
  return a.type == b.type &&
         (!goes_on(a.passage) || !goes_on(b.passage) || (a.passage == b.passage && a.sliding == b.sliding));
}

/// Does a point lie in the rest of a cascade that a branch does not follow, between the last of its changes and the
/// onset of the chatter?
bool in_rest_of_cascade(const Branch& branch, const SpecialPoint& point) {
  const std::vector<SpecialPoint>& all = branch.special;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].type != SpecialType::CH) continue;
    const auto apart = [&](std::size_t j) { return std::abs(all[j].value - all[i].value); };
    const double left = std::min(i > 0 ? apart(i - 1) : INFINITY, i + 1 < all.size() ? apart(i + 1) : INFINITY);
    if (std::isfinite(left) && std::abs(point.value - all[i].value) < left) return true;
  }
  return false;
}

/// Special points of one branch that another, which goes past them, does not have, or by another name.
long missing(const Problem& problem, const Branch& whole, const Branch& again, double range, const std::string& where,
             Tally& tally) {
  long count = 0;
  for (const SpecialPoint& point : whole.special) {
    const auto same = [&](const SpecialPoint& other) {
      return (other.type == point.type || (changes_events(other.type) && changes_events(point.type))) &&
             std::abs(other.value - point.value) <= 1e-8 * range + point.error + other.error;
    };
    const auto found = std::ranges::find_if(again.special, same);
    if (found != again.special.end()) {
      const auto alike = [&](const SpecialPoint& other) { return same(other) && named_alike(point, other); };
      if (std::ranges::any_of(again.special, alike)) continue;
      ++tally.named;
      tally.notes.push_back(where + ": " + std::string(name(point.type)) + " " + shown(point.value) + " (" +
                            words(point) + ") is " + std::string(name(found->type)) + " (" + words(*found) + ")");
      continue;
    }
    if (in_rest_of_cascade(again, point) || !goes_past(problem, again, whole, point)) continue;
    ++count;
    tally.notes.push_back(where + ": " + std::string(name(point.type)) + " " + shown(point.value) + " is missing");
  }
  return count;
}

void follow_both_ways(const Problem& problem, const Solution& first, const ContinuationOptions& options,
                      const std::string& where, Tally& tally) {
  const double range = options.to - options.from;
  const Branch whole = follow(problem, first.orbit, options);
  ++tally.followed;
  tally.points += static_cast<long>(whole.points.size());
  tally.special += static_cast<long>(whole.special.size());
  constexpr double well_known = 1e-9;  // of the range
  tally.vague += std::ranges::count_if(
      whole.special, [&](const SpecialPoint& point) { return !is_limit(point) && point.error > well_known * range; });
  if (whole.failed()) {
    ++tally.failed;
    tally.notes.push_back(where + ": " + sentence(whole));
  }
  constexpr std::size_t inside = 3;  // an end may be a place where the motion dies out, which is no good start
  constexpr double vast = 1e3;       // against the first orbit: it grows without bound
  if (whole.points.size() <= 2 * inside) return;
  for (const Solution* end : {&whole.points[inside], &whole.points[whole.points.size() - 1 - inside]}) {
    if (!end->is_motion || !end->isolated() || stopped(options.stop)) continue;
    if (end->orbit.x[0].norm() > vast * first.orbit.x[0].norm()) continue;
    const Branch again = follow(problem, end->orbit, options);
    const std::string from = where + ", from " + shown(end->orbit.parameter());
    const bool fails_alone = again.failed() && !whole.failed();
    if (fails_alone) tally.notes.push_back(from + ": " + sentence(again));
    tally.failed += fails_alone ? 1 : 0;
    tally.differ +=
        missing(problem, whole, again, range, from, tally) + missing(problem, again, whole, range, where, tally);
  }
}

Tally examine(const Case& which, long number, bool own, const Options& options) {
  Tally tally;
  tally.cases = 1;
  const ModelDefinition definition = load_model(which.model);
  const Overrides values = values_of(definition, which.parameter, options, number, own);
  const double value = definition.values(values).at(parameter_of(definition, which.parameter).name);
  const auto [from, to] = range_about(parameter_of(definition, which.parameter), value);
  if (!(from <= value && value <= to && from < to)) return tally;
  std::string where = which.model + " --param " + which.parameter + " --range " + shown(from) + ":" + shown(to);
  for (const auto& [name, set] : values) where += " --set " + name + "=" + shown(set);
  Overrides present = values;
  present[which.parameter] = value;
  try {
    const auto problem = pose(definition.family({which.parameter}, values), {value});
    const System system(definition.build(present));
    const auto first =
        settle(*problem, system, definition.start(present), {.transient = transient, .stop = options.stop}).orbit;
    tally.unsettled += first ? 0 : 1;
    tally.families += first && !first->isolated() ? 1 : 0;
    if (!first || !first->isolated()) return tally;
    follow_both_ways(*problem, *first, {.from = from, .to = to, .most_points = most_points, .stop = options.stop},
                     where, tally);
  } catch (const InputError& error) {  // random values may contradict one another
    tally.notes.push_back(where + ": " + error.what());
  } catch (const NumericalError& error) {
    ++tally.failed;
    tally.notes.push_back(where + ": " + error.what());
  }
  return tally;
}

}  // namespace

Report run_branches(const Options& options) {
  const std::vector<Case> cases = all_cases();
  const long count = static_cast<long>(cases.size());
  Batches<Tally> batches(options, 1, "cases");
  const Tally all = batches.run([&](long k, long) {
    return examine(cases[static_cast<std::size_t>(k % count)], k, k < count && options.seed == 1, options);
  });
  Report report;
  report.done = batches.done();
  report.figures.set("cases", all.cases).set("do_not_settle", all.unsettled).set("one_of_a_family", all.families);
  report.figures.set("followed", all.followed).set("points", all.points).set("special_points", all.special);
  report.figures.set("known_worse_than_1e-9", all.vague).set("not_from_every_start", all.differ);
  report.figures.set("named_differently", all.named).set("failed", all.failed);
  Json notes = Json::list();
  for (const std::string& note : all.notes) notes.push(note);
  report.figures.set("notes", notes);
  report.passed = all.differ == 0 && all.named == 0 && all.failed == 0;
  return report;
}

}  // namespace campaign
