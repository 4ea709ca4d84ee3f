#pragma once
/// Units of quantities in a system of units.
#include <array>
#include <string>

#include "slapstick/io/model_file.hpp"
#include "slapstick/model/quantity.hpp"

namespace slapstick::quantity {

/// The unit where lengths are `length`; that of forces and energies if there is a mass.
[[nodiscard]] std::string unit_of(const Quantity& quantity, const std::string& length, const StatedUnits& stated);

/// The unit of all coordinates, if they have one.
[[nodiscard]] std::string common_unit(const std::vector<std::string>& units);

/// The powers of length, time and mass in a quantity; of a parameter and of times in periods none.
[[nodiscard]] std::array<int, 3> dimensions(const Quantity& quantity);

}  // namespace slapstick::quantity
