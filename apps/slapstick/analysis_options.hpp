#pragma once
/// How each pixel of a chart or start of a basin is analysed: level, lengths, whose impacts count.
#include <string>

#include "slapstick/sweep/map.hpp"
#include "stop_options.hpp"
#include "work.hpp"

namespace slapstick::app {

struct AnalysisOptions {
  StopOptions stops;
  std::string level = "quick";
  long long periods = 300, transient = 500, most_periods = 20'000, most_n = 64, exponent_periods = 4000;

  void declare(Arguments& arguments);
  /// What one pixel is certain to run through.
  [[nodiscard]] Work work() const;
  /// @throws InputError for --stop
  void apply(const Model& model, sweep::MapProblem& problem) const;
};

}  // namespace slapstick::app
