#pragma once
/// What a motion is after its transient: n-p-I / n-p-II, periodic, quasi-periodic, chaotic, or a state of rest.
///
/// A motion that no harmonic force drives is *free*: it has no phase, and may come to rest. Its "periods" are then
/// returns to a section that its own events make (docs/explanation/classify.md, section 4). Its class is "free-p-I" or
/// "free-p-II", and the multiplier 1 along the motion is left out.
///
/// States are compared modulo the rigid translations that the model does not notice: a drill that advances by the same
/// amount every blow is periodic, with a `drift`. The multiplier 1 of every such translation is left out.
///
/// How it decides (docs/explanation/classify.md):
///  1. *Periodic.* Where the stroboscopic state nearly returns after n periods, Newton's method on the map of n periods
///     and of its divisors (exact Jacobian through all events) looks for a cycle, the shortest first. A cycle counts if
///     its multipliers are inside the unit circle and the motion loses distance at their rate. No return counts
///     without Newton's method. What returns and is one of a continuum of cycles is *one of a family*.
///  2. Otherwise the *largest Lyapunov exponent* (per period, with its standard error from batches), the *weighted
///     Birkhoff average* of the impact sequence over two halves, and the *rotation number* are computed. Chaotic: the
///     exponent's confidence interval lies above what a motion without exponent can show, and the averages agree to few
///     digits. Quasi-periodic: the interval holds zero, averages and rotation number have `curve_digits` digits, the
///     number is no fraction, and the motion no longer closes in on a cycle; without dissipation *one of a family*.
///  3. Neither: *undecided*, with what is missing (`Doubt`) and the option that would decide.
///
/// Cost: the transient and the search take about a microsecond a period for the paper's system; the exponent adds a
/// tangent vector to the motion. Threads: safe to call at once, one System for all. Source:
/// docs/explanation/classify.md; Das et al. (2017) for the averages.
#include <atomic>
#include <complex>
#include <functional>
#include <string>
#include <vector>

#include "slapstick/section/stop_choice.hpp"

namespace slapstick {

/// family: a cycle of a continuum of cycles, or a motion on a curve that nothing draws it to. equilibrium: a state of
/// rest of a free motion, modulo translations.
enum class Attractor { periodic, quasi_periodic, chaotic, family, undecided, equilibrium };
enum class Chatter { none, incomplete, complete };

/// Why a motion has no class.
enum class Doubt {
  none,
  not_confirmed,  ///< classify_quickly: Newton's method confirmed no cycle; classify decides
  approach,       ///< the motion still closes in on something: a longer transient or search
  long_cycle,     ///< a negative exponent or a fractional rotation number: a cycle longer than most_n
  exponent,       ///< exponent, averages and rotation number do not agree: a longer exponent run
  no_return,      ///< a free motion has had no event for long, but one may come yet
  growth          ///< the motion grows, or goes away, without bound
};

/// "periodic", "quasi-periodic", "chaotic", "one of a family", "undecided", "equilibrium"; "none", "incomplete",
/// "complete"; "not confirmed", "approach", "long cycle", "exponent", "no return", "growth".
std::string_view name(Attractor attractor);
std::string_view name(Chatter chatter);
std::string_view name(Doubt doubt);
/// The option of ClassifyOptions that would decide: "transient", "most_n", "exponent_periods"; "full" for classify
/// itself; or nothing.
std::string_view option_that_decides(Doubt doubt);

/// Of a free motion all periods are returns.
struct ClassifyOptions {
  int transient_periods = 500;
  int most_periods = 20'000;    ///< search for a return this long before the motion is taken as not periodic
  int most_n = 64;              ///< longest cycle sought, forcing periods
  double tolerance = 1e-10;     ///< return distance, relative to the size of the motion
  double newton_start = 1e-3;   ///< return distance below which a cycle is looked for nearby
  int exponent_periods = 4000;  ///< length of the exponent and average runs; 0: none, so that only cycles are named
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
  double phase = 0.0;  ///< fraction of a period; of a free motion of its cycle
  double w = 0.0;
  int contact = 0;  ///< the stop that is hit: System::contact_name
  State state;      ///< just before, user's coordinates
};

struct Classification {
  Attractor attractor = Attractor::undecided;
  /// Periodic: forcing periods per cycle; of a free motion how often the rarest of its events happens in a cycle.
  int n = 0;
  double period = 0.0;    ///< periodic: of the cycle, in units of time
  long p = 0;             ///< periodic: impacts per cycle; meaningless with complete chatter (then infinite)
  bool sticking = false;  ///< a stick phase in the cycle (or in the recorded motion)
  Chatter chatter = Chatter::none;
  std::string label;  ///< "1-1-II", "1-inf-II", also of one of a family; "quasi-periodic", "chaotic", ..
  int family = 0;     ///< dimensions of the continuum of cycles, or states of rest, that it is a member of
  Doubt doubt = Doubt::none;

  std::vector<std::complex<double>> multipliers;  ///< periodic: of the n-period map, largest first
  /// Equilibrium: of the linear motion about it, per unit of time, largest real part first; without the `family`
  /// zeros of states of rest beside it.
  std::vector<std::complex<double>> eigenvalues;
  double return_distance = 0.0;  ///< periodic: how far the recorded state is from its image after n periods, relative
  double approach = 0.0;         ///< periodic: how far the motion still was from the cycle when it was recognised
  std::vector<CycleImpact> impacts;  ///< periodic: the impacts of one cycle
  double sticking_fraction = 0.0;    ///< share of time in stick (and on the closed stop)

  /// Largest Lyapunov exponent per period (without a clock per unit of time), apart from the one along a free motion;
  /// the multipliers give it if periodic, the eigenvalues at rest.
  double exponent = 0.0, exponent_error = 0.0;
  double digits = 0.0;  ///< agreement of the two weighted Birkhoff averages
  /// Quasi-periodic: turns of a closed curve in `curves` periods, in (0, 0.5] (orientation is not told), and the digits
  /// to which two halves agree.
  double rotation = 0.0, rotation_digits = 0.0;
  int curves = 0;  ///< that the stroboscopic points lie on in turn
  long periods_used = 0;
  bool interrupted = false;  ///< by `cancel`: nothing else is meant
  /// How far the motion moves along the translations that the model does not notice (docs/explanation/classify.md), by
  /// coordinate: per cycle if periodic, else on average per forcing period. Zero if that is below `tolerance`; empty if
  /// there is no such translation.
  std::vector<double> drift;
  State state;  ///< on the attractor, at phase 0 of a period or anywhere without a drive: needs no transient
};

/// The label of a motion: of a cycle (n > 0) "1-1-II", "2-inf-I", without a drive "free-1-I"; else the attractor's
/// name.
std::string class_label(Attractor attractor, int n, long p, bool sticking, Chatter chatter, bool driven);

/// Classifies the motion that starts at `state` at phase 0.
/// @throws InputError for a state that the stops forbid; NumericalError as Motion::advance
Classification classify(const System& system, const State& state, const ClassifyOptions& options = {});

/// The same within this many periods, half of them transient: names a cycle if Newton's method confirms it there, else
/// says undecided. Where both decide they agree. Throws as classify.
Classification classify_quickly(const System& system, const State& state, int periods, ClassifyOptions options = {});

}  // namespace slapstick
