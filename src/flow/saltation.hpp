#pragma once
/// The derivative of what happens at one instant: how tangent vectors pass the events of a motion.
///
/// One guard h, reset R, flows f- and f+:
///     dt = -(h . delta-) / (dh/dt-),     delta+ = R (delta- + f- dt) - f+ dt
/// (the saltation matrix applied; dh/dt includes the forcing). R is the linear map of all impacts that follow from the
/// event at its instant, else the identity.
///
/// Several guards at one instant, as in symmetric machines: one after the other, each with the impacts and the changes
/// of contact states that are its own. That is the derivative where their contacts do not act on each other through the
/// masses. Where they do (two bodies that hit a third at once) the motion has no derivative: which comes first decides;
/// what is given is that of the order in which the model has them.
///
/// Bouncing that a pile-up ends, and a chatter limit, annihilate gaps and their rates and keep the momentum; they have
/// no time of their own.
///
/// Source: Leine and Nijmeijer (2004), chapter 7.
#include <Eigen/Core>
#include <vector>

#include "mode/frame.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::flow {

class Engine;

/// u -> u - M^{-1} G^T D^+ F G u, D = G M^{-1} G^T: the rates of some displacements are changed by impulses along them,
/// momentum is kept.
/// @param rows    the displacements; if they depend on each other, any solution gives the same
/// @param factor  F, one for each: 1 brings it to rest, 1 + r turns it back
/// @param block   d rows, of velocities, or of displacements that follow them
void push_along(const mode::Frame& frame, const std::vector<int>& rows, const Eigen::VectorXd& factor,
                Eigen::Ref<Eigen::MatrixXd> block);

/// Takes the columns of `tangents` (p and u of all d displacements) through the last event of `engine`, which must have
/// ended a segment.
void pass_event(const Engine& engine, Eigen::MatrixXd& tangents);

}  // namespace slapstick::flow
