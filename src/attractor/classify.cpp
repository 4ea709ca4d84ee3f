/// Classifies motions: searches for a return, then judges by exponent and averages (docs/classify.md).
#include "slapstick/attractor/classify.hpp"

#include <cmath>

#include "attractor/exponent.hpp"
#include "section/settling.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {

std::string_view name(Attractor attractor) {
  constexpr std::string_view names[] = {"periodic", "quasi-periodic", "chaotic", "undecided"};
  return names[static_cast<int>(attractor)];
}

std::string_view name(Chatter chatter) {
  constexpr std::string_view names[] = {"none", "incomplete", "complete"};
  return names[static_cast<int>(chatter)];
}

namespace {

/// What the cycle holds.
void record(const section::Settling& settling, const section::Cycle& cycle, const ClassifyOptions& options,
            Classification& result) {
  const System& system = settling.translations().system();
  result.attractor = Attractor::periodic;
  result.approach = cycle.approach;
  attractor::record_cycle(system, settling.at_home(flow::user_state(system, cycle.x)), cycle.n, options.stops,
                          options.cancel, result);
  result.return_distance = cycle.return_distance;
  result.multipliers = cycle.multipliers;
  result.drift = settling.drift(cycle.advance);
  if (!cycle.multipliers.empty()) result.exponent = std::log(std::abs(cycle.multipliers.front())) / cycle.n;
}

void decide_aperiodic(const attractor::RunFigures& run, const ClassifyOptions& options, Classification& result) {
  result.exponent = run.exponent;
  result.exponent_error = run.exponent_error;
  result.digits = run.digits;
  result.sticking = run.events.sticks > 0 || run.events.chatters > 0;
  result.chatter = run.events.chatters > 0 ? Chatter::complete : run.burst ? Chatter::incomplete : Chatter::none;
  const bool positive = run.exponent > 3.0 * run.exponent_error && run.exponent > 0.005;
  if (positive && run.digits < options.curve_digits)
    result.attractor = Attractor::chaotic;
  else if (!positive && run.exponent > -0.005 && run.digits >= options.curve_digits)
    result.attractor = Attractor::quasi_periodic;
  else
    result.attractor = Attractor::undecided;
  result.label = name(result.attractor);
}

}  // namespace

Classification classify(const System& system, const State& state, const ClassifyOptions& options) {
  if (!system.model().forced())
    throw InputError("model '" + system.model().name +
                     "' has no periodic forcing: n-p classes count forcing periods; "
                     "`poincare --section event` shows its returns");
  Classification result;
  section::Settling settling(system, state,
                             {.most_periods = options.most_periods,
                              .most_n = options.most_n,
                              .tolerance = options.tolerance,
                              .newton_start = options.newton_start,
                              .stop = options.cancel,
                              .progress = options.progress});
  settling.discard(options.transient_periods);
  // Rounds of growing length: a clearly chaotic motion is recognised early, a slow approach gets its time.
  while (!settling.exhausted()) {
    const std::optional<section::Cycle> cycle = settling.next_round();
    if (cycle) record(settling, *cycle, options, result);
    if (cycle || settling.cancelled()) break;
    const bool last = settling.exhausted();
    const auto run = attractor::run_figures(settling.translations(), settling.state(),
                                            last ? options.exponent_periods : options.exponent_periods / 4,
                                            options.stops, options.cancel);
    if (settling.cancelled()) break;
    decide_aperiodic(run, options, result);
    if (result.attractor == Attractor::quasi_periodic && settling.still_approaching()) {
      result.attractor = Attractor::undecided;
      result.label = name(result.attractor);
    }
    result.state = settling.at_home(run.state);
    result.drift = settling.drift(run.advance);
    const bool clear =
        result.attractor == Attractor::chaotic && run.exponent > 10.0 * run.exponent_error && run.exponent > 0.02;
    if (clear || last) break;
    result = {};
  }
  result.periods_used = settling.periods();
  result.interrupted = settling.cancelled();
  return result;
}

}  // namespace slapstick
