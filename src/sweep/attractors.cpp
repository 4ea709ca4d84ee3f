/// Compares attractors by points of their cycles, or by where they rest.
#include "sweep/attractors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/ranges.hpp"
#include "flow/contact_state.hpp"
#include "section/settling.hpp"
#include "slapstick/flow/stage.hpp"
#include "sweep/diagram_point.hpp"

namespace slapstick::sweep {
namespace {

/// Of the range of a number over the cycle. Wider: two cycles beside a fold are one; narrower: rounding parts one.
constexpr double same_range = 1e-6;
/// Of the largest displacement, or velocity over omega, however far from zero: what Newton's method and rounding leave.
constexpr double newton_leaves = 1e-10;

Motion motion_from(const System& system, State state) {
  undo_rounding(system.model(), state);
  return Motion(system, state);
}

}  // namespace

bool Attractors::by_class(const Classification& found) {
  const bool held = found.attractor == Attractor::equilibrium && (found.sticking || found.family > 0);
  const bool single = found.attractor == Attractor::periodic || found.attractor == Attractor::equilibrium;
  const bool unknown = single && found.n > 0 && !(found.period > 0.0);
  return held || !single || unknown;
}

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
Eigen::VectorXd Attractors::on_section(const State& state, const Known& known) const {
  Motion motion = motion_from(translations_.system(), state);
  if (!driven_ && known.kind != Attractor::equilibrium)
    (void)motion.advance(motion.time().plus(2.0 * known.cycle));  // an event comes before
  return point(motion);
}

/// How far starts are from each other: displacements, and what a velocity moves about a place of rest.
double Attractors::reach_at_rest(const Known& known) const {
  double apart = 0.0, faster = 0.0;
  for (std::size_t i = 0; i + 1 < least_.size(); i += 2) {  // x1, v1, x2, ..
    apart = std::max(apart, most_[i] - least_[i]);
    faster = std::max(faster, most_[i + 1] - least_[i + 1]);
  }
  return known.rate > 0.0 ? std::max(apart, faster / known.rate) : apart;
}

bool Attractors::same(const Known& known, const Vector& here) const {
  const Eigen::Index compared = known.tolerance.size();
  Vector tolerance = known.tolerance;
  if (known.kind == Attractor::equilibrium) tolerance.array() += newton_leaves * reach_at_rest(known);
  const auto is_here = [&](const Vector& there) {
    return ((here - there).head(compared).cwiseAbs().array() <= tolerance.array()).all();
  };
  return ranges::any_of(known.points, is_here);
}

int Attractors::find(Attractor kind, std::string_view label, const State& state) const {
  for (std::size_t i = 0; i < all_.size(); ++i) {
    const Known& known = all_[i];
    if (known.kind != kind || known.label != label) continue;
    if (known.by_class || same(known, on_section(state, known))) return static_cast<int>(i);
  }
  return -1;
}

int Attractors::add(const Classification& found) {
  Known known{found.attractor, found.label, by_class(found)};
  for (const std::complex<double>& eigenvalue : found.eigenvalues)
    known.rate = std::max(known.rate, std::abs(eigenvalue));
  if (!known.by_class) follow(found, known);
  all_.push_back(std::move(known));
  return static_cast<int>(all_.size()) - 1;
}

/// The points of a cycle, and how far each of its numbers ranges; at rest its only point.
void Attractors::follow(const Classification& found, Known& known) const {
  const System& system = translations_.system();
  Motion motion = motion_from(system, found.state);
  const Vector first = point(motion);
  const Eigen::Index n = first.size() / 2;
  if (found.attractor == Attractor::equilibrium) {
    known.points = {first};
    known.tolerance = Vector::Constant(n, newton_leaves * first.head(n).cwiseAbs().maxCoeff());
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
  const double cycle = known.cycle = driven_ ? found.n : found.period / system.period();
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
  const Vector size = least.cwiseAbs().cwiseMax(most.cwiseAbs());
  known.tolerance = same_range * (most - least);
  const double omega = 2.0 * std::numbers::pi / (system.period() * (driven_ ? 1.0 : cycle));
  const double largest = std::max(size.head(n).maxCoeff(), size.tail(n).maxCoeff() / omega);
  known.tolerance.head(n).array() += newton_leaves * largest;
  known.tolerance.tail(n).array() += newton_leaves * largest * omega;
}

}  // namespace slapstick::sweep
