#pragma once
/// A model file as data that edits work on: every number with its dimension.
#include <functional>
#include <string>

#include "io/definition.hpp"

namespace slapstick::neutral {

/// Powers of length, time and mass.
struct Dimension {
  int length = 0, time = 0, mass = 0;
  friend auto operator<=>(const Dimension&, const Dimension&) = default;
};

/// Of what a file has. The force of a signal has the rest: a signal is a length.
namespace dim {
constexpr Dimension pure{}, length{1, 0, 0}, time{0, 1, 0}, mass{0, 0, 1}, speed{1, -1, 0}, acceleration{1, -2, 0},
    force{1, -2, 1}, impulse{1, -1, 1}, energy{2, -2, 1}, power{2, -3, 1}, stiffness{0, -2, 1}, damping{0, -1, 1},
    rate{0, -1, 0};
}

/// Calls visit(number, dimension) for every number of a file.
/// Parameters are pure numbers: what they stand in has the dimension.
void each_number(Definition& file, const std::function<void(Scalar&, Dimension)>& visit);

[[nodiscard]] Scalar number(double value);
/// The number or expression times a factor.
void multiply(Scalar& scalar, double factor);
/// The number or expression plus another number.
void add(Scalar& scalar, double summand);
[[nodiscard]] double value(const Definition& file, const Scalar& scalar);

/// All parts with two ends, of all kinds.
void each_linked(Definition& file, const std::function<void(Part&)>& visit);
[[nodiscard]] std::vector<Part>& parts(Definition& file, const std::string& kind);
/// The field of a part, or null.
[[nodiscard]] Scalar* field(Part& part, const std::string& key);
[[nodiscard]] int coordinates(const Definition& file);
/// What a coordinate's number stands still with: its base, or the ground.
[[nodiscard]] int home(const Definition& file, int coordinate);
/// "x1" -> "v1"
[[nodiscard]] std::string velocity_name(const std::string& coordinate);
/// Is some force or base a harmonic of omega, of whatever size?
[[nodiscard]] bool has_harmonics(const Definition& file);
/// Every number of the start, also those that the file leaves out.
[[nodiscard]] std::vector<std::pair<std::string, Scalar>> whole_start(const Definition& file);

[[nodiscard]] std::string text(const Definition& file);
/// As the program reads it. @throws InputError
[[nodiscard]] ModelDefinition read(const Definition& file);

}  // namespace slapstick::neutral
