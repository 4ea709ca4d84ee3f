/// Whether the stops leave any room at all. Each is a difference constraint, x_a - x_b <= clearance; around a loop the
/// left sides add up to zero, so that the clearances must not add up to less. If they do so around no loop, some
/// position obeys all stops (Bellman and Ford).
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/text.hpp"
#include "model/fault.hpp"

namespace slapstick {
namespace {

using Found = std::optional<Fault>;

/// Of a sum of clearances, in units of their sizes, as in Frame::drop_rounding: 0.1 + 0.2 and 0.3 are the same.
constexpr double roundings = 0x1p-47;

/// Two stops that face each other, one on x_a - x_b and one on x_b - x_a, must leave room between them.
Found facing_stops(const Model& model) {
  for (std::size_t i = 0; i < model.stops.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Stop &stop = model.stops[i], &other = model.stops[j];
      const double room = stop.clearance + other.clearance;
      if (same_pair(stop, other) >= 0 || room > 0.0) continue;
      return Fault{"stop", static_cast<int>(i), "clearance",
                   "clearance = " + shown(stop.clearance) + " leaves no room opposite stop " + in_quotes(other.name) +
                       " with clearance = " + shown(other.clearance) + ": their sum must be positive"};
    }
  return std::nullopt;
}

/// Upper bounds of the coordinates and the ground, by which stop each.
class Bounds {
 public:
  explicit Bounds(const Model& model)
      : model_(model), highest_(model.coordinates.size() + 1, 0.0), by_(highest_.size(), 0) {}

  /// The stops of a loop without room, or none. A node that is still lowered after as many rounds as there are nodes
  /// has no chain of stops that ends: going back along it leads into a loop.
  std::vector<std::size_t> loop() {
    std::size_t node = 0;
    for (std::size_t round = 0; round < highest_.size(); ++round)
      if (!lower(node)) return {};
    for (std::size_t step = 0; step < highest_.size(); ++step) node = before(node);
    std::vector<std::size_t> stops;
    for (std::size_t at = node; stops.empty() || at != node; at = before(at)) stops.push_back(by_[at]);
    return stops;
  }

 private:
  [[nodiscard]] std::size_t node_of(int end) const {
    return end == ground ? model_.coordinates.size() : static_cast<std::size_t>(end);
  }
  [[nodiscard]] std::size_t before(std::size_t node) const { return node_of(model_.stops[by_[node]].b); }

  /// One round over all stops; `last` is the last node lowered.
  bool lower(std::size_t& last) {
    bool any = false;
    for (std::size_t i = 0; i < model_.stops.size(); ++i) {
      const Stop& stop = model_.stops[i];
      if (stop.ratio != Ratio{}) continue;  // no difference of coordinates
      const std::size_t node = node_of(stop.a);
      const double bound = highest_[node_of(stop.b)] + stop.clearance + roundings * std::abs(stop.clearance);
      if (!(bound < highest_[node])) continue;
      highest_[node] = bound;
      by_[node] = i;
      last = node;
      any = true;
    }
    return any;
  }

  const Model& model_;
  std::vector<double> highest_;
  std::vector<std::size_t> by_;
};

Found tight_loop(const Model& model) {
  std::vector<std::size_t> loop = Bounds(model).loop();
  std::sort(loop.begin(), loop.end());
  double room = 0.0, size = 0.0;
  std::string names;
  for (const std::size_t i : loop) {
    room += model.stops[i].clearance;
    size += std::abs(model.stops[i].clearance);
    names += (names.empty() ? "" : ", ") + in_quotes(model.stops[i].name);
  }
  if (room >= -roundings * size) return std::nullopt;  // also what is rounding of bounds that are much larger
  return Fault{"stop", static_cast<int>(loop.back()), "clearance",
               "clearance = " + shown(model.stops[loop.back()].clearance) + " leaves no room in the loop of stops " +
                   names + ": their clearances add up to " + shown(room) + ", which must not be negative"};
}

}  // namespace

std::optional<Fault> first_room_fault(const Model& model) {
  const Found fault = facing_stops(model);
  return fault ? fault : tight_loop(model);
}

}  // namespace slapstick
