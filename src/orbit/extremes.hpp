#pragma once
/// The extremes of linear functionals of the extended state along a leg and over a cycle, exact to rounding.
///
/// A leg is cut into steps on which f(s) = c . exp(A s) X is a polynomial to rounding. In Bernstein's basis f' has no
/// more zeros in a piece than its coefficients have changes of sign: with none, f is monotone; with one, the zero is
/// found between the ends; with more, the piece is halved, until f varies in it by rounding only. Nothing is sampled:
/// no extreme is missed. Cost: about that of leg_flow for any number of functionals.
#include <Eigen/Core>
#include <vector>

#include "orbit/equations.hpp"

namespace slapstick::orbit {

struct Extreme {
  double value = 0.0;
  std::size_t leg = 0;
  double at = 0.0;  ///< periods (time, without forcing) from the leg's start
};

/// Of one functional.
struct Extremes {
  Extreme least, most;
  [[nodiscard]] double range() const { return most.value - least.value; }
  [[nodiscard]] double largest() const { return std::max(std::abs(least.value), std::abs(most.value)); }
};

/// Over the whole cycle, both sides of every impact included.
/// @param functionals  a row for each, over the extended state X (mode/frame.hpp)
/// @throws NumericalError if a leg is too long for the rates of its mode
[[nodiscard]] std::vector<Extremes> extremes(const ModeSet& set, const Orbit& orbit,
                                             const Eigen::MatrixXd& functionals);

/// Along one leg, from just after the event at its start to just before the impacts at its end.
[[nodiscard]] std::vector<Extremes> extremes(const ModeSet& set, const Orbit& orbit, std::size_t leg,
                                             const Eigen::MatrixXd& functionals);

/// Functionals of X: displacements x_1 .. x_n of the model's coordinates, then their velocities v_1 .. v_n.
[[nodiscard]] Eigen::MatrixXd coordinate_functionals(const mode::Frame& frame);

/// Functionals of X: the numbers of the contact state modulo the model's translations, displacements first
/// (flow/translations.hpp).
[[nodiscard]] Eigen::MatrixXd number_functionals(const Problem& problem, const mode::Frame& frame);

}  // namespace slapstick::orbit
