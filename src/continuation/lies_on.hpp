#pragma once
/// Whether an orbit has been met before on a branch.
#include "orbit/extent.hpp"
#include "slapstick/continuation/branch.hpp"

namespace slapstick::orbit {

/// Does an orbit lie between two neighbouring points of a branch, perhaps begun at another event?
/// @param extent  of the orbit
[[nodiscard]] bool lies_between(const Extent& extent, const Orbit& a, const Orbit& b, const Orbit& orbit);

/// The same where the points are too far apart for a straight line: by Newton's method from between them.
[[nodiscard]] bool meets_between(const Problem& problem, const Orbit& a, const Orbit& b, const Orbit& orbit);

/// Does it lie on the first points of a branch? @returns the one before it
[[nodiscard]] std::optional<std::size_t> lies_on_first(const Problem& problem, std::size_t count, const Branch& branch,
                                                       const Orbit& orbit);

}  // namespace slapstick::orbit
