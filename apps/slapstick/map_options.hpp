#pragma once
/// What `map` is asked for: the two parameters, the level, the starts, the quantities.
#include <memory>
#include <string>
#include <vector>

#include "model_options.hpp"
#include "parameter_ranges.hpp"
#include "slapstick/chart/chart.hpp"
#include "span_options.hpp"
#include "stop_options.hpp"

namespace slapstick::app {

struct MapOptions {
  ModelOptions model;
  StopOptions stops;
  std::string x, y, level = "quick", start = "reset", direction = "up", of, shard;
  long long periods = 300, transient = 500, most_periods = 20'000, most_n = 64, exponent_periods = 4000;
  long long measured_periods = 100, seed = 1, threads = 0, refine = 0;

  void declare(Arguments& arguments);
  /// Options that have no meaning together. @throws InputError naming one
  void check_words(const Arguments& arguments) const;
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
