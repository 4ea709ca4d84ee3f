#pragma once
/// Derivatives of a Frame and of an Outline with respect to a parameter of the model, by the product rule.
///
/// `rate` is the derivative of `model` (`ModelDefinition::rate`, or made by hand): the same parts in the same order,
/// each number replaced by its derivative. Derivatives are those of the stored numbers, in the coordinates (p, u) of
/// the frame: at a fixed user state a displacement moves by
/// -shift. Contacts, their order and W do not depend on a parameter.
#include <vector>

#include "mode/outline.hpp"

namespace slapstick::mode {

/// Derivatives of the members of Frame that have the same names, and of omega.
struct FrameDerivative {
  /// @throws InputError if contacts share a displacement only as long as the parameter does not move: equal clearances,
  /// or belt speeds, whose derivatives differ
  FrameDerivative(const Model& model, const Model& rate, const Frame& frame);

  Vector shift, drift;
  Matrix mass_inverse;                ///< -W M^{-1} M' M^{-1} W^T
  Matrix free;                        ///< d x m
  std::vector<Vector> push;           ///< of each characteristic
  std::vector<RowVector> inner_rate;  ///< InnerRow::rate of each
  double omega = 0.0;

 private:
  void add_inner(const InnerRow& row, const Matrix& K, const Matrix& C, const Matrix& K_rate, const Matrix& C_rate,
                 const Frame& frame);
};

/// The derivative of what Frame::kick adds to the velocities: (F area)' = F' area + F area'.
[[nodiscard]] Vector kick_rate(const Frame& frame, const FrameDerivative& rate, std::size_t signal, double area,
                               double area_rate);

/// Derivatives of Outline::system and of each guard's row, in the outline's order. What the outline holds exactly zero
/// stays so.
///
/// One derivative is one-sided: a compliant stop that cannot pull lets go where its force is zero, stiffness
/// delta + damping delta' = 0, which for damping = 0 is the guard delta. Its derivative there is that of the force over
/// the stiffness.
struct OutlineDerivative {
  OutlineDerivative(const Model& model, const Model& rate, const Frame& frame, const FrameDerivative& change,
                    const Outline& outline);

  Matrix system;
  std::vector<RowVector> guards;
  Matrix holding;  ///< of Outline::holding
};

/// The derivative of Frame::drive_row of a force that is constant or repeats with the forcing.
[[nodiscard]] RowVector drive_rate(const Model& model, const Model& rate, const Frame& frame, std::size_t force);

}  // namespace slapstick::mode
