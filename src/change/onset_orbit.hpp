#pragma once
/// The onset of a complete chatter as an orbit of its own, the solution of a boundary value problem: no change of the
/// cascade that gathers there is needed.
///
/// Let w = v j / a^2, with a the pressing acceleration just after impact i and j the rate at which a falls. In a and w
/// the impacts of a chatter whose contact is about to let go follow the bounce map of change/cascade_law.hpp. Its fixed
/// point (a, w) = (0, w*) is the onset: there infinitely many impacts are over just as the contact lets go. The onset's
/// orbit lies on the fixed point's stable manifold w = w* + O(a). The equations are therefore
///
///     legs up to impact N;   w_N = w*;
///     one closed leg, begun by a plastic impact that stands for all others, that ends as the contact lets go;   ..
///
/// with the parameter as a further unknown. O(a_N) = O(mu^N) of w is O((mu / lambda)^N) of the parameter: N grows until
/// that is rounding.
#include "orbit/equations.hpp"

namespace slapstick::orbit {

struct OnsetOrbit {
  Orbit orbit;         ///< of the equations above
  double error = 0.0;  ///< of orbit.parameter()
};

/// The onset near an orbit, complete chatter or not, that passes near the fixed point.
/// @param stop  that chatters
/// @returns empty if the orbit passes the fixed point too far away, if its flights have other events between them, or
/// dry friction on the stop's pair
[[nodiscard]] std::optional<OnsetOrbit> onset_orbit(const Problem& problem, const Orbit& near, int stop);

/// Is there dry friction on a stop's pair? A cascade then gathers by another law.
[[nodiscard]] bool has_friction(const Model& model, const mode::Frame& frame, int stop);

/// The stop of an orbit's complete chatter; of several, or none: empty.
[[nodiscard]] std::optional<int> chattering_stop(const Orbit& orbit);

}  // namespace slapstick::orbit
