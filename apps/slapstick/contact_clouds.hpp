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
  /// Of one direction of a sweep: named, smaller and in other colours for the way down.
  void direct(bool up);

 private:
  std::vector<int> stops_;
  std::vector<figure::Points> clouds_;
};

/// The same for a sweep: of two directions each stop has a colour for each.
class DirectedClouds {
 public:
  DirectedClouds(const Model& model, const StopChoice& choice, bool both);

  void add(int contact, bool up, double x, double y) { (up || !both_ ? up_ : down_).add(contact, x, y); }
  [[nodiscard]] std::vector<figure::Points> points() const;

 private:
  ContactClouds up_, down_;
  bool both_;
};

}  // namespace slapstick::app
