#pragma once
/// Notices points of a section that still creep: a slow transient, whose line of points looks like an invariant curve.
///
/// Of every L-th point, L = 1 .. 8 (a cycle of L points creeps in L lines), each number is followed. A number creeps if
/// it moves one way all the time, by four quarters of the recording that shrink like a geometric sequence, slowly: the
/// last is between a hundredth and 0.999 of the first, and the way is more than 1e-6 of the largest of all numbers.
/// Steady motion (a drill that advances) and points that have arrived are no creep. A rotation so slow that the
/// recording covers an arc of its curve alone may be taken for one; its points, too, are not yet the whole set.
#include <array>
#include <optional>
#include <span>
#include <vector>

namespace slapstick {

class CreepWatch {
 public:
  /// @param points   how many will come: the quarters are counted by it; below 64 there is no verdict
  /// @param numbers  of each point
  CreepWatch(long long points, std::size_t numbers);

  /// O(numbers), no allocation.
  void add(std::span<const double> point);

  /// The first number that creeps, and what its steps shrink to within a quarter of the recording.
  struct Creep {
    std::size_t number = 0;
    double ratio = 0.0;
  };
  /// Once all points have come; before, and without creep: nothing.
  [[nodiscard]] std::optional<Creep> verdict() const;

 private:
  static constexpr long long most_lag = 8, least_points = 8 * most_lag;

  /// One number of every L-th point.
  struct Track {
    bool one_way = true;
    double last = 0.0, direction = 0.0;
    std::array<double, 5> marks{};  ///< at the ends of the quarters
  };
  void follow(Track& track, double value, long long j, long long quarter) const;
  [[nodiscard]] std::optional<double> shrinking(const Track& track) const;

  long long points_, seen_ = 0;
  double size_ = 0.0;  ///< the largest of all numbers
  std::size_t numbers_;
  std::vector<Track> tracks_;  ///< by lag, then number
};

}  // namespace slapstick
