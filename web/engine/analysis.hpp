#pragma once
/// What is computed in one piece: the class of a motion, and its spectrum. A worker that must hear of a newer wish is
/// ended and begun anew.
///
/// Results are objects for the page; the keys are those of web/src/protocol.ts. Errors as the library's.
#include "choice.hpp"
#include "io/json.hpp"

namespace slapstick::web {

/// classify with a search and exponent of `periods`, for a page that does not wait long.
[[nodiscard]] Json classify_motion(const Choice& choice, int periods);

/// The lines of a quantity's cycle, or, where there is no cycle, its density.
[[nodiscard]] Json spectrum_of(const Choice& choice, const std::string& quantity, double highest_order);

}  // namespace slapstick::web
