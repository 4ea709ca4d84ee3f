#pragma once
/// What is left of dying legs on the orbit without them: which guards are zero there, and where.
#include <optional>
#include <vector>

#include "change/without_legs.hpp"
#include "slapstick/orbit/special_point.hpp"

namespace slapstick::orbit {

/// The touches that the dying legs of an orbit leave on a shorter one. By continuity
/// - the guard of each event between the legs is zero, if the mode that is left has that guard;
/// - the force that holds a contact is at its limit where a slip that began without speed dies.
/// @param dying  of each leg of `near`
/// @returns empty if some of the legs leave nothing
[[nodiscard]] std::optional<std::vector<Touch>> touches(const ModeSet& set, const Orbit& near,
                                                        const std::vector<bool>& dying, const Shortened& shorter);

}  // namespace slapstick::orbit
