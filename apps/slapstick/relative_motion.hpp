#pragma once
/// The pair whose motion a picture shows: displacement y = r_a x_a - r_b x_b, velocity, and where its stops are.
#include <string>
#include <vector>

#include "slapstick/model/model.hpp"

namespace slapstick::app {

/// What lies between two bodies, or a body and the ground.
struct Sides {
  int a = 0, b = ground;
  Ratio ratio = {};
};

/// The sides of a contact, as System::contact_name counts.
[[nodiscard]] Sides sides_of(const Model& model, int contact);

/// The displacements y at which a stop, rigid or compliant, between these sides touches.
[[nodiscard]] std::vector<double> limits_of(const Model& model, const Sides& sides);

/// A contact with the ground shows the coordinate itself.
struct RelativeMotion : Sides {
  /// @param contact  as System::contact_name counts; -1: the model has no contact, the first coordinate is shown
  RelativeMotion(const Model& model, int contact);

  std::string displacement, velocity;  ///< names for axes: "x_1 − x_2"
  std::vector<double> limits;          ///< y at which a stop, rigid or compliant, of this pair touches
  [[nodiscard]] double y(const State& state) const { return relative(*this, state, 0); }
  [[nodiscard]] double w(const State& state) const { return relative(*this, state, 1); }
};

}  // namespace slapstick::app
