#pragma once
/// The derivative of what happens at one instant: how tangent vectors pass the events of a motion.
///
/// One guard h, reset R, flows f- and f+:
///     dt = -(h . delta-) / (dh/dt-),     delta+ = R (delta- + f- dt) - f+ dt
/// (the saltation matrix applied; dh/dt includes the forcing). R is the linear map of all impacts that follow from the
/// event at its instant, else the identity.
///
/// Several guards at one instant, as in symmetric machines: one after the other, each with the impacts and the changes
/// of contact states that are its own (instant_parts.hpp). The result is the derivative where their order does not
/// matter. Where it does (two bodies that hit a third at once) the motion has none, which `differentiable` says; what
/// `pass_event` gives is that of the order in which the model has them.
///
/// A pulse of a signal has its instant by the clock, and adds nothing to a tangent: R is that of the stops that bear it
/// or are hit by it.
///
/// Bouncing that a pile-up ends, and a chatter limit, annihilate gaps and their rates and keep the momentum; they have
/// no time of their own.
///
/// Source: Leine and Nijmeijer (2004), chapter 7.
#include <Eigen/Core>

namespace slapstick::flow {

class Engine;

/// Takes the columns of `tangents` (p and u of all d displacements) through the last event of `engine`, which must have
/// ended a segment.
void pass_event(const Engine& engine, Eigen::MatrixXd& tangents);

/// What the mode behind the instant holds still is exactly zero: the rank loss of stick. A saltation makes it so to
/// rounding only.
void hold_still(const Engine& engine, Eigen::MatrixXd& tangents);

/// Sliders rest, or go with their pairs, and their rates say so: a large mode takes p' = u for granted.
void move_sliders(const Engine& engine, Eigen::MatrixXd& tangents);

/// Does the last instant of `engine` have a derivative? The instant has one where the guards that were zero together
/// give the same, whichever of them comes first: bodies that do not act on each other, or several contacts on one pair.
[[nodiscard]] bool differentiable(const Engine& engine);

}  // namespace slapstick::flow
