/// Gathers the pairs that contacts hold still, and what the forces there can bear.
#include "mode/held.hpp"

#include "base/dense.hpp"
#include "base/ranges.hpp"
#include "mode/contact_force.hpp"

namespace slapstick::mode {
namespace {

HeldPair& find_or_add(std::vector<HeldPair>& pairs, const Frame& frame, int displacement) {
  for (HeldPair& pair : pairs) {
    if (frame.parallel(pair.displacement, displacement) != 0) return pair;
  }
  return pairs.emplace_back(HeldPair{displacement, {}, {}});
}

/// +1 or -1: the sense of a contact along the displacement of its pair.
double sense(const Frame& frame, const HeldPair& pair, const ContactRow& contact) {
  return contact.sign * frame.parallel(pair.displacement, contact.own);
}

}  // namespace

std::vector<HeldPair> held_pairs(const Frame& frame, const ContactStates& states) {
  std::vector<HeldPair> pairs;
  for (std::size_t i = 0; i < states.stops.size(); ++i) {
    if (states.stops[i] == StopState::closed)
      find_or_add(pairs, frame, frame.stops[i].own).stops.push_back(static_cast<int>(i));
  }
  for (std::size_t i = 0; i < states.frictions.size(); ++i) {
    if (states.frictions[i] == FrictionState::stick)
      find_or_add(pairs, frame, frame.frictions[i].own).frictions.push_back(static_cast<int>(i));
  }
  return pairs;
}

Matrix selection(const std::vector<HeldPair>& pairs, int d) {
  const auto count = static_cast<Eigen::Index>(pairs.size());
  Matrix G = Matrix::Zero(count, d);
  for (Eigen::Index k = 0; k < count; ++k) G(k, pairs[k].displacement) = 1.0;
  return G;
}

Matrix least_norm_inverse(const Matrix& D) {
  const Vector scale = D.diagonal().cwiseSqrt().cwiseInverse();
  const auto scaled = dense::inverse_if_regular(scale.asDiagonal() * D * scale.asDiagonal());
  if (scaled) return scale.asDiagonal() * *scaled * scale.asDiagonal();
  return dense::LeastNorm(D).pseudo_inverse();
}

std::vector<ForceLimit> force_limits(const Frame& frame, const std::vector<HeldPair>& pairs) {
  std::vector<ForceLimit> limits;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const HeldPair& pair = pairs[k];
    bool above = true, below = true;  // does sense * f0 have a limit above, below?
    for (int i : pair.stops) (sense(frame, pair, frame.stops[i]) > 0.0 ? above : below) = false;
    const bool pressed = !pair.stops.empty();
    const int contact = pressed ? pair.stops.front() : pair.frictions.front();
    const double side = pressed ? 1.0 : sense(frame, pair, frame.frictions[contact]);
    if (above) limits.push_back({k, pressed ? GuardKind::press : GuardKind::stick_above, contact, -side});
    if (below) limits.push_back({k, pressed ? GuardKind::press : GuardKind::stick_below, contact, side});
  }
  return limits;
}

RowVector friction_limit(const HeldPair& pair, const Model& model, const Frame& frame, const ContactStates& states) {
  double fixed = 0.0;
  RowVector limit = RowVector::Zero(frame.size());
  for (int i : pair.frictions) {
    const FrictionContact& contact = model.frictions[i];
    if (contact.normal)
      limit += contact.static_friction * load_row(model, frame, states, i);
    else
      fixed += contact.static_friction;
  }
  limit[frame.one()] += fixed;
  return limit;
}

bool alone(const std::vector<HeldPair>& pairs, int friction) {
  return ranges::any_of(pairs, [&](const HeldPair& pair) {
    return pair.stops.empty() && pair.frictions.size() == 1 && pair.frictions.front() == friction;
  });
}

}  // namespace slapstick::mode
