#pragma once
/// A path that was followed both ways from its first point.
#include <utility>
#include <vector>

namespace slapstick::orbit {

/// One path of the two, in the sense of the second. Either begins with the first point and ends as its `up` says.
/// @param met  the member that lists what lies after (`after`) points of the path
template <class Path, class Met>
Path joined(Path down, Path up, std::vector<Met> Path::*met) {
  Path all = up;
  all.points.assign(down.points.rbegin(), down.points.rend());
  (all.*met).clear();
  const std::size_t first = all.points.size() - 1;
  all.points.insert(all.points.end(), up.points.begin() + 1, up.points.end());
  for (auto event = (down.*met).rbegin(); event != (down.*met).rend(); ++event) {
    event->after = first > event->after ? first - event->after - 1 : 0;
    (all.*met).push_back(std::move(*event));
  }
  for (Met& event : up.*met) {
    event.after += first;
    (all.*met).push_back(std::move(event));
  }
  all.down = std::move(down.up);
  return all;
}

}  // namespace slapstick::orbit
