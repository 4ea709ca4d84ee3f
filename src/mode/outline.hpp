#pragma once
/// The outline of a mode: the linear system that a combination of contact states selects, and the guards that end it.
#include <cmath>
#include <vector>

#include "mode/frame.hpp"
#include "slapstick/mode/contact_states.hpp"

namespace slapstick::mode {

struct Guard {
  GuardKind kind;
  /// index among the stops (gap, press), friction contacts (slip, stick) compliant stops or characteristics (others)
  int contact;
  RowVector row;  ///< h = row . X
  /// Index of the gap guard of the same pair whose rate of fall this slip guard is (h = -gap'), or -1. While such a gap
  /// is proven to fall, the slip guard is positive: y and w are one function and its derivative.
  int falls_with = -1;
  /// h = factor * X[single] if the row has one entry only, for p or u (then h has no rounding error but its own), else
  /// -1.
  int single = -1;
  double factor = 0.0;
  /// Then, if X[single] is a displacement without drift, the index of its velocity: h' = factor * X[rate]. Else -1.
  int rate = -1;

  /// The entries of the row that are not zero.
  struct Entry {
    int column;
    double value;
  };
  std::vector<Entry> entries = {};
  /// h at X, and the sum of the sizes of its terms (magnitude = |X|).
  [[nodiscard]] double at(const double* X) const {
    double sum = 0.0;
    for (const Entry& entry : entries) sum += entry.value * X[entry.column];
    return sum;
  }
  [[nodiscard]] double size(const double* magnitude) const {
    double sum = 0.0;
    for (const Entry& entry : entries) sum += std::abs(entry.value) * magnitude[entry.column];
    return sum;
  }
};

/// X' = system X in a combination of contact states, and what must stay positive while it lasts. Cost: O(m^3), some
/// microseconds.
///
/// Slip: kinetic friction -s f_k on a. Compliant stops: their force on b, the opposite on a. Characteristics: the force
/// of their piece. Held contacts: M u' = R(X) + G^T lambda with G u' = 0, so that
/// lambda = -(G M^{-1} G^T)^{-1} G M^{-1} R is a linear functional of X. Contacts on one pair are
/// held by one multiplier and share their limits; where other held contacts depend on each other lambda is the solution
/// of least norm.
struct Outline {
  Outline(const Model& model, const Frame& frame, ContactStates contact_states);

  ContactStates states;
  Matrix system;       ///< m x m
  Matrix system_size;  ///< the sums of the sizes of the terms that each of its entries was made of
  std::vector<Guard>
      guards;  ///< in the order in which events at one instant are handled: gaps, relative velocities, forces
  std::vector<bool> steady;  ///< u_i keeps its value to the last bit: its pair is held
  Matrix holding;            ///< f0 of each held pair (mode/held.hpp): a row over X each
  /// d x d: u_i + drift_i = follows_i . drift of what is steady, since a held contact's own u is zero. Zero rows of
  /// what is not.
  Matrix follows;

  /// The u of what is steady: zero of a held contact, and what a belt makes of another number of its pair. Linear in
  /// the drifts, so that it gives a derivative too.
  [[nodiscard]] Vector held_speeds(const Vector& drift) const;
};

}  // namespace slapstick::mode
