/// Finds the numbers that prove the limit of a complete chatter.
#include "certify/limit_proof.hpp"

#include <algorithm>
#include <cmath>

namespace slapstick::certify {
namespace {

using mode::Matrix;
using mode::Vector;

/// More than what double precision loses in sums of some hundred terms.
constexpr double rounding = 0x1p-42;

/// The mode of the same contacts, but for the friction of the stop's own pair, whose states `change` gives.
template <class Change>
ModeId with_pair(const flow::CompiledSystem& system, int stop, ModeId id, Change change) {
  mode::ContactStates states = system.states(id);
  for (int i = 0; i < static_cast<int>(states.frictions.size()); ++i)
    if (system.coupling(stop, i).same_pair) states.frictions[i] = change(states.frictions[i]);
  return system.mode_id(states);
}

/// A bound of |Z - S| that is twice what it need be, so that nothing leaves it: b dw, and the rest at the rate N Z.
Vector box(const Matrix& N, const Vector& b, const Vector& size, double D, double fastest) {
  Vector delta = 2.0 * (b.cwiseAbs() * fastest + D * N * size);
  return delta + 2.0 * D * N * delta;
}

/// The greatest |A - b (row of w)| of the modes, entry by entry.
Matrix quiet_part(const flow::CompiledSystem& system, const Vector& b, int u, std::initializer_list<ModeId> modes) {
  Matrix N = Matrix::Zero(b.size(), b.size());
  for (const ModeId id : modes) {
    const Matrix& A = system.mode(id).system();
    N = N.cwiseMax((A - b * A.row(u)).cwiseAbs());
  }
  return N;
}

/// The range of the acceleration towards the stop in the box.
void range(const mode::RowVector& row, double sign, const Vector& S, const Vector& delta, double& least, double& most) {
  const double middle = sign * row.dot(S);
  const double spread = (1.0 + 0x1p-10) * row.cwiseAbs().dot(delta) + rounding * row.cwiseAbs().dot(S.cwiseAbs());
  least = middle - spread;
  most = middle + spread;
}

double series(double v, double rise, double fall, double ratio) {
  return v * (1.0 / rise + 1.0 / std::sqrt(rise * fall)) / (1.0 - ratio);
}

}  // namespace

LimitProof prove_limit(const flow::CompiledSystem& system, int stop, ModeId rise, ModeId closed, const double* X, double v,
                       double duration) {
  using mode::FrictionState;
  const mode::Frame& frame = system.frame();
  const auto& [own, sign] = frame.stops[stop];
  const int u = frame.u(own);
  LimitProof proof;
  proof.rise = rise;
  proof.back = with_pair(system, stop, rise, [](FrictionState s) { return FrictionState(-static_cast<int>(s)); });
  proof.hold = with_pair(system, stop, rise, [](FrictionState) { return FrictionState::stick; });
  proof.longest = 1.0625 * duration;

  const Vector S = Eigen::Map<const Vector>(X, frame.size());
  Vector b = Vector::Zero(frame.size());
  for (int i = 0; i < frame.d; ++i) b[frame.u(i)] = frame.mass_inverse(i, own) / frame.mass_inverse(own, own);
  const Matrix N = quiet_part(system, b, u, {proof.rise, proof.back, closed});
  double ratio = 1.0;  // of the greatest speed to v
  for (int round = 0; round < 4; ++round) {
    const Vector delta = box(N, b, S.cwiseAbs(), proof.longest, ratio * v);
    range(system.mode(proof.rise).system().row(u), sign, S, delta, proof.rise_least, proof.rise_most);
    range(system.mode(proof.back).system().row(u), sign, S, delta, proof.fall_least, proof.fall_most);
    ratio = std::max(1.0, proof.fall_most / proof.rise_least) * (1.0 + 0x1p-20);
  }
  const double r = system.model().stops[stop].restitution;
  const double greatest = r * std::sqrt(proof.fall_most / proof.rise_least);
  const double smallest = r * std::sqrt(proof.fall_least / proof.rise_most);
  const double late = series(v, proof.rise_least, proof.fall_least, greatest) - duration;
  const double early = duration - series(v, proof.rise_most, proof.fall_most, smallest);
  proof.error = std::max(late, early) + rounding * duration;
  return proof;
}

}  // namespace slapstick::certify
