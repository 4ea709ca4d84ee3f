#include "orbit/hidden.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "orbit/special.hpp"

namespace slapstick::orbit {
namespace {

int outside(const Watched& watched) {
  constexpr double clear = 1e-7;  // of the circle: what lies on it all along is nothing that passes
  return static_cast<int>(
      std::ranges::count_if(watched.multipliers, [](const auto& mu) { return std::abs(mu) > 1.0 + clear; }));
}

/// Is a leg's length less than this part of what it was?
bool shrinks(const Orbit& from, const Orbit& to, double part) {
  for (std::size_t i = 0; i < from.legs(); ++i)
    if (to.duration(i) < part * from.duration(i)) return true;
  return false;
}

}  // namespace

bool explained(const Watched& from, const Watched& to, const std::vector<SpecialPoint>& between) {
  int most = 0;
  for (const SpecialPoint& special : between) most += special.type == SpecialType::NS ? 2 : 1;
  return std::abs(outside(to) - outside(from)) <= most;
}

Pair pair_within(const Problem& problem, const Triple& triple, double range) {
  constexpr std::array<double Watched::*, 3> functions = {&Watched::flip, &Watched::torus, &Watched::turn};
  const auto& [first, second, third, back, ahead] = triple;
  Pair pair;
  for (const auto f : functions) {
    const double a = first.watched.*f, b = second.watched.*f, c = third.watched.*f;
    if (!(a * b > 0.0 && b * c > 0.0 && std::abs(b) <= std::abs(a) && std::abs(b) <= std::abs(c))) continue;
    const double left = (b - a) / back, right = (c - b) / ahead, bend = 2.0 * (right - left) / (back + ahead);
    const double slope = (left * ahead + right * back) / (back + ahead), vertex = -slope / bend;
    if (!(std::abs(vertex) > 0.0)) continue;
    pair.earlier = vertex < 0.0;
    const PathPoint& from = pair.earlier ? first : second;
    const PathPoint& to = pair.earlier ? second : third;
    const double whole = pair.earlier ? back : ahead, part = pair.earlier ? back + vertex : vertex;
    const std::optional<PathPoint> middle = step_to(problem, from, part, range);
    if (!middle || !(middle->watched.*f * b < 0.0)) continue;
    pair.points = smooth_special_points(problem, from, *middle, part, range);
    std::ranges::move(smooth_special_points(problem, *middle, to, whole - part, range),
                      std::back_inserter(pair.points));
    return pair;
  }
  return pair;
}

std::vector<SpecialPoint> beside_change(const Problem& problem, const PathPoint& from, double length, double range) {
  constexpr double nothing = 1e-5;
  for (const double part : {1.0 - 1e-6, 1.0 - 1e-4, 1.0 - 1e-2}) {
    const std::optional<PathPoint> last = step_to(problem, from, part * length, range);
    if (last && !shrinks(from.orbit, last->orbit, nothing))
      return smooth_special_points(problem, from, *last, part * length, range);
  }
  return {};
}

}  // namespace slapstick::orbit
