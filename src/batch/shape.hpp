#pragma once
/// How a mode's guards become slots, and what may follow each.
#include <array>

#include "batch/program.hpp"

namespace slapstick::batch {

/// A slot before it is scaled: -limit < row . X < limit, or 0 < row . X where there is no limit.
struct SlotRows {
  Slot slot;
  mode::RowVector row;
  double limit = 0.0;                           ///< of both sides, or 0: the lower side only
  std::array<int, sides> guard = {-1, -1, -1};  ///< of the outline, whose zero each side is
};

[[nodiscard]] std::vector<SlotRows> slots_of(const mode::Outline& outline, const mode::Frame& frame);

/// What may start at a state that no event has led to: no candidate where a stop is just in contact.
[[nodiscard]] Action start_action(const Model& model, const mode::Frame& frame, const Shape& shape, const double* p,
                                  const double* u);

void add_mode(const Model& model, const mode::Frame& frame, const mode::Outline& outline,
              const std::vector<SlotRows>& slots, int mode, Shape& shape);

/// Are these the slots that the shape has for the mode?
[[nodiscard]] bool has_shape(const Shape& shape, int mode, const std::vector<SlotRows>& slots);

}  // namespace slapstick::batch
