#pragma once
/// What `basins` is asked for: the plane of starts and how each is analysed.
#include <string>

#include "analysis_options.hpp"
#include "model_options.hpp"
#include "slapstick/chart/start_plane.hpp"

namespace slapstick::app {

struct BasinOptions {
  ModelOptions model;
  AnalysisOptions analysis;
  std::string x, y;
  long long threads = 0;

  void declare(Arguments& arguments);
};

/// The wish with its model.
struct BasinWish {
  ChosenModel chosen;
  chart::StartPlane plane;  ///< without finished, progress, cancel of its problem
};

/// @throws InputError naming the argument
[[nodiscard]] BasinWish basin_wish(const BasinOptions& options);

}  // namespace slapstick::app
