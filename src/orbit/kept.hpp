#pragma once
/// Displacements that no leg of an orbit moves, as of a slider or a body that rests all along.
///
/// Such an orbit is one of a family: the closing of the number holds for any value. The equations keep the number as it
/// is instead (Linearised::kept), and are regular. Derivatives and branches are those with the number where it is.
#include "orbit/equations.hpp"

namespace slapstick::orbit {

/// Finds these numbers by their closing rows, and puts in place of each row that the number stays.
void keep_what_rests(const Problem& problem, const Orbit& orbit, Linearised& at);

/// Makes the numbers that the cycle forgets exactly what it makes of them, as a velocity that is zero: rounding there
/// would be an event.
/// @param was  the first state's numbers where `at` was linearised
void settle_forgotten(const Problem& problem, const Linearised& at, const Eigen::VectorXd& was, Orbit& orbit);

/// Is a displacement, by its place in a contact state, among those that are kept?
[[nodiscard]] bool keeps(const Problem& problem, const std::vector<Eigen::Index>& kept, Eigen::Index displacement);

/// @throws NumericalError where a slider that rests all along is at its limit: it is drawn along to one side of a
/// parameter, and stays to the other
void demand_off_limits(const Problem& problem, const ModeSet& set, const Orbit& orbit,
                       const std::vector<Eigen::Index>& kept);

/// Can friction that holds a body be at its limit, and the body stay or be drawn along? Not where it falls as the body
/// begins to slip: the body jumps.
[[nodiscard]] bool may_be_drawn_along(const FrictionContact& friction);

/// How many numbers of an orbit are kept: along these dimensions of its family it can be followed.
[[nodiscard]] int kept_numbers(const Problem& problem, const Orbit& orbit);

}  // namespace slapstick::orbit
