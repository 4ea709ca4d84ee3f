#pragma once
/// Points of a picture, coloured by the stop that they belong to.
#include <vector>

#include "figure/figure.hpp"
#include "slapstick/section/stop_choice.hpp"

namespace slapstick::app {

/// One cloud per chosen stop, with a legend if there are several.
class ContactClouds {
 public:
  enum class Overlap { rare, rims };  ///< rims: where points of two stops coincide, the first shows around the second
  ContactClouds(const Model& model, const StopChoice& choice, Overlap overlap);

  void add(int contact, double x, double y);
  /// Those that have points.
  [[nodiscard]] std::vector<figure::Points> points() const;

 private:
  std::vector<int> stops_;
  std::vector<figure::Points> clouds_;
};

}  // namespace slapstick::app
