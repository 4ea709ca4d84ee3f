#pragma once
/// The pair whose motion a picture shows: displacement x_a - x_b, velocity v_a - v_b, and where its stops are.
#include <string>
#include <utility>
#include <vector>

#include "slapstick/model/model.hpp"

namespace slapstick::app {

/// The two sides of a contact, as System::contact_name counts.
[[nodiscard]] std::pair<int, int> sides_of(const Model& model, int contact);

/// The displacements x_a - x_b at which a stop, rigid or compliant, of this pair touches.
[[nodiscard]] std::vector<double> limits_of(const Model& model, int a, int b);

/// A contact with the ground shows the coordinate itself.
struct RelativeMotion {
  /// @param contact  as System::contact_name counts; -1: the model has no contact, the first coordinate is shown
  RelativeMotion(const Model& model, int contact);

  int a = 0, b = ground;
  std::string displacement, velocity;  ///< names for axes: "x_1 − x_2"
  std::vector<double> limits;          ///< y at which a stop, rigid or compliant, of this pair touches
  [[nodiscard]] double y(const State& state) const { return at(state, a, 0) - at(state, b, 0); }
  [[nodiscard]] double w(const State& state) const { return at(state, a, 1) - at(state, b, 1); }

 private:
  static double at(const State& state, int coordinate, int offset) {
    return coordinate == ground ? 0.0 : state[2 * static_cast<std::size_t>(coordinate) + offset];
  }
};

}  // namespace slapstick::app
