#pragma once
/// Quantities that the expressions of observables name.
#include <string>
#include <vector>

#include "io/definition.hpp"
#include "slapstick/model/quantity.hpp"

namespace slapstick {

/// May the name be that of a quantity, by the patterns of quantity_rules, and no name that a file gives itself: that of
/// a parameter, a base, or the gap of a stop? (Displacements and velocities are the state.)
[[nodiscard]] bool names_quantity(const Definition& definition, const std::string& name);

/// The names that the expression of an observable may have: those of quantities are looked at when there is a model.
[[nodiscard]] std::vector<std::string> observable_names(const Definition& definition, const std::string& expression);

/// Those of all observables, each once. @throws InputError with the file's line for one that the model has not
[[nodiscard]] std::vector<Quantity> observed_quantities(const Definition& definition, const Model& model);

}  // namespace slapstick
