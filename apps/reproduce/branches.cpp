/// Follows the branches of n-1 orbits and compares them with the windows of the diagrams.
#include "reproduce/branches.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/ranges.hpp"
#include "base/text.hpp"
#include "reproduce/claims.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/continuation/sentences.hpp"
#include "slapstick/orbit/search.hpp"

namespace slapstick::paper {
namespace {

/// Where the n-1 orbit is found, and how far its branch is followed.
struct Reach {
  int n;
  double start, from, to;
};
constexpr Reach reaches[] = {
    {1, 2.2, 0.9, 5.0}, {2, 4.5, 2.8, 6.5}, {3, 6.3, 4.5, 8.0}, {4, 8.2, 6.0, 9.5}, {5, 9.2, 7.5, 10.0}};

/// The n-1 orbit at the start of a reach: what the motion from rest settles on, or else what a search finds.
orbit::Orbit first_orbit(const Study& study, const orbit::Problem& problem, const Reach& reach) {
  const System system = study.system({}, reach.start);
  const auto settled = orbit::orbit_near(problem, Motion(system, study.rest()), 1000, reach.n, study.options().cancel);
  if (settled && settled->impacts == 1) return settled->orbit;
  orbit::SearchOptions options;
  options.only_n = reach.n;
  options.stop = study.options().cancel;
  options.enough = [](const orbit::Solution& found) { return found.impacts == 1; };
  for (const orbit::Solution& found : orbit::search(problem, system, study.rest(), options).orbits)
    if (found.impacts == 1) return found.orbit;
  study.course().check();
  throw NumericalError("no " + std::to_string(reach.n) + "-1 orbit at omega = " + shown(reach.start));
}

orbit::Branch follow(const Study& study, const Reach& reach) {
  const auto problem = orbit::pose(study.definition().family({"omega"}), {reach.start});
  orbit::ContinuationOptions options{.from = reach.from, .to = reach.to};
  options.step = 0.002;
  options.longest_step = 0.01;
  options.stop = study.options().cancel;
  return orbit::follow(*problem, first_orbit(study, *problem, reach), options);
}

std::vector<double> impact_speeds(const orbit::Problem& problem, const orbit::Solution& point) {
  std::vector<double> speeds;
  for (const orbit::EventOfOrbit& event : orbit::events(problem, point.orbit))
    if (event.kind == EventKind::impact) speeds.push_back(event.w);
  ranges::sort(speeds, std::greater<>());  // which event a cycle begins with may change along a branch
  return speeds;
}

NBranch make_branch(const Study& study, const Reach& reach) {
  NBranch all{reach.n, follow(study, reach), {}};
  const auto problem = orbit::pose(study.definition().family({"omega"}), {reach.start});
  for (const orbit::Solution& point : all.branch.points) all.speeds.push_back(impact_speeds(*problem, point));
  return all;
}

/// The window's bounds: where the n-1 orbit begins, and the first point above it at which it ceases to be stable.
std::vector<orbit::SpecialPoint> bounds_of(const orbit::Branch& branch, const std::string& orbits) {
  std::vector<orbit::SpecialPoint> found;
  for (const orbit::SpecialPoint& point : branch.special) {
    const bool own = point.solution.label.starts_with(orbits);
    if (own && point.type == orbit::SpecialType::GR && found.empty()) found.push_back(point);
    const bool loses = point.type == orbit::SpecialType::PD || point.type == orbit::SpecialType::NS;
    if (own && loses && found.size() == 1) found.push_back(point);
  }
  return found;
}

BoundCurve make_bound(const Study& study, const NBranch& of, const orbit::SpecialPoint& point) {
  orbit::SpecialPoint at = point;
  at.solution.orbit.values = {point.value, 0.15};
  const auto problem = orbit::pose(study.definition().family({"omega", "friction"}), at.solution.orbit.values);
  orbit::CurveOptions options{.from = 0.5, .to = 7.0, .second_from = 0.0, .second_to = 0.5};
  options.longest_step = 0.02;
  options.stop = study.options().cancel;
  return {std::to_string(of.n) + "-1, " + std::string(name(point.type)), orbit::locus(*problem, at, options)};
}

std::string label_of(int n) { return std::to_string(n) + "-1-"; }

}  // namespace

namespace {

/// The branch that is born where the window of n-1 motion ends in a period doubling, and the one that is born where
/// that doubles, ..
std::vector<NBranch> make_doubled(const Study& study, const NBranch& of) {
  constexpr int generations = 3;
  constexpr double reach = 0.15;
  std::vector<NBranch> result;
  const auto bounds = bounds_of(of.branch, label_of(of.n));
  if (bounds.size() < 2 || bounds[1].type != orbit::SpecialType::PD) return result;
  orbit::SpecialPoint pd = bounds[1];
  for (int generation = 0; generation < generations; ++generation) {
    const auto problem = orbit::pose(study.definition().family({"omega"}), {pd.value});
    if (pd.born.empty()) break;
    orbit::ContinuationOptions options{.from = pd.value - reach, .to = pd.value + reach};
    options.step = 1e-3;
    options.stop = study.options().cancel;
    NBranch next{2 * pd.solution.orbit.shape.n, orbit::follow(*problem, pd.born.front(), options), {}};
    const auto again = ranges::find_if(next.branch.special, [&](const orbit::SpecialPoint& point) {
      return point.type == orbit::SpecialType::PD && point.occurrence != orbit::Occurrence::end_of_doubled;
    });
    result.push_back(next);
    if (again == next.branch.special.end()) break;
    pd = *again;
  }
  return result;
}

}  // namespace

Branches make_branches(const Study& study) {
  Branches result;
  result.all.resize(std::size(reaches));
  study.each(static_cast<int>(std::size(reaches)),
             [&](int i) { result.all[static_cast<std::size_t>(i)] = make_branch(study, reaches[i]); });
  study.course().next();
  std::vector<std::vector<NBranch>> doubled(3);
  study.each(3, [&](int i) {
    doubled[static_cast<std::size_t>(i)] = make_doubled(study, result.all[static_cast<std::size_t>(i)]);
  });
  for (auto& family_of_one : doubled)
    for (NBranch& branch : family_of_one) result.doubled.push_back(std::move(branch));
  std::vector<std::pair<const NBranch*, orbit::SpecialPoint>> bounds;
  for (std::size_t i = 0; i < 2; ++i)
    for (const orbit::SpecialPoint& point : bounds_of(result.all[i].branch, label_of(result.all[i].n)))
      bounds.emplace_back(&result.all[i], point);
  study.course().next();
  result.bounds.resize(bounds.size());
  study.each(static_cast<int>(bounds.size()), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    result.bounds[k] = make_bound(study, *bounds[k].first, bounds[k].second);
  });
  return result;
}

namespace {

void add_quantities(Claim& claim, const std::string& of, const orbit::Branch& branch, const System& system) {
  for (const orbit::SpecialPoint& point : branch.special) {
    std::string note = orbit::what_happens(point, system);
    if (point.type == orbit::SpecialType::NS) note += ", rotation " + fixed(point.rotation, 6);
    if (const std::string outcome = orbit::what_becomes(point); !outcome.empty()) note += "; " + outcome;
    claim.quantities.push_back({of + ": " + std::string(name(point.type)) + " of " + point.solution.label, "",
                                fixed(point.value, 9), point.value, note});
  }
}

/// The divided difference of second order of omega over friction at three neighbouring points of a curve.
double second_difference(const std::vector<orbit::CurvePoint>& points, std::size_t first) {
  const auto& a = points[first].values;
  const auto& b = points[first + 1].values;
  const auto& c = points[first + 2].values;
  return ((c[0] - b[0]) / (c[1] - b[1]) - (b[0] - a[0]) / (b[1] - a[1])) / (c[1] - a[1]);
}

/// Interpolates a bound between two points of its curve. The error is (f - a) (f - b) omega'' / 2, which the difference
/// with either neighbour estimates.
void add_bound(const BoundCurve& bound, double friction, Claim& claim) {
  constexpr double points_known_to = 5e-10;
  const auto& points = bound.curve.points;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double a = points[i].values[1], b = points[i + 1].values[1];
    if ((a - friction) * (b - friction) > 0.0 || a == b) continue;
    const double omega =
        points[i].values[0] + (friction - a) / (b - a) * (points[i + 1].values[0] - points[i].values[0]);
    double bend = 0.0;
    if (i > 0) bend = std::abs(second_difference(points, i - 1));
    if (i + 2 < points.size()) bend = std::max(bend, std::abs(second_difference(points, i)));
    const double within = points_known_to + std::abs((friction - a) * (friction - b)) * bend;
    claim.quantities.push_back({bound.label + " at friction " + shown(friction), "", place(omega, within), omega,
                                "between two points of the curve", within});
    return;
  }
}

}  // namespace

Claim claim_branches(const Study& study, const Branches& branches) {
  const System system(study.definition().build());
  Claim claim{
      "branches", "The paper shows attractors only, and names few bifurcations.", "", Agreement::not_claimed, "", {}};
  std::string windows;
  for (const NBranch& of : branches.all) {
    const std::string label = std::to_string(of.n) + "-1";
    const auto bounds = bounds_of(of.branch, label_of(of.n));
    if (bounds.size() == 2)
      windows += (windows.empty() ? "" : "; ") + label + " from " + std::string(name(bounds[0].type)) + " " +
                 fixed(bounds[0].value, 6) + " to " + std::string(name(bounds[1].type)) + " " +
                 fixed(bounds[1].value, 6);
    add_quantities(claim, "branch of " + label, of.branch, system);
  }
  for (const NBranch& of : branches.doubled)
    add_quantities(claim, "doubled branch of " + std::to_string(of.n) + " periods", of.branch, system);
  claim.computed = "Windows of stable n-1 motion: " + windows + ".";
  claim.explanation =
      "Branches of n-1 orbits, followed by continuation through stable and unstable orbits, and those born at the "
      "doublings that end the windows of n = 1, 2, 3. LP "
      "fold, PD period doubling, NS Neimark-Sacker, GR grazing: the next impact appears, SL a stick phase or a "
      "reversal appears. Every point was run by the simulator.";
  return claim;
}

Claim claim_bounds(const Study& study, const Branches& branches) {
  const System system(study.definition().build());
  Claim claim{"bounds", "More friction moves the bifurcation points at high frequencies to the left (C9).",
              "",       Agreement::not_claimed,
              "",       {}};
  for (const BoundCurve& bound : branches.bounds) {
    for (const double friction : friction_values) add_bound(bound, friction, claim);
    for (const orbit::CurveEvent& event : bound.curve.met)
      claim.quantities.push_back({bound.label + ", met", "",
                                  "(" + fixed(event.values[0], 4) + ", " + fixed(event.values[1], 4) + ")",
                                  event.values[0], orbit::sentence(bound.curve, event, system)});
  }
  claim.computed = "The bounds of the 1-1 and 2-1 windows as curves over friction; see the figure and the numbers.";
  claim.explanation = "Each curve is the locus of one bifurcation, continued in omega and friction (f_s = f_k).";
  return claim;
}

}  // namespace slapstick::paper
