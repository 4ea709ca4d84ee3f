/// Compares the points of a motion on a section with one another.
#include "section/point_record.hpp"

#include <algorithm>
#include <cmath>

#include "section/return_map.hpp"

namespace slapstick::section {

using Eigen::VectorXd;

void PointRecord::add(const Eigen::Ref<const VectorXd>& x, const PeriodEvents& events, double omega) {
  numbers_.insert(numbers_.end(), x.begin(), x.end());
  events_.push_back(events);
  note_size(x, omega);
}

void PointRecord::note_size(const Eigen::Ref<const VectorXd>& x, double omega) {
  const auto n = scale_.size() / 2;
  const double position = x.head(n).cwiseAbs().maxCoeff(), speed = x.tail(n).cwiseAbs().maxCoeff();
  scale_.head(n) = scale_.head(n).cwiseMax(position);
  scale_.tail(n) = scale_.tail(n).cwiseMax(speed);
  // A velocity (or a displacement) that happens to vanish at phase 0 says nothing about the size of the motion.
  const double least = 1e-3;
  scale_.head(n) = scale_.head(n).cwiseMax(least * scale_.tail(n) / omega);
  scale_.tail(n) = scale_.tail(n).cwiseMax(least * scale_.head(n) * omega);
}

void PointRecord::clear() {
  numbers_.clear();
  events_.clear();
}

void PointRecord::keep_last(long points) {
  const long surplus = size() - points;
  if (surplus <= 0) return;
  numbers_.erase(numbers_.begin(), numbers_.begin() + surplus * scale_.size());
  events_.erase(events_.begin(), events_.begin() + surplus);
}

double PointRecord::returned(long n, long cycles_ago) const {
  return distance(back(cycles_ago * n), back((cycles_ago + 1) * n), scale_);
}

double PointRecord::widest_return(int n) const {
  double widest = 0.0;
  for (long j = 0; j < returns_compared && j + n < size(); ++j)
    widest = std::max(widest, distance(back(j), back(j + n), scale_));
  return widest;
}

bool PointRecord::same_events(long n) const {
  for (long i = 1; i <= n; ++i)
    if (!(events_[events_.size() - static_cast<std::size_t>(i)] ==
          events_[events_.size() - static_cast<std::size_t>(i + n)]))
      return false;
  return true;
}

VectorXd PointRecord::mean(int n, long count) const {
  VectorXd sum = VectorXd::Zero(scale_.size());
  for (long j = 0; j < count; ++j) sum += back(j * n);
  return sum / static_cast<double>(count);
}

double PointRecord::spread(int n, long count, const VectorXd& about) const {
  double widest = 0.0;
  for (long j = 0; j < count; ++j) widest = std::max(widest, distance(back(j * n), about, scale_));
  return widest;
}

/// By the last number alone, which shows it of almost all. The half more keeps what only rounding puts beyond the
/// tolerance.
bool PointRecord::far_apart(long n, double tolerance) const {
  const long last = scale_.size() - 1;
  return !(std::abs(back(0)[last] - back(n)[last]) <= tolerance * 1.5 * scale_[last]);
}

bool PointRecord::comes_nearer(int n, double d, int earlier) const {
  for (int k = 1; k <= earlier && (k + 2L) * n < size(); ++k)
    if (d < returned(n, k)) return true;
  return false;
}

std::vector<Candidate> PointRecord::candidates(const ReturnWish& wish, bool returns, bool nearer) const {
  std::vector<Candidate> all;
  double nearest = INFINITY;  // of the returns after fewer points
  for (int n = 1; n <= wish.most_n && 2 * n < size(); ++n) {
    if (!nearer && far_apart(n, wish.tolerance)) continue;
    const double d = returned(n);
    const bool here = returns && d <= wish.tolerance && same_events(n) && returned(n, 1) <= 2.0 * wish.tolerance;
    const bool approaches = nearer && d < wish.newton_start && comes_nearer(n, d, wish.earlier);
    const bool first = d < 0.5 * nearest;  // else it is a multiple of an n before
    nearest = std::min(nearest, d);
    if (here || (approaches && first)) all.push_back({n, here});
  }
  return all;
}

}  // namespace slapstick::section
