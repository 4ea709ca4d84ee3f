#pragma once
/// A model with the caller's values: what every verb begins with.
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "slapstick/flow/system.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick::python {

/// A start as the caller gives it: numbers by name in place of the model's own, or all of them.
using Start = std::variant<Overrides, State>;

/// @throws InputError; of a mistake in the values it names no line of the model file, where nothing is wrong
[[nodiscard]] Model build(const ModelDefinition& definition, const Overrides& values);

/// @throws InputError naming the coordinate or the stop
[[nodiscard]] State start_of(const ModelDefinition& definition, const Overrides& values,
                             const std::optional<Start>& start);

/// The names of all contacts, in the library's numbering: stops, friction contacts, compliant stops, characteristics.
[[nodiscard]] std::vector<std::string> contact_names(const Model& model);

}  // namespace slapstick::python
