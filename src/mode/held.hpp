#pragma once
/// Pairs that closed stops and sticking friction contacts hold still, each by one force f0 along its displacement, and
/// what they can bear.
#include <vector>

#include "mode/outline.hpp"

namespace slapstick::mode {

/// Contacts that hold one pair still. Along its displacement the force f0 pushes back; a contact has its share
/// sense * f0.
struct HeldPair {
  int displacement;
  std::vector<int> stops;      ///< closed stops
  std::vector<int> frictions;  ///< sticking friction contacts
};

[[nodiscard]] std::vector<HeldPair> held_pairs(const Frame& frame, const ContactStates& states);

/// G: the rows of the held displacements, u' of which is G u'.
[[nodiscard]] Matrix selection(const std::vector<HeldPair>& pairs, int d);

/// The inverse of a positive semidefinite D; where held contacts depend on each other, the pseudoinverse, for the
/// solution of least norm. Whether they do is decided for a unit diagonal: a heavy mass is not a dependent one.
[[nodiscard]] Matrix least_norm_inverse(const Matrix& D);

/// The guard friction limit + side * f0 > 0 of a held pair.
struct ForceLimit {
  std::size_t pair;
  GuardKind kind;
  int contact;
  double side;
};

/// What the pairs can bear: friction up to the sum of its limits either way, stops any push on their side. In the order
/// of the guards.
[[nodiscard]] std::vector<ForceLimit> force_limits(const Frame& frame, const std::vector<HeldPair>& pairs);

/// Row over X of the sum of the static limits of a pair's friction contacts.
[[nodiscard]] RowVector friction_limit(const HeldPair& pair, const Model& model, const Frame& frame,
                                       const ContactStates& states);

/// Does no other contact hold the pair of a friction contact that sticks?
[[nodiscard]] bool alone(const std::vector<HeldPair>& pairs, int friction);

}  // namespace slapstick::mode
