#pragma once
/// Maps over two named parameters of a model, and the stores that keep them.
///
///     chart::Chart chart = chart::over(load_model("vibro-impact"), {}, "omega", {1, 6, 400}, "friction",
///                                      {0.05, 0.3, 300});
///     const sweep::Map map = chart::stored_map(chart, "chart.db", resume);
///
/// A store that one of the faces (program, C++, Python) has begun another one may resume: what a store says of itself
/// depends on the chart only. Source: docs/howto/charts.md.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "slapstick/io/model_file.hpp"
#include "slapstick/store/store.hpp"
#include "slapstick/sweep/map.hpp"

namespace slapstick::chart {

/// A map with the names that its model knows it by.
struct Chart {
  ModelDefinition definition;
  Overrides values{};                ///< of all other parameters
  std::string x{}, y{};              ///< the parameters of problem.x and problem.y
  std::string state{};               ///< "x1=..,v1=..": what start_at has in place of the model's own; or empty
  std::vector<std::string> stops{};  ///< that problem.classify.stops was made of
  sweep::MapProblem problem{};
};

/// A chart with the library's defaults; its starts are the model's own.
[[nodiscard]] Chart over(ModelDefinition definition, Overrides values, std::string x, const sweep::GridAxis& x_axis,
                         std::string y, const sweep::GridAxis& y_axis);

/// Numbers of a state by name as Chart::state has them.
[[nodiscard]] std::string state_words(const Overrides& named);

/// What is computed, one way of many, as the options of `slapstick map`: without model, values, threads and shard.
[[nodiscard]] std::vector<std::string> option_words(const Chart& chart);

/// What a store says of a chart. Two runs with equal facts compute the same cells.
[[nodiscard]] store::StoreFacts facts_of(const Chart& chart);
/// What a store says of any run. @param options  words that say what is computed, besides the model and its values
/// @param kernel  the arithmetic of the cells: "motion", or "lanes" where lanes take the model. Instruction sets have
/// no part in it: their bits are the same
[[nodiscard]] store::StoreFacts run_facts(const std::string& verb, const ModelDefinition& definition,
                                          const Overrides& values, const std::vector<std::string>& options, long cells,
                                          int shard = 0, int shards = 1, const std::string& kernel = "motion");

/// Computes what the store does not have, each tile written as it is finished, and gives all that is there then.
/// @param resume  as of Store::to_write
/// @throws what Store::to_write, Store::add and run_tiles throw
[[nodiscard]] sweep::Map stored_map(const Chart& chart, const std::string& path, bool resume);

/// All that a store has, as a map of that problem. @throws StorageError for cells that are none of the problem
[[nodiscard]] sweep::Map read_map(const store::Store& store, const sweep::MapProblem& problem);

/// use(pixel) for each that a store has, in no order. @throws StorageError for cells that are none of the problem
void for_each_pixel(const store::Store& store, const sweep::MapProblem& problem,
                    const std::function<void(const sweep::Pixel&)>& use);

/// Binds a problem to a store: what is there is not computed again, and what is computed is written. The problem must
/// not outlive this object.
class MapStore {
 public:
  MapStore(store::Store store, sweep::MapProblem& problem);
  ~MapStore();
  MapStore(MapStore&&) = delete;
  [[nodiscard]] const store::Store& kept() const;

 private:
  struct Bound;
  std::unique_ptr<Bound> bound_;
};

}  // namespace slapstick::chart
