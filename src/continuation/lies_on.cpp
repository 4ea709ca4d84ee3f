/// Says whether an orbit lies on a branch.
#include "continuation/lies_on.hpp"

#include <algorithm>
#include <cmath>

#include "base/ranges.hpp"
#include "orbit/cyclic.hpp"
#include "orbit/record.hpp"
#include "orbit/same_motion.hpp"
#include "orbit/short_legs.hpp"

namespace slapstick::orbit {

using Eigen::VectorXd;

bool lies_between(const Extent& extent, const Orbit& a, const Orbit& b, const Orbit& orbit) {
  // Between two points the branch is nearly straight: in parts of an orbit's extent, and of what lies between. In a
  // cascade all orbits are much alike.
  constexpr double most_bend = 1e-3, least_bend = 1e-6, bend = 0.1;
  const double part = (orbit.parameter() - a.parameter()) / (b.parameter() - a.parameter());
  if (!(part >= 0.0 && part <= 1.0) || !(a.shape.legs == b.shape.legs)) return false;
  double way = 0.0;
  for (std::size_t i = 0; i < a.legs(); ++i) way = std::max(way, extent.distance(a.x[i], b.x[i]));
  const double same = std::clamp(bend * way, least_bend, most_bend);
  return from_some_event(orbit, a, [&](std::size_t shift) {
    for (std::size_t i = 0; i < a.legs(); ++i) {
      const std::size_t k = (i + shift) % a.legs();
      const VectorXd x = (1.0 - part) * a.x[k] + part * b.x[k];
      const double t = (1.0 - part) * a.t[k] + part * b.t[k];
      if (extent.distance(x, orbit.x[i]) >= same) return false;
      if (orbit.shape.n != 0 && std::abs(std::remainder(t - orbit.t[i], 1.0)) >= same) return false;
    }
    return true;
  });
}

std::optional<std::size_t> lies_on_first(const Problem& problem, std::size_t count, const Branch& branch,
                                         const Orbit& orbit) {
  const Extent extent(problem, orbit);
  for (std::size_t i = 0; i + 1 < count; ++i)
    if (lies_between(extent, branch.points[i].orbit, branch.points[i + 1].orbit, orbit)) return i;
  return std::nullopt;
}

namespace {

/// A branch's own orbits at a value of the parameter, by Newton's method from between two neighbouring points; from
/// both where the events change between them.
std::vector<Orbit> orbits_at(const Problem& problem, const Orbit& a, const Orbit& b, double value) {
  constexpr double beyond = 0.1;  // of a step: where two orbits meet, neither is quite between the other's points
  const double part = (value - a.parameter()) / (b.parameter() - a.parameter());
  if (!(part >= -beyond && part <= 1.0 + beyond)) return {};
  std::vector<Orbit> guesses = {a};
  const bool same_events = a.shape.legs == b.shape.legs;
  if (same_events) {
    Orbit& guess = guesses[0];
    for (std::size_t i = 0; i < a.legs(); ++i) guess.x[i] = (1.0 - part) * a.x[i] + part * b.x[i];
    for (std::size_t i = 0; i <= a.legs(); ++i) guess.t[i] = (1.0 - part) * a.t[i] + part * b.t[i];
  } else {
    guesses.push_back(b);
  }
  const bool inside = same_events && part >= 0.0 && part <= 1.0;
  std::vector<Orbit> found;
  for (Orbit& guess : guesses) {
    guess.parameter() = value;
    const std::optional<Orbit> orbit = refine(problem, guess);
    if (orbit && (inside || is_motion(problem, *orbit))) found.push_back(*orbit);
  }
  return found;
}

/// Two orbits of a cascade are often nearer to one another than `same`, and differ by an impact that hardly touches.
bool may_be_one(const Orbit& a, const Orbit& b) {
  return a.shape.n == 0 || chatters(a) + chatters(b) > 0 || a.legs() == b.legs();
}

using Distance = double (*)(const Problem& problem, const Orbit& a, const Orbit& b);

/// Is one of the branch's own orbits between two neighbouring points this one?
bool own_orbit(const Problem& problem, const Orbit& a, const Orbit& b, const Orbit& orbit, Distance distance) {
  constexpr double same_orbit_on_branch = 1e-6;
  return ranges::any_of(orbits_at(problem, a, b, orbit.parameter()), [&](const Orbit& other) {
    return may_be_one(orbit, other) && distance(problem, orbit, other) < same_orbit_on_branch;
  });
}

bool meets(const Problem& problem, const Branch& branch, const Orbit& orbit, Distance distance) {
  const Extent extent(problem, orbit);
  for (std::size_t i = 0; i + 1 < branch.points.size(); ++i) {
    const Orbit &a = branch.points[i].orbit, &b = branch.points[i + 1].orbit;
    if (a.shape.n != orbit.shape.n) continue;
    if (orbit.shape.n == 0 && lies_between(extent, a, b, orbit)) return true;
    if (own_orbit(problem, a, b, orbit, distance)) return true;
  }
  return false;
}

}  // namespace

bool meets_between(const Problem& problem, const Orbit& a, const Orbit& b, const Orbit& orbit) {
  const double part = (orbit.parameter() - a.parameter()) / (b.parameter() - a.parameter());
  return part >= 0.0 && part <= 1.0 && a.shape.n == orbit.shape.n && own_orbit(problem, a, b, orbit, apart);
}

bool lies_on(const Problem& problem, const Branch& branch, const Orbit& orbit) {
  return meets(problem, branch, orbit, apart);
}

bool image_lies_on(const Problem& problem, const Branch& branch, const Orbit& orbit) {
  return meets(problem, branch, orbit, apart_from_image);
}

}  // namespace slapstick::orbit
