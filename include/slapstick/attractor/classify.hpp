#pragma once
/// What a motion is after its transient: n-p-I / n-p-II, periodic, quasi-periodic or chaotic.
///
/// States are compared modulo the rigid translations that the model does not notice: a drill that advances by the same
/// amount every blow is periodic, with a `drift`. The multiplier 1 of every such translation is left out.
///
/// How it decides (docs/classify.md):
///  1. *Periodic.* The stroboscopic state returns after n periods: ||X_k - X_{k-n}|| <= `tolerance` for the smallest
///     such n, with the same events in both cycles. Close to a bifurcation convergence is slow, so a candidate with a
///     return below `newton_start` is also solved for by Newton's method on the n-period map (exact Jacobian through
///     all events); it counts if it reproduces itself, is stable (all multipliers inside the unit circle) and the
///     motion is still approaching it.
///  2. Otherwise the *largest Lyapunov exponent* (per period, with its standard error from batches) and the *weighted
///     Birkhoff average* of the impact sequence over two halves are computed. On a smooth invariant curve the two
///     averages agree to many digits; on a chaotic set to about two. Chaotic: exponent > 3 errors and > 0.005, few
///     digits. Quasi-periodic: exponent not positive by that measure, at least `curve_digits` digits, and the motion no
///     longer closing in on a cycle.
///  3. Neither: *undecided*, with the figures that would not agree.
///
/// Cost: the transient and the search take about a microsecond a period for the paper's system; the exponent adds a
/// tangent vector to the motion. Threads: safe to call at once, one System for all. Source: docs/classify.md; Das et
/// al. (2017) for the averages.
#include <atomic>
#include <complex>
#include <functional>
#include <string>
#include <vector>

#include "slapstick/section/stop_choice.hpp"

namespace slapstick {

enum class Attractor { periodic, quasi_periodic, chaotic, undecided };
enum class Chatter { none, incomplete, complete };

/// "periodic", "quasi-periodic", "chaotic", "undecided"; "none", "incomplete", "complete".
std::string_view name(Attractor attractor);
std::string_view name(Chatter chatter);

struct ClassifyOptions {
  int transient_periods = 500;
  int most_periods = 20'000;    ///< search for a return this long before the motion is taken as not periodic
  int most_n = 64;              ///< longest cycle sought, forcing periods
  double tolerance = 1e-10;     ///< return distance, relative to the size of the motion
  double newton_start = 1e-3;   ///< return distance below which Newton's method is tried
  int exponent_periods = 4000;  ///< length of the exponent and average runs
  double curve_digits = 5.0;
  /// Whose impacts a cycle is counted and listed by: p, `impacts`, `chatter` and the label. Engagements of compliant
  /// stops count as impacts. The attractor is the same for every choice.
  StopChoice stops = {};
  const std::atomic<bool>* cancel = nullptr;  ///< set it and classify returns soon, with `interrupted`
  /// Called after every forcing period of the transient and the search with the number of them so far; at most
  /// transient_periods + most_periods, and less if a cycle is found early.
  std::function<void(long periods)> progress = {};
};

/// One impact of the cycle.
struct CycleImpact {
  double phase = 0.0;  ///< fraction of a period
  double w = 0.0;
  int contact = 0;  ///< the stop that is hit: System::contact_name
  State state;      ///< just before, user's coordinates
};

struct Classification {
  Attractor attractor = Attractor::undecided;
  int n = 0;              ///< periodic: forcing periods per cycle
  long p = 0;             ///< periodic: impacts per cycle; meaningless with complete chatter (then infinite)
  bool sticking = false;  ///< a stick phase in the cycle (or in the recorded motion)
  Chatter chatter = Chatter::none;
  std::string label;  ///< "1-1-II", "1-inf-II", "quasi-periodic", "chaotic", "undecided"

  std::vector<std::complex<double>> multipliers;  ///< periodic: of the n-period map, largest first
  double return_distance = 0.0;  ///< periodic: how far the recorded state is from its image after n periods, relative
  double approach = 0.0;         ///< periodic: how far the motion still was from the cycle when it was recognised
  std::vector<CycleImpact> impacts;  ///< periodic: the impacts of one cycle
  double sticking_fraction = 0.0;    ///< share of time in stick (and on the closed stop)

  double exponent = 0.0,
         exponent_error = 0.0;  ///< largest Lyapunov exponent per period; multipliers give it if periodic
  double digits = 0.0;          ///< agreement of the two weighted Birkhoff averages
  long periods_used = 0;
  bool interrupted = false;  ///< by `cancel`: nothing else is meant
  /// How far the motion moves along the translations that the model does not notice (docs/classify.md), by coordinate:
  /// per cycle if periodic, else on average per forcing period. Zero if that is below `tolerance`; empty if there is no
  /// such translation.
  std::vector<double> drift;
  State state;  ///< on the attractor, at phase 0 of a period: a start that needs no transient
};

/// Classifies the motion that starts at `state` at phase 0.
/// @throws InputError for a model without forcing (no stroboscopic map) or a state that the stops forbid;
/// NumericalError as Motion::advance
Classification classify(const System& system, const State& state, const ClassifyOptions& options = {});

}  // namespace slapstick
