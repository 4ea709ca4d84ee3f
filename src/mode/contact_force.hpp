#pragma once
/// Contact forces that are linear in the state, as rows over X: that of a compliant stop in its state, and the normal
/// force that limits a friction contact.
#include "mode/frame.hpp"
#include "slapstick/mode/contact_states.hpp"

namespace slapstick::mode {

struct FrameDerivative;

/// Force of a compliant stop on b: stiffness delta + damping delta', or 2 stiffness delta where its damping force is
/// bounded; zero where it does not act. Linear in the model's numbers.
[[nodiscard]] RowVector compliant_row(const Model& model, const Frame& frame, int i, CompliantState state);

/// N of friction contact i, or 1 if it has fixed limits. Where only compliant stops could press it and none does, the
/// row is zero.
[[nodiscard]] RowVector load_row(const Model& model, const Frame& frame, const ContactStates& states, int i);

/// Its derivative, `rate` the derivative of the model.
[[nodiscard]] RowVector load_rate(const Model& model, const Model& rate, const Frame& frame,
                                  const FrameDerivative& change, const ContactStates& states, int i);

}  // namespace slapstick::mode
