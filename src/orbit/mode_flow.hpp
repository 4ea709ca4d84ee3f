#pragma once
/// The motion in one mode over a time, exp(A s) X, with its first derivatives.
///
///     X' = A X,   Y' = A Y + A_p X    (Y: the derivative of X with respect to a parameter)
///
/// On a short step both are series, whose terms are summed together. A time of many steps is put together from one,
/// doubled again and again:
///
///     E = exp(A h),   D_p its derivative:   E(2h) = E E,   D_p(2h) = D_p E + E D_p
///
/// Relative error: some roundings times the number of steps. In a long time it is a change of A by roundings, the same
/// for all times: Newton's method sees a smooth function.
#include <Eigen/Core>

#include "orbit/mode_set.hpp"

namespace slapstick::orbit {

/// A vector and its derivatives with respect to the contact state at the leg's start, the instants of its two ends
/// (periods), and the parameters: a column each.
struct Jet {
  Jet(Eigen::Index rows, Eigen::Index state_count, Eigen::Index parameter_count)
      : all(Eigen::MatrixXd::Zero(rows, 3 + state_count + parameter_count)),
        states(state_count),
        parameters(parameter_count) {}

  [[nodiscard]] auto value() { return all.col(0); }
  [[nodiscard]] auto value() const { return all.col(0); }
  [[nodiscard]] auto by_state() { return all.middleCols(1, states); }
  [[nodiscard]] auto by_state() const { return all.middleCols(1, states); }
  [[nodiscard]] auto by_begin() { return all.col(1 + states); }
  [[nodiscard]] auto by_begin() const { return all.col(1 + states); }
  [[nodiscard]] auto by_end() { return all.col(2 + states); }
  [[nodiscard]] auto by_end() const { return all.col(2 + states); }
  [[nodiscard]] auto by_parameter() { return all.rightCols(parameters); }
  [[nodiscard]] auto by_parameter() const { return all.rightCols(parameters); }

  Eigen::MatrixXd all;
  Eigen::Index states, parameters;
};

/// exp(A s) of all columns, and what the parameters add.
/// @param X  parameters: none, or all of the mode
/// @throws NumericalError as ModeRates::steps
void flow(const ModeRates& mode, double s, Jet& X);

/// Is a time so long that flow() doubles steps?
[[nodiscard]] bool is_long(const ModeRates& mode, double s);

/// exp(A s) as a matrix, for many states. @param s  no longer than a step
[[nodiscard]] Eigen::MatrixXd short_flow(const ModeRates& mode, double s);

}  // namespace slapstick::orbit
