#pragma once
/// [scale] and the units of a model file. Numbers of a model with [scale] are dimensionless:
/// physical = dimensionless * scale.
#include <array>

#include "io/model_builder.hpp"

namespace slapstick {

/// Checks that no unit is missing, unknown or mixed with others; see docs/reference/model_file.md. @throws InputError
void check_units(const Definition& definition);

/// The unit of these powers of length, time and mass, as a product of those of [scale]: "mm/s^2".
[[nodiscard]] std::string unit_of_scale(const Definition& definition, const std::array<int, 3>& powers);

/// The unit that the coordinates at the ends of an element have: that of its inner coordinate. "" if they have
/// none, or several, or a ratio.
[[nodiscard]] std::string unit_of_inner(const Definition& definition, const Part& element);

/// The physical unit of every column and the factor to it; nothing for a model without [scale]. @throws InputError
[[nodiscard]] std::optional<PhysicalUnits> physical_units(const Definition& definition, const Values& values);

}  // namespace slapstick
