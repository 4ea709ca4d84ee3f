#pragma once
/// Largest Lyapunov exponent and weighted Birkhoff averages of one run.
#include "attractor/cycle.hpp"
#include "attractor/rotation.hpp"
#include "flow/translations.hpp"

namespace slapstick::attractor {

struct RunFigures {
  double exponent = 0.0, exponent_error = 0.0;  ///< per return; -infinity if every tangent dies out (stick)
  double digits = 0.0;       ///< agreement of the weighted Birkhoff averages of two halves, decimal digits
  Rotation rotation;         ///< of the points of the section
  PeriodEvents events;       ///< chatters: of the chosen stops
  State state;               ///< at the end; its class is represented as in Translations
  Eigen::VectorXd advance;   ///< mean along each translation, per return
  double mean_return = 1.0;  ///< in periods
  bool ended = false;        ///< the motion did not return any more: nothing else is meant but `state`
  bool burst = false;        ///< an incomplete chatter of the chosen stops
  double sticking_fraction = 0.0;
};

/// Follows the motion and one tangent, both modulo the translations, for `returns` returns; the exponent's error is the
/// standard error of 20 batch means. The tangent's part along a free motion is taken out.
RunFigures run_figures(const section::ReturnMap& map, const State& state, int returns, const StopChoice& stops,
                       Stop stop);

/// Digits to which the weighted Birkhoff averages (weight exp(-1/(t(1-t)))) of the two halves of a sequence agree,
/// relative to its spread. On a smooth invariant curve the averages converge faster than any power of the length (Das,
/// Sander and Yorke), on a chaotic set like its square root.
double birkhoff_digits(const std::vector<double>& sequence);

}  // namespace slapstick::attractor
