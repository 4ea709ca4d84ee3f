#pragma once
/// A diagram in a store: a cell for each value and direction.
#include <vector>

#include "map_store.hpp"
#include "slapstick/sweep/diagram.hpp"

namespace slapstick::app {

/// Binds a problem to a store: what is there is not computed again. The problem must not outlive this object.
class DiagramStore {
 public:
  DiagramStore(Store store, sweep::DiagramProblem& problem);

 private:
  Store store_;
  std::vector<sweep::DiagramPoint> known_;  // `done` where it is known
};

[[nodiscard]] StoredCell cell_of(std::size_t place, const sweep::DiagramPoint& point);
/// Without parameter and direction, which the place gives. @throws StorageError if the numbers are none of a point
[[nodiscard]] sweep::DiagramPoint point_of(const StoredCell& cell);

}  // namespace slapstick::app
