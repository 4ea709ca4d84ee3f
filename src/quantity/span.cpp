/// Finds the cycle or the motion that is measured.
#include "slapstick/quantity/span.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/stage.hpp"
#include "slapstick/orbit/search.hpp"

namespace slapstick {

std::optional<Record> record_of(const Model& model) {
  std::optional<Record> record;
  for (const Force& force : model.forces) {
    if (force.signal < 0) continue;
    const Signal& signal = model.signals[static_cast<std::size_t>(force.signal)];
    if (signal.repeats) continue;
    const double begin = std::max(0.0, signal.knots.front().time), end = signal.knots.back().time;
    if (!record) record = Record{begin, end, signal.name};
    record->begin = std::min(record->begin, begin);
    if (end > record->end) record->end = end, record->signal = signal.name;
  }
  if (!record) return record;
  record->begin /= model.forcing_period();
  record->end /= model.forcing_period();
  return record;
}

Stretch stretch_of(const Model& model, std::optional<double> transient, double periods, double instead) {
  constexpr double usual = 500.0;
  if (transient && !(*transient >= 0.0)) throw InputError("transient: " + shown(*transient) + " is negative");
  const auto record = record_of(model);
  Stretch stretch{transient.value_or(record ? record->begin : usual), periods};
  if (periods > 0.0) return stretch;
  stretch.periods = record ? record->end - stretch.transient : instead;
  if (!(stretch.periods > 0.0))
    throw InputError("transient: " + shown(stretch.transient) + " leaves nothing of the record: signal " +
                     in_quotes(record->signal) + " ends after " + shown(record->end) +
                     (model.forced() ? " forcing periods" : " units of time") +
                     "; choose a shorter transient, or say how long to look");
  return stretch;
}

std::optional<Span> find_span(const ModelDefinition& definition, const Overrides& overrides, const System& system,
                              const State& start, const SpanWish& wish) {
  Span span;
  const Stretch stretch = stretch_of(system.model(), wish.transient, wish.periods, wish.instead);
  if (wish.periods == 0.0 && system.model().periodic()) {
    span.problem = orbit::pose(definition.family({}, overrides), {});
    orbit::SettleOptions settling;
    settling.transient = static_cast<long>(std::ceil(stretch.transient));
    settling.stop = wish.stop;
    orbit::Settled settled = orbit::settle(*span.problem, system, start, settling);
    if (settled.end == orbit::SettleEnd::stopped) return std::nullopt;
    span.cycle = std::move(settled.orbit);
    if (span.cycle) return span;
  }
  span.motion.emplace(system, start);
  if (!run_to(*span.motion, Instant{}.plus(stretch.transient), wish.stop, [&] {
        if (wish.progress) wish.progress(span.motion->time().since({}));
      }))
    return std::nullopt;
  span.end = span.motion->time().plus(stretch.periods);
  return span;
}

Measured measure(const Span& span, const std::vector<Quantity>& of, const std::atomic<bool>* stop,
                 const std::function<void(double periods)>& progress) {
  return span.cycle ? measure(*span.problem, span.cycle->orbit, of)
                    : measure(*span.motion, span.end, of, stop, progress);
}

std::vector<Measured> measure_rates(const ModelDefinition& definition, const Overrides& overrides,
                                    const std::vector<std::string>& parameters, orbit::Orbit cycle,
                                    const std::vector<Quantity>& of) {
  cycle.values.clear();
  for (const std::string& name : parameters) cycle.values.push_back(definition.present_value(name, overrides));
  const auto problem = orbit::pose(definition.family(parameters, overrides), cycle.values);
  return measure_rates(*problem, cycle, of);
}

DensitySpectrum density(const Span& span, const Quantity& of, DensityOptions options) {
  options.stretches = static_cast<int>(std::floor(2.0 * span.periods() / options.stretch)) - 1;
  if (options.stretches < 1)
    throw InputError("spectrum: a stretch of " + shown(options.stretch) +
                     " forcing periods is longer than the motion, " + shown(span.periods()) + ": choose a shorter one");
  return density(*span.motion, of, options);
}

}  // namespace slapstick
