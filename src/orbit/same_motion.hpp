#pragma once
/// Whether two orbits are one motion, whatever their legs and wherever they begin; or mirror images of one another.
///
/// Some models, such as a mass between equal stops, do not change when all displacements are reversed about some point
/// and the forcing is taken half a period later. Such a model has with an orbit x(t) also its image c - x(t + T/2); one
/// that is forced at even harmonics only has x(t + T/2). A symmetric orbit is its own image; what a broken symmetry
/// leaves comes in pairs.
#include "orbit/equations.hpp"

namespace slapstick::orbit {

/// The largest distance of the two motions' states modulo translations, over some phases in the long legs of `a`, by
/// displacements and velocities each relative to their largest: rounding for one motion, chattering ones too. Infinite
/// without forcing, where there is no phase, and for other n.
[[nodiscard]] double apart(const Problem& problem, const Orbit& a, const Orbit& b);

/// Are the long legs of a, by most of their time, much the same in b: the same mode at the same instant, and the state
/// to this part of the extent of a? Without forcing, where phases mean nothing, where a leg of that mode begins.
[[nodiscard]] bool resembles(const Problem& problem, const Orbit& a, const Orbit& b, double much_the_same);

/// `apart` of an orbit and itself this many periods later.
[[nodiscard]] double apart_from_later(const Problem& problem, const Orbit& orbit, int periods);

/// `apart` of the first orbit and the image of the second, for the c that fits.
[[nodiscard]] double apart_from_image(const Problem& problem, const Orbit& a, const Orbit& b);

/// .. of an orbit and its own image; of a free motion its mirror image half a cycle later.
[[nodiscard]] double apart_from_own_image(const Problem& problem, const Orbit& orbit);

/// Is an orbit beside a symmetric one not its own image? Then its image lies there too.
/// The model must have images: without an impact an orbit of a linear system is its own, whatever the stops are.
[[nodiscard]] bool breaks_symmetry(const Problem& problem, const Orbit& orbit, const Orbit& symmetric);

}  // namespace slapstick::orbit
