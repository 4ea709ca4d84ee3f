#pragma once
/// What `map` is asked for: the two parameters, the level, the starts, the quantities.
#include <memory>
#include <string>
#include <vector>

#include "analysis_options.hpp"
#include "model_options.hpp"
#include "parameter_ranges.hpp"
#include "slapstick/chart/chart.hpp"
#include "span_options.hpp"

namespace slapstick::app {

struct MapOptions {
  ModelOptions model;
  AnalysisOptions analysis;
  std::string x, y, start = "reset", direction = "up", of, shard;
  long long measured_periods = 100, seed = 1, threads = 0, refine = 0;

  void declare(Arguments& arguments);
};

/// The wish with its model: what every part of `map` works on.
struct MapWish {
  ChosenModel chosen;
  Sweep x, y;
  std::vector<Wanted> of;
  std::string state;               ///< --state
  std::vector<std::string> stops;  ///< --stop
  sweep::MapProblem problem;       ///< without threads, known, finished, progress, cancel; refers to this wish

  /// As the library has it; refers to this wish.
  [[nodiscard]] chart::Chart chart() const {
    return {chosen.definition, chosen.overrides, x.name, y.name, state, stops, problem};
  }
};

/// Reads and checks what can be known to be wrong before hours of work.
/// @throws InputError naming the argument
[[nodiscard]] std::unique_ptr<MapWish> map_wish(const MapOptions& options);
/// The same of a model that was read before; MODEL is not looked at.
[[nodiscard]] std::unique_ptr<MapWish> map_wish(const MapOptions& options, ChosenModel chosen);

}  // namespace slapstick::app
