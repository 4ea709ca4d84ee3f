/// Random admissible states around what a first motion is like.
#include "orbit/starts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flow/compiled_system.hpp"
#include "flow/contact_state.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/stage.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// What the forcing, with no contact and no spring, would move each number of a contact state by: a (T / 2 pi)^2 and a
/// T / 2 pi.
VectorXd forced_sizes(const System& system, double unit) {
  const mode::Frame& frame = system.compiled().frame();
  const double time = unit * system.period() / (2.0 * std::numbers::pi);
  const Index constant_and_harmonics = frame.size() - 2 * frame.d;
  VectorXd sizes(2 * frame.n);
  for (Index i = 0; i < frame.n; ++i) {
    const double acceleration = frame.free.row(i).tail(constant_and_harmonics).norm();
    sizes[i] = acceleration * time * time;
    sizes[frame.n + i] = acceleration * time;
  }
  return sizes;
}

/// Numbers that are next to nothing against what they are compared with take the largest of the others, or that.
void fill(Eigen::Ref<VectorXd> ranges, const VectorXd& forced) {
  constexpr double negligible_range = 1e-9;
  const double most = ranges.maxCoeff(), of_force = forced.maxCoeff();
  const double size = std::max(most, of_force) > 0.0 ? std::max(most, of_force) : 1.0;
  for (Index i = 0; i < ranges.size(); ++i) {
    if (ranges[i] > negligible_range * size) continue;
    ranges[i] = forced[i] > negligible_range * size ? forced[i] : most > negligible_range * size ? most : size;
  }
}

}  // namespace

Starts::Starts(const flow::Translations& translations, Motion motion, const std::atomic<bool>* stop,
               std::optional<double> unit)
    : translations_(translations),
      low_(VectorXd::Constant(2 * translations.system().compiled().frame().n, INFINITY)),
      high_(-low_),
      sum_(VectorXd::Zero(low_.size())),
      unit_(unit.value_or(1.0)) {
  constexpr int periods = 20, looks = 16;
  see(motion);
  try {
    for (int k = 1; k <= periods * looks && !stopped(stop); ++k) {
      Instant next{motion.time().period + (k % looks == 0 ? 1 : 0), static_cast<double>(k % looks) / looks};
      if (unit) next = motion.time().plus(*unit / looks);
      run_to(motion, next, stop, [&] { see(motion); });
      see(motion);
    }
  } catch (const NumericalError&) {  // what was seen until then will do
  }
  set_sizes();
}

void Starts::see(const Motion& motion) {
  VectorXd x = flow::contact_state(motion);
  translations_.take_out(x);
  low_ = low_.cwiseMin(x);
  high_ = high_.cwiseMax(x);
  sum_ += x;
  ++seen_;
}

void Starts::set_sizes() {
  const Index n = translations_.system().compiled().frame().n;
  ranges_ = high_ - low_;
  const VectorXd forced = forced_sizes(translations_.system(), unit_);
  fill(ranges_.head(n), forced.head(n));
  fill(ranges_.tail(n), forced.tail(n));
  sizes_ = ranges_;
  sizes_.head(n).setConstant(ranges_.head(n).maxCoeff());
  sizes_.tail(n).setConstant(ranges_.tail(n).maxCoeff());
}

/// Of the stops; they are linear in the state.
VectorXd Starts::gaps(const VectorXd& x) const {
  const System& system = translations_.system();
  const mode::Frame& frame = system.compiled().frame();
  VectorXd X = VectorXd::Zero(frame.size());
  frame.enter(flow::user_state(system, x).data(), X.data());
  X[frame.one()] = 1.0;
  VectorXd all(static_cast<Index>(frame.stops.size()));
  for (std::size_t i = 0; i < frame.stops.size(); ++i)
    all[static_cast<Index>(i)] = frame.gap_row(frame.stops[i]).dot(X);
  return all;
}

/// The mean is admissible, since the admissible states are convex. From there a random direction is gone along by its
/// whole length, or, where that is behind a stop, by its opposite, or by any part of the way to the stops.
VectorXd Starts::draw(std::mt19937& random, double spread) const {
  std::normal_distribution<double> normal;
  const VectorXd mean = sum_ / static_cast<double>(seen_);
  VectorXd way(mean.size());
  for (Index i = 0; i < way.size(); ++i) way[i] = spread * ranges_[i] * normal(random);
  translations_.take_out(way);
  const VectorXd here = gaps(mean).cwiseMax(0.0), change = gaps(mean + way) - gaps(mean);
  double back = 1.0, ahead = 1.0;
  for (Index i = 0; i < here.size(); ++i) {
    if (change[i] < 0.0) ahead = std::min(ahead, here[i] / -change[i]);
    if (change[i] > 0.0) back = std::min(back, here[i] / change[i]);
  }
  if (ahead >= 1.0) return mean + way;
  if (back >= 1.0) return mean - way;
  return mean + std::uniform_real_distribution<double>(-back, ahead)(random) * way;
}

}  // namespace slapstick::orbit
