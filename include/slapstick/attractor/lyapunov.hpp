#pragma once
/// All Lyapunov exponents of a motion, through impacts, stick and the limits of chatter.
///
/// A frame of tangent vectors is carried along the motion and made orthonormal again (QR) at every event and a few
/// times in between; the exponent of place i is the mean of ln R_ii (Benettin et al. 1980). Where stick, a closed stop
/// or a chatter limit forgets a direction, the frame loses a vector for good: that
/// exponent is minus infinity, exactly. Vectors that the transient has lost are put in again at its end.
/// Rigid translations that the model does not notice have the exponent 0 and are left out, as in `classify`; of a model
/// without forcing the exponent along the motion, 0, is among the others.
///
/// The sum rule: as long as no direction is lost, the sum of all exponents is the mean rate at which the flow and its
/// events contract volumes,
///     sum = (sum over segments of tr A s + sum over events of ln |det S|) / time,
/// S the saltation matrix. Both sides are computed, by QR and by traces and determinants.
///
/// Cost: some 2n tangent vectors beside the motion and a QR at every event. Threads: safe to call at once, one System
/// for all. Source: docs/explanation/lyapunov.md; Mueller (1995) for jumps of the flow.
#include <atomic>
#include <functional>
#include <vector>

#include "slapstick/flow/system.hpp"

namespace slapstick {

struct LyapunovOptions {
  long transient_periods = 500;  ///< forcing periods (units of time without forcing) that are left out
  long most_periods = 20'000;    ///< .. and that the exponents are taken from
  /// The run ends as soon as every standard error, per period, is below this; 0: only at most_periods.
  double error = 0.0;
  const std::atomic<bool>* cancel = nullptr;
  std::function<void(long periods)> progress = {};  ///< with the periods so far, transient included
};

struct LyapunovExponents {
  /// 2n less the translations and the rates of inner coordinates, largest first; -infinity where a direction is lost
  std::vector<double> per_period;
  std::vector<double> errors;  ///< standard errors per period, by batch means; 0 for -infinity
  double period = 1.0;         ///< the forcing period in the model's unit of time; 1 without forcing
  /// Kaplan-Yorke: of the attractor in a stroboscopic section; without forcing of the attractor itself. Exponents
  /// within three standard errors of 0 count as 0.
  double dimension = 0.0;
  double sum = 0.0;          ///< of per_period
  double contraction = 0.0;  ///< the other side of the sum rule, per period
  double rounding = 0.0;     ///< what rounding may put between the two
  long periods = 0;          ///< used
  bool reached = true;       ///< every error is below LyapunovOptions::error
  bool interrupted = false;  ///< by `cancel`: nothing else is meant

  /// Both sides are -infinity, or agree within rounding.
  [[nodiscard]] bool sum_rule_holds() const;
};

/// @param state  at phase 0
/// @throws InputError for a state that the stops forbid; NumericalError as Motion::advance
[[nodiscard]] LyapunovExponents lyapunov(const System& system, const State& state, const LyapunovOptions& options = {});

/// The j with the sum of the first j exponents still positive, and the share of the next that makes the sum zero; the
/// number of exponents if no sum is negative.
/// @param exponents  largest first
[[nodiscard]] double kaplan_yorke_dimension(const std::vector<double>& exponents);

}  // namespace slapstick
