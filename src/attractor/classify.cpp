/// Classifies motions: searches for a return, then judges by exponent and averages (docs/explanation/classify.md).
#include "slapstick/attractor/classify.hpp"

#include <cmath>

#include "attractor/exponent.hpp"
#include "base/ranges.hpp"
#include "flow/contact_state.hpp"
#include "section/flights.hpp"
#include "section/outlook.hpp"
#include "section/settling.hpp"

namespace slapstick {

std::string_view name(Attractor attractor) {
  constexpr std::string_view names[] = {"periodic",        "quasi-periodic", "chaotic",
                                        "one of a family", "undecided",      "equilibrium"};
  return names[static_cast<int>(attractor)];
}

std::string_view name(Doubt doubt) {
  constexpr std::string_view names[] = {"none",     "not confirmed", "approach", "long cycle",
                                        "exponent", "no return",     "growth"};
  return names[static_cast<int>(doubt)];
}

std::string_view option_that_decides(Doubt doubt) {
  constexpr std::string_view options[] = {"", "full", "transient", "most_n", "exponent_periods", "", ""};
  return options[static_cast<int>(doubt)];
}

std::string_view name(Chatter chatter) {
  constexpr std::string_view names[] = {"none", "incomplete", "complete"};
  return names[static_cast<int>(chatter)];
}

std::string class_label(Attractor attractor, int n, long p, bool sticking, Chatter chatter, bool driven) {
  if (n == 0) return std::string(name(attractor));
  const std::string impacts = chatter == Chatter::complete ? "inf" : std::to_string(p);
  return (driven ? std::to_string(n) : "free") + "-" + impacts + (sticking ? "-II" : "-I");
}

namespace {

/// ln N / N: the exponent that a tangent shows which grows no faster than the time, as on every curve of a family.
double growth_without_exponent(int periods) { return std::log(static_cast<double>(periods)) / periods; }

/// Does a motion lose energy? A stop takes some where it is struck.
bool dissipates(const Model& model, const section::PeriodEvents& events) {
  const auto acts = [](double coefficient) { return coefficient != 0.0; };
  return !model.damping.empty() || ranges::any_of(model.dampers, acts, &Damper::coefficient) ||
         ranges::any_of(model.frictions, acts, &FrictionContact::static_friction) ||
         (events.impacts > 0 &&
          ranges::any_of(model.stops,
                         [](const Stop& stop) { return stop.restitution != 1.0 || !stop.corners.empty(); })) ||
         ranges::any_of(model.compliant_stops, acts, &CompliantStop::damping) ||
         ranges::any_of(model.characteristics,
                        [](const Characteristic& one_of) { return one_of.over != Characteristic::Over::displacement; });
}

struct Finding {
  Attractor attractor;
  Doubt doubt;
};

/// @param returns  of the run
Finding finding(const attractor::RunFigures& run, int returns, bool approaching, const ClassifyOptions& options) {
  const double nothing = growth_without_exponent(returns), uncertain = 3.0 * run.exponent_error;
  const bool smooth = run.digits >= options.curve_digits;
  if (run.exponent - uncertain > nothing) {
    if (!smooth) return {Attractor::chaotic, Doubt::none};
    return {Attractor::undecided, Doubt::exponent};
  }
  // Every difference is forgotten, so nothing approaches.
  if (run.exponent == -INFINITY) return {Attractor::undecided, Doubt::long_cycle};
  if (approaching) return {Attractor::undecided, Doubt::approach};
  if (run.exponent + uncertain < -nothing) return {Attractor::undecided, smooth ? Doubt::long_cycle : Doubt::approach};
  if (!smooth || run.rotation.digits < options.curve_digits) return {Attractor::undecided, Doubt::exponent};
  if (run.rotation.locked > 0) return {Attractor::undecided, Doubt::long_cycle};
  return {Attractor::quasi_periodic, Doubt::none};
}

void record(const attractor::RunFigures& run, const Finding& found, const System& system, Classification& result) {
  result.exponent = run.exponent / run.mean_return;
  result.exponent_error = run.exponent_error / run.mean_return;
  result.digits = run.digits;
  result.sticking = run.events.sticks > 0 || run.events.chatters > 0;
  result.chatter = run.events.chatters > 0 ? Chatter::complete : run.burst ? Chatter::incomplete : Chatter::none;
  result.doubt = found.doubt;
  result.attractor = found.attractor;
  if (found.attractor == Attractor::quasi_periodic) {
    result.rotation = run.rotation.number;
    result.rotation_digits = run.rotation.digits;
    result.curves = run.rotation.curves;
    if (!dissipates(system.model(), run.events)) result.attractor = Attractor::family;
  }
  result.label = name(result.attractor);
}

}  // namespace

namespace {

Classification undecided(Doubt doubt, const section::Settling& settling) {
  Classification result;
  result.doubt = doubt;
  result.label = name(result.attractor);
  result.state = settling.moved_to_start_cell(settling.state());
  return result;
}

/// What a motion is that comes to no cycle, by exponent, averages and rotation number of a further run.
Classification without_cycle(const section::Settling& settling, const System& system, const ClassifyOptions& options) {
  Classification result;
  if (options.exponent_periods == 0) return undecided(Doubt::not_confirmed, settling);
  const int returns = options.exponent_periods;
  const auto run = attractor::run_figures(settling.map(), settling.state(), returns, options.stops, options.cancel);
  if (settling.cancelled()) return result;
  if (run.ended) return undecided(Doubt::approach, settling);
  record(run, finding(run, returns, settling.still_approaching(), options), system, result);
  result.state = settling.moved_to_start_cell(run.state);
  result.drift = settling.drift(run.advance / run.mean_return);
  return result;
}

/// Of a rest modulo translations, per period, by coordinate.
/// @param least  a speed that cannot be told from none
std::vector<double> steady_drift(const section::Settling& settling, const section::Outlook& ahead, double least) {
  const flow::Translations& translations = settling.translations();
  std::vector<double> by_coordinate = translations.by_coordinate(translations.system().period() * ahead.rate);
  for (double& length : by_coordinate)
    if (std::abs(length) <= least * translations.system().period()) length = 0.0;
  return by_coordinate;
}

/// What a motion is that has no more events: at rest, or on its way there; round a state of rest; or away for ever.
Classification without_events(const section::Settling& settling, const System& system, const ClassifyOptions& options) {
  if (const auto& border = settling.shrinks_to()) {
    Classification result;
    result.attractor = Attractor::equilibrium;
    result.label = name(result.attractor);
    result.approach = settling.distance_from(*border);
    result.state = settling.moved_to_start_cell(flow::user_state(system, *border));
    return result;
  }
  const section::Outlook ahead = section::outlook(settling.translations(), settling.motion());
  if (ahead.no_event && (ahead.goes_away || ahead.grows)) return undecided(Doubt::growth, settling);
  if (!ahead.no_event || !(ahead.drawn || ahead.neutral)) return undecided(Doubt::no_return, settling);
  const Eigen::VectorXd scale = settling.scale_with(ahead.rest.cwiseAbs() + ahead.amplitude);
  Classification result;
  result.attractor = ahead.drawn ? Attractor::equilibrium : Attractor::family;
  result.label = name(result.attractor);
  result.eigenvalues = ahead.eigenvalues;
  result.family = ahead.family;
  result.sticking = mode::rests(system.states(settling.motion().mode_id()));
  result.sticking_fraction = result.sticking ? 1.0 : 0.0;
  result.approach = section::distance(ahead.here, ahead.rest, scale);
  const double largest = ahead.eigenvalues.empty() ? -INFINITY : ahead.eigenvalues.front().real();
  result.exponent = ahead.family > 0 ? 0.0 : largest * system.period();
  result.drift = steady_drift(settling, ahead, options.tolerance * scale[scale.size() - 1]);
  result.state = settling.moved_to_start_cell(ahead.drawn ? flow::user_state(system, ahead.rest) : settling.state());
  return result;
}

}  // namespace

Classification classify(const System& system, const State& state, const ClassifyOptions& options) {
  demand_period(system.model());
  Classification result;
  section::Settling settling(system, state,
                             {.most_periods = options.most_periods,
                              .most_n = options.most_n,
                              .tolerance = options.tolerance,
                              .newton_start = options.newton_start,
                              .stop = options.cancel,
                              .progress = options.progress});
  settling.discard(options.transient_periods);
  // However chaotic a motion looks, the whole search goes before: a chaotic transient ends in a cycle.
  std::optional<section::Cycle> cycle;
  while (!cycle && !settling.exhausted() && !settling.cancelled()) cycle = settling.next_round();
  if (cycle) {
    attractor::describe(system, *cycle, settling.moved_to_start_cell(flow::user_state(system, cycle->x)), options,
                        result);
    result.drift = settling.drift(cycle->advance);
  }
  if (!cycle && settling.grows())
    result = undecided(Doubt::growth, settling);
  else if (!cycle && !settling.cancelled())
    result = settling.ended() ? without_events(settling, system, options) : without_cycle(settling, system, options);
  result.periods_used = settling.periods();
  result.interrupted = settling.cancelled();
  return result;
}

Classification classify_quickly(const System& system, const State& state, int periods, ClassifyOptions options) {
  options.transient_periods = periods / 2;
  options.most_periods = periods - options.transient_periods;
  options.exponent_periods = 0;
  return classify(system, state, options);
}

}  // namespace slapstick
