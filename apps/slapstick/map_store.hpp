#pragma once
/// A map in a store: what is computed is written as it comes, and what is there is not computed again.
#include <mutex>
#include <vector>

#include "map_options.hpp"
#include "store.hpp"

namespace slapstick::app {

/// What a store says of the map that it holds. Two runs with equal facts compute the same cells.
[[nodiscard]] StoreFacts map_facts_of(const MapOptions& options, const MapWish& wish);

/// What any run says of itself. @param options  words that say what is computed, besides the model and its values
/// @param kernel  the arithmetic of the cells: "motion", or "lanes" where lanes take the model. Instruction sets have
/// no part in it: their bits are the same
[[nodiscard]] StoreFacts run_facts(const std::string& verb, const ChosenModel& chosen, const std::vector<std::string>& options,
                                   long cells, int shard = 0, int shards = 1, const std::string& kernel = "motion");

/// The map that a store is of: its model, options and problem. @throws InputError if it is of another verb.
/// The version is not looked at
[[nodiscard]] std::unique_ptr<MapWish> wish_of(const Store& store);

[[nodiscard]] StoredCell cell_of(const sweep::Pixel& pixel, const sweep::MapProblem& problem);
/// @throws StorageError if its numbers are none of such a pixel
[[nodiscard]] sweep::Pixel pixel_of(const StoredCell& cell, const sweep::MapProblem& problem);

/// All that a store has, as a map.
[[nodiscard]] sweep::Map read_map(const Store& store, const MapWish& wish);

/// Binds a problem to a store. The problem must not outlive this object.
class MapStore {
 public:
  MapStore(Store store, sweep::MapProblem& problem);
  [[nodiscard]] const Store& store() const { return store_; }

 private:
  void note(std::span<const sweep::Pixel> pixels);

  Store store_;
  const sweep::MapProblem& problem_;
  std::vector<bool> known_;  // as they were at the start: only then are they asked for
  mutable std::mutex mutex_;
};

}  // namespace slapstick::app
