#pragma once
/// A quantity in one mode: a polynomial of degree two in the extended state X (mode/frame.hpp).
///
///     q = linear . X + sum_k (left_k . X) (right_k . X)
///
/// Where a closed stop and sticking friction hold one pair, only the sum f0 of their forces is determined. The split is
/// the one with the least press: friction bears f0 up to its static limit, the stop what is beyond it. So a force has a
/// kink where f0 passes the limit, which is no event: `kinks` are the rows whose zeros those are, and `sides` says on
/// which side of its kinks each pair is.
#include <utility>
#include <vector>

#include "mode/held.hpp"
#include "mode/outline.hpp"
#include "slapstick/quantity/quantity.hpp"

namespace slapstick::quantity {

using mode::Matrix;
using mode::RowVector;
using mode::Vector;

struct Formula {
  RowVector linear;
  std::vector<std::pair<RowVector, RowVector>> products = {};
};

/// What the quantities of a mode are made of. Refers to its arguments.
class Formulas {
 public:
  Formulas(const Model& model, const mode::Frame& frame, const mode::Outline& outline);

  /// The rows whose zeros are kinks; `sides` from their values at an X (Kink order).
  [[nodiscard]] const std::vector<RowVector>& kinks() const { return kinks_; }
  /// @param above  of each kink, whether its row is positive
  [[nodiscard]] Formula of(const Quantity& quantity, const std::vector<bool>& above) const;

  /// Row over X of a coordinate's displacement and velocity, of a contact's velocity.
  [[nodiscard]] RowVector displacement(int coordinate) const;
  [[nodiscard]] RowVector velocity(int coordinate) const;
  [[nodiscard]] RowVector relative(int contact) const;

 private:
  struct Kink {
    std::size_t pair;
    double side;  ///< f0 beyond the limit on this side
  };

  [[nodiscard]] RowVector none() const { return RowVector::Zero(frame_.size()); }
  [[nodiscard]] RowVector one() const { return RowVector::Unit(frame_.size(), frame_.one()); }
  [[nodiscard]] Formula single(const Quantity& quantity, int index, const std::vector<bool>& above) const;
  [[nodiscard]] RowVector acceleration(int coordinate) const;
  [[nodiscard]] RowVector gap(int contact) const;
  [[nodiscard]] RowVector force(int contact, const std::vector<bool>& above) const;
  [[nodiscard]] RowVector held_stop(int stop, const std::vector<bool>& above) const;
  [[nodiscard]] RowVector held_friction(int friction, const std::vector<bool>& above) const;
  [[nodiscard]] double beyond(std::size_t pair, const std::vector<bool>& above) const;
  [[nodiscard]] double sense(const mode::HeldPair& pair, const mode::ContactRow& contact) const;
  [[nodiscard]] RowVector difference(int a, int b, bool velocities) const;
  [[nodiscard]] Formula power(int contact, const std::vector<bool>& above) const;
  [[nodiscard]] Formula damping() const;
  [[nodiscard]] Formula input(const std::vector<bool>& above) const;
  [[nodiscard]] Formula kinetic() const;
  [[nodiscard]] Formula potential() const;
  void add_bend(int characteristic, Formula& energy) const;

  [[nodiscard]] int stops() const { return static_cast<int>(model_.stops.size()); }
  [[nodiscard]] int frictions() const { return static_cast<int>(model_.frictions.size()); }
  [[nodiscard]] int compliants() const { return static_cast<int>(model_.compliant_stops.size()); }

  const Model& model_;
  const mode::Frame& frame_;
  const mode::Outline& outline_;
  std::vector<mode::HeldPair> held_;
  std::vector<Kink> kink_of_;
  std::vector<RowVector> kinks_;
};

}  // namespace slapstick::quantity
