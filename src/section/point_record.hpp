#pragma once
/// The points of a motion on a section, one after the other, and what they say about returns: after how many points the
/// motion comes back, and how near. Numbers only: who ran the motion, an engine or a lane, makes no difference.
/// Cost: a return is compared in some nanoseconds.
#include <vector>

#include <Eigen/Core>

namespace slapstick::section {

/// Events within one period, of all contacts; engagements of compliant stops are impacts
/// (section/stop_choice.hpp).
struct PeriodEvents {
  int impacts = 0, sticks = 0, chatters = 0;
  friend bool operator==(const PeriodEvents&, const PeriodEvents&) = default;
};

/// What counts as a return.
struct ReturnWish {
  int most_n = 64;             ///< longest cycle sought, points
  double tolerance = 1e-10;    ///< return distance, relative to the size of the motion
  double newton_start = 1e-3;  ///< return distance below which a cycle is looked for nearby
  int earlier = 1;             ///< a motion comes nearer if one of this many returns before was wider; it may oscillate
};

/// A number of points after which a cycle may be.
struct Candidate {
  int n = 0;
  bool returns = false;  ///< within the tolerance; else the motion comes nearer
};

class PointRecord {
 public:
  using Point = Eigen::Map<const Eigen::VectorXd>;

  /// @param size  numbers of a point: displacements, then as many velocities
  explicit PointRecord(Eigen::Index size) : scale_(Eigen::VectorXd::Constant(size, 1e-300)) {}

  /// @param omega  of a period: what makes a velocity of a displacement
  void add(const Eigen::Ref<const Eigen::VectorXd>& x, const PeriodEvents& events, double omega);
  /// Lets the size of the motion grow to that of a state which is no point.
  void note_size(const Eigen::Ref<const Eigen::VectorXd>& x, double omega);
  /// Forgets points, but not the size.
  void clear();
  void keep_last(long points);

  [[nodiscard]] long size() const { return static_cast<long>(events_.size()); }
  /// The point that was added n before the last.
  [[nodiscard]] Point back(long n) const { return {numbers_.data() + (size() - 1 - n) * scale_.size(), scale_.size()}; }
  /// Size of the motion: positions share one number, velocities another.
  [[nodiscard]] const Eigen::VectorXd& scale() const { return scale_; }
  /// Distance of two points n apart, `cycles_ago` times n ago; relative to the size.
  [[nodiscard]] double returned(long n, long cycles_ago = 0) const;
  /// The largest of the last 100 returns after n points.
  [[nodiscard]] double widest_return(int n) const;
  /// Whether the last n points had the events of the n before.
  [[nodiscard]] bool same_events(long n) const;
  /// Of the last points, n apart.
  [[nodiscard]] Eigen::VectorXd mean(int n, long count) const;
  /// How far the farthest of those is from a point.
  [[nodiscard]] double spread(int n, long count, const Eigen::VectorXd& about) const;

  /// After how many points there may be a cycle, the fewest first.
  /// @param returns  look for returns within the tolerance
  /// @param nearer   look for returns that come nearer too
  [[nodiscard]] std::vector<Candidate> candidates(const ReturnWish& wish, bool returns, bool nearer) const;

 private:
  [[nodiscard]] bool comes_nearer(int n, double d, int earlier) const;
  [[nodiscard]] bool far_apart(long n, double tolerance) const;

  Eigen::VectorXd scale_;
  std::vector<double> numbers_;
  std::vector<PeriodEvents> events_;
};

/// How many returns are compared with one another.
inline constexpr long returns_compared = 100;

}  // namespace slapstick::section
