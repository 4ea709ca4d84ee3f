#pragma once
/// What a tile of pixels gives: the one place where pixels are analysed. No threads here.
#include "slapstick/sweep/map.hpp"
#include "sweep/executor.hpp"

namespace slapstick::sweep {

class KnownCycles;

/// A pixel that is to be analysed.
struct PixelTask {
  std::int32_t number = 0;
  Direction direction = Direction::up;
  State start;  ///< handed on by its neighbour; empty: the problem's own
};

[[nodiscard]] Model model_at(const MapProblem& problem, const PixelTask& task);
/// Where a pixel begins: at what was handed on, if that is admissible there.
[[nodiscard]] State start_of(const MapProblem& problem, const PixelTask& task, const Model& model);

/// Analyses the pixels of a tile: those of `quick` in lanes (lane_pixels.hpp), others each by itself.
/// @param known  cycles of the problem's one model; null: none
/// @returns as many as there was time for before the problem was cancelled, in the order of the tasks
[[nodiscard]] std::vector<Pixel> analyse(const MapProblem& problem, std::span<const PixelTask> tasks,
                                         const KnownCycles* known);

}  // namespace slapstick::sweep
