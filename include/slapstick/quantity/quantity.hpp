#pragma once
/// The quantities of a model file: those of slapstick/model/quantity.hpp and the parameters, with units.
///
///     const auto all = quantities(definition);
///     const Quantity press = find_quantity(all, "F_wall");
///
/// Plain data; values may be shared between threads. Cost: microseconds. Source: docs/reference/measure.md.
#include <vector>

#include "slapstick/io/model_file.hpp"
#include "slapstick/model/quantity.hpp"

namespace slapstick {

/// The same and the parameters, with units as far as the file states them (ModelDefinition::stated_units).
/// @throws InputError as ModelDefinition::build
[[nodiscard]] std::vector<Quantity> quantities(const ModelDefinition& definition, const Overrides& overrides = {});

}  // namespace slapstick
