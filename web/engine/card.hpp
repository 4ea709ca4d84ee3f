#pragma once
/// What the page must know of a model to show it: parameters with ranges and meanings, the mechanism's parts, what can
/// be measured. One object; keys are those of the page's `ModelCard` (web/src/protocol.ts).
#include "choice.hpp"
#include "io/json.hpp"

namespace slapstick::web {

/// @throws InputError as ModelDefinition::build
[[nodiscard]] Json card_of(const Choice& choice);

/// The built-in models: a name and a summary each.
[[nodiscard]] Json list_of_models();

}  // namespace slapstick::web
