#pragma once
/// One leg of a cycle in closed form, with all its first derivatives.
///
///     X_end = exp(A s) S X(x, t_0),   s = (t_1 - t_0) T;   h = guard . X_end, or t_1 - t_knot;   x_after = H R X_end,
/// at a pulse of a signal H R (X_end + K)
///
/// S: the plastic impact that sums a chatter's tail, else the identity. R: the impacts at the end. H: what the next
/// mode holds still is zero.
#include <Eigen/Core>
#include <vector>

#include "orbit/mode_flow.hpp"
#include "orbit/mode_set.hpp"
#include "slapstick/orbit/itinerary.hpp"

namespace slapstick::orbit {

/// The extended state of a contact state at an instant (no derivative but by the state, the instant and the
/// parameters).
/// @param lines  that the signals are on
[[nodiscard]] Jet extended(const ModeSet& set, const std::vector<int>& lines, const Eigen::VectorXd& x, double t);

struct LegValue {
  Jet X_end;  ///< extended, before the impacts
  Jet after;  ///< contact state after the event
  Jet h;      ///< of the ending: 0 where it is met; one row. Empty columns for a cut
};

/// @param next  the leg that follows: what its mode holds still is zero from its start on, except for the speed that
/// the tail of a chatter begins with
[[nodiscard]] LegValue leg_value(const ModeSet& set, const Leg& leg, const Leg& next, const Eigen::VectorXd& x,
                                 double t_begin, double t_end);

/// The extended state at the leg's start, after the plastic impact if the leg is the tail of a chatter.
[[nodiscard]] Jet leg_start(const ModeSet& set, const Leg& leg, const Eigen::VectorXd& x, double t_begin);

/// The pulse of a signal at a leg's end.
struct Pulse {
  int signal;
  bool kinematic;
  Eigen::RowVectorXd area;  ///< and its derivatives by the parameters
};
[[nodiscard]] std::vector<Pulse> pulses(const ModeSet& set, const Leg& leg);

/// An extended state at a leg's end, and what the pulses there make of it.
[[nodiscard]] Eigen::VectorXd behind_pulses(const ModeSet& set, const Leg& leg, Eigen::VectorXd X);

/// The extended state this many periods after the start of one of an orbit's legs; no derivatives.
[[nodiscard]] Eigen::VectorXd state_within(const ModeSet& set, const Orbit& orbit, std::size_t leg, double after);

/// How many velocities the mode of a leg holds still: the fewer, the freer.
[[nodiscard]] std::ptrdiff_t held(const ModeSet& set, const Leg& leg);
/// The leg in which least is held, of several the longest; of equally long ones that which begins at the earliest
/// phase, without forcing that which begins with the largest velocity of the first coordinate in which they differ. A
/// chatter's tail only if there is nothing else.
[[nodiscard]] std::size_t freest_leg(const ModeSet& set, const Orbit& orbit);

/// The contact state of an extended one.
[[nodiscard]] Eigen::VectorXd contact_state(const ModeSet& set, const Eigen::VectorXd& X);

}  // namespace slapstick::orbit
