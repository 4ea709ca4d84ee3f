/// Compares attractors by points of their cycles, or by where they rest.
#include "sweep/attractors.hpp"

#include <algorithm>
#include <cmath>

#include "base/ranges.hpp"
#include "flow/contact_state.hpp"
#include "section/settling.hpp"
#include "slapstick/flow/stage.hpp"
#include "sweep/diagram_point.hpp"

namespace slapstick::sweep {
namespace {

/// Of the scale. Newton's method leaves 1e-10 of it. Wider: two cycles beside a fold are one; narrower: rounding makes
/// two of one.
constexpr double same = 1e-6;

double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b, Eigen::Index velocities, double displacement,
                double velocity) {
  const Eigen::VectorXd off = (a - b).cwiseAbs();
  const auto against = [](double difference, double scale) {
    return difference == 0.0 ? 0.0 : scale > 0.0 ? difference / scale : INFINITY;
  };
  return std::max(against(off.head(velocities).maxCoeff(), displacement),
                  against(off.tail(velocities).maxCoeff(), velocity));
}

Motion motion_from(const System& system, State state) {
  undo_rounding(system.model(), state);
  return Motion(system, state);
}

bool is_one_of_many(const Classification& found) {
  const bool held = found.attractor == Attractor::equilibrium && (found.sticking || found.family > 0);
  const bool cycle = found.attractor == Attractor::periodic || found.attractor == Attractor::equilibrium;
  return held || !cycle;
}

}  // namespace

Attractors::Attractors(const System& system) : translations_(system), driven_(section::driven(system)) {}

void Attractors::reach(const State& start) {
  if (least_.empty()) least_ = most_ = start;
  for (std::size_t i = 0; i < start.size(); ++i) {
    least_[i] = std::min(least_[i], start[i]);
    most_[i] = std::max(most_[i], start[i]);
  }
}

Eigen::VectorXd Attractors::point(const Motion& motion) const {
  Vector x = flow::contact_state(motion);
  (void)translations_.take_out(x);
  return x;
}

/// What is compared of a state: of a free cycle where its next event is, since it may stand anywhere.
Eigen::VectorXd Attractors::on_section(const State& state, Attractor kind) const {
  Motion motion = motion_from(translations_.system(), state);
  if (!driven_ && kind != Attractor::equilibrium) {
    constexpr double long_enough = 1e6;  // units of time: a cycle has an event before
    (void)motion.advance(motion.time().plus(long_enough));
  }
  return point(motion);
}

Attractors::Scale Attractors::scale_of(const Known& known) const {
  if (known.kind != Attractor::equilibrium) return known.scale;
  double apart = 0.0, faster = 0.0;
  for (std::size_t i = 0; i + 1 < least_.size(); i += 2) {  // x1, v1, x2, ..
    apart = std::max(apart, most_[i] - least_[i]);
    faster = std::max(faster, most_[i + 1] - least_[i + 1]);
  }
  if (known.rate > 0.0) {  // what a velocity of the starts moves, and what a displacement lets come
    apart = std::max(apart, faster / known.rate);
    faster = std::max(faster, apart * known.rate);
  }
  return {std::max(apart, known.scale.displacement), std::max(faster, known.scale.velocity)};
}

int Attractors::find(Attractor kind, std::string_view label, const State& state) const {
  Vector here;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    const Known& known = all_[i];
    if (known.kind != kind || known.label != label) continue;
    if (known.by_class) return static_cast<int>(i);
    if (here.size() == 0) here = on_section(state, kind);
    const Scale scale = scale_of(known);
    const auto is_here = [&](const Vector& there) {
      return distance(here, there, here.size() / 2, scale.displacement, scale.velocity) < same;
    };
    if (ranges::any_of(known.points, is_here)) return static_cast<int>(i);
  }
  return -1;
}

int Attractors::add(const Classification& found) {
  Known known{found.attractor, found.label, is_one_of_many(found)};
  for (const std::complex<double>& eigenvalue : found.eigenvalues)
    known.rate = std::max(known.rate, std::abs(eigenvalue));
  if (!known.by_class) follow(found, known);
  all_.push_back(std::move(known));
  return static_cast<int>(all_.size()) - 1;
}

/// The points of a cycle, and how far its displacements and velocities range; at rest its only point and its size.
void Attractors::follow(const Classification& found, Known& known) const {
  const System& system = translations_.system();
  Motion motion = motion_from(system, found.state);
  const Vector first = point(motion);
  const Eigen::Index n = first.size() / 2;
  if (found.attractor == Attractor::equilibrium) {
    known.points = {first};
    known.scale = {first.head(n).cwiseAbs().maxCoeff(), first.tail(n).cwiseAbs().maxCoeff()};
    return;
  }
  Vector least = first, most = first;
  const auto look = [&] {
    const Vector x = point(motion);
    least = least.cwiseMin(x);
    most = most.cwiseMax(x);
    return x;
  };
  constexpr int looks = 16;  // of each period, for the range alone
  const double cycle = driven_ ? found.n : found.period / system.period();
  const int steps = driven_ ? looks * found.n : looks;
  const auto instant = [&](int k) {
    return driven_ ? Instant{k / looks, static_cast<double>(k % looks) / looks} : Instant{}.plus(cycle * k / steps);
  };
  for (int k = 1; k <= steps; ++k) {
    const auto at_event = [&] {
      const Vector x = look();
      if (!driven_) known.points.push_back(x);
    };
    (void)run_to(motion, instant(k), nullptr, at_event);
    const Vector x = look();
    if (driven_ && k % looks == 0) known.points.push_back(x);
  }
  const Vector range = most - least;
  known.scale = {range.head(n).maxCoeff(), range.tail(n).maxCoeff()};
}

}  // namespace slapstick::sweep
