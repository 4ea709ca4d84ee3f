#include "orbit/dying.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace slapstick::orbit {
namespace {

/// The polynomial through values y at places x, at 0 (Neville).
double at_zero(const std::vector<double>& x, std::vector<double> y) {
  for (std::size_t order = 1; order < x.size(); ++order)
    for (std::size_t i = 0; i + order < x.size(); ++i)
      y[i] = (x[i + order] * y[i] - x[i] * y[i + 1]) / (x[i + order] - x[i]);
  return y[0];
}

}  // namespace

std::optional<Death> dies_out(const Branch& branch) {
  constexpr std::size_t most = 8, fewest = 5;
  constexpr double shrinks = 0.5, resolved = 1e-7, near = 2.0, well_known = 1e-3;
  const std::vector<Solution>& points = branch.points;
  const Orbit& last = points.back().orbit;
  std::vector<const Orbit*> used;  // the nearest first, each at some distance from the one before it
  Death death;
  double most_shrunk = shrinks;
  for (std::size_t leg = 0; leg < last.legs(); ++leg) {
    const double cycle = last.t.back() - last.t.front();
    if (!(last.duration(leg) > resolved * cycle)) continue;
    std::vector<const Orbit*> found = {&last};
    for (auto point = points.rbegin(); point != points.rend() && found.size() < most; ++point) {
      if (!(point->orbit.shape.legs == last.shape.legs)) break;
      if (point->orbit.duration(leg) > 1.2 * found.back()->duration(leg)) found.push_back(&point->orbit);
    }
    const double shrunk = last.duration(leg) / found.back()->duration(leg);
    if (found.size() < fewest || !(shrunk < most_shrunk)) continue;
    most_shrunk = shrunk;
    death.leg = leg;
    used = std::move(found);
  }
  if (used.empty()) return std::nullopt;
  std::vector<double> length, value;
  for (const Orbit* orbit : used) {
    length.push_back(orbit->duration(death.leg));
    value.push_back(orbit->values[0]);
  }
  death.value = at_zero(length, value);
  const double without_first = at_zero({length.begin() + 1, length.end()}, {value.begin() + 1, value.end()}),
               without_last = at_zero({length.begin(), length.end() - 1}, {value.begin(), value.end() - 1});
  death.error = std::max(std::abs(without_first - death.value), std::abs(without_last - death.value));
  const double seen = std::abs(value.front() - value.back());
  if (!(std::abs(death.value - value.front()) < near * seen) || !(death.error < well_known * seen)) return std::nullopt;
  return death;
}

}  // namespace slapstick::orbit
