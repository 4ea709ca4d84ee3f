/// Watches the points of a section for a slow transient.
#include "section/creep_watch.hpp"

#include <algorithm>
#include <cmath>

namespace slapstick {

CreepWatch::CreepWatch(long long points, std::size_t numbers)
    : points_(points), numbers_(numbers), tracks_(static_cast<std::size_t>(most_lag) * numbers) {}

void CreepWatch::add(std::span<const double> point) {
  for (long long lag = 1; lag <= most_lag; ++lag) {
    if (seen_ % lag != 0) continue;
    const long long quarter = (points_ / lag - 1) / 4;
    for (std::size_t i = 0; i < numbers_; ++i)
      follow(tracks_[static_cast<std::size_t>(lag - 1) * numbers_ + i], point[i], seen_ / lag, quarter);
  }
  for (const double number : point) size_ = std::max(size_, std::abs(number));
  ++seen_;
}

/// j: which of the track's values this is.
void CreepWatch::follow(Track& track, double value, long long j, long long quarter) const {
  if (quarter == 0 || j > 4 * quarter || !track.one_way) return;
  const double step = value - track.last;
  if (j == 1) track.direction = step;
  if (j > 0) track.one_way = step * track.direction > 0.0;
  track.last = value;
  if (j % quarter == 0) track.marks[static_cast<std::size_t>(j / quarter)] = value;
}

/// The mean ratio of a quarter's way to that of the one before, if the four ways shrink slowly and geometrically.
std::optional<double> CreepWatch::shrinking(const Track& track) const {
  constexpr double visible = 1e-6, arrived = 0.01, steady = 0.999, geometric = 0.1;
  const auto& marks = track.marks;
  if (!track.one_way || !(std::abs(marks[4] - marks[0]) > visible * size_)) return {};
  std::array<double, 4> way{};
  for (std::size_t k = 0; k < 4; ++k) way[k] = std::abs(marks[k + 1] - marks[k]);
  const double overall = way[3] / way[0], mean = std::cbrt(overall);
  if (!(overall > arrived && overall < steady)) return {};
  for (std::size_t k = 1; k < 4; ++k) {
    if (std::abs(way[k] / way[k - 1] - mean) > geometric * std::min(mean, 1.0 - mean)) return {};
  }
  return mean;
}

std::optional<CreepWatch::Creep> CreepWatch::verdict() const {
  if (points_ < least_points || seen_ < points_) return {};
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    if (const auto ratio = shrinking(tracks_[k])) return Creep{k % numbers_, *ratio};
  }
  return {};
}

}  // namespace slapstick
