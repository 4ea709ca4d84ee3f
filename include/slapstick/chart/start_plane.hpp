#pragma once
/// Basins of attraction over two named initial values of a model, and the stores that keep them.
///
///     const ModelDefinition model = load_model("vibro-impact");
///     const Overrides values{{"omega", 2.82}};
///     chart::StartPlane plane = chart::starts_over(model, values, model.start(values), "x1", {-0.6, 0, 400},
///                                                  "v1", {-1, 1, 400});
///     const sweep::Basins basins = chart::stored_basins(plane, "basins.db", resume);
///
/// A store that one of the faces (program, C++, Python) has begun another one may resume. Source: docs/howto/basins.md.
#include "slapstick/chart/chart.hpp"
#include "slapstick/sweep/basins.hpp"

namespace slapstick::chart {

/// The starts of a plane with the names that its model knows them by.
struct StartPlane {
  ModelDefinition definition;
  Overrides values{};                ///< of the parameters
  std::string x{}, y{};              ///< the numbers of the state along the axes
  State start{};                     ///< the other numbers
  std::vector<std::string> stops{};  ///< that problem.classify.stops was made of
  sweep::MapProblem problem{};
};

/// @throws InputError for axes that are no numbers of the state, or one
[[nodiscard]] StartPlane starts_over(ModelDefinition definition, Overrides values, State start, std::string x,
                                     const sweep::GridAxis& x_axis, std::string y, const sweep::GridAxis& y_axis);

/// What a store says of a plane. Two runs with equal facts compute the same cells.
[[nodiscard]] store::StoreFacts facts_of(const StartPlane& plane);

/// Computes what the store does not have, each tile written as it is finished, and compares all that is there then.
[[nodiscard]] sweep::Basins stored_basins(const StartPlane& plane, store::Store store);
/// @param resume  as of Store::to_write
/// @throws what Store::to_write, Store::add and run_tiles throw
[[nodiscard]] sweep::Basins stored_basins(const StartPlane& plane, const std::string& path, bool resume);

}  // namespace slapstick::chart
