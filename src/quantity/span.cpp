/// Finds the cycle or the motion that is measured.
#include "slapstick/quantity/span.hpp"

#include <cmath>

#include "base/text.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/stage.hpp"
#include "slapstick/orbit/search.hpp"

namespace slapstick {

std::optional<Span> find_span(const ModelDefinition& definition, const Overrides& overrides, const System& system,
                              const State& start, const SpanWish& wish) {
  Span span;
  if (wish.periods == 0.0 && system.model().periodic()) {
    span.problem = orbit::pose(definition.family({}, overrides), {});
    orbit::SettleOptions settling;
    settling.transient = wish.transient;
    settling.stop = wish.stop;
    orbit::Settled settled = orbit::settle(*span.problem, system, start, settling);
    if (settled.end == orbit::SettleEnd::stopped) return std::nullopt;
    span.cycle = std::move(settled.orbit);
    if (span.cycle) return span;
  }
  span.motion.emplace(system, start);
  if (!run_to(*span.motion, Instant{wish.transient, 0.0}, wish.stop, [&] {
        if (wish.progress) wish.progress(span.motion->time().since({}));
      }))
    return std::nullopt;
  span.end = span.motion->time().plus(wish.periods > 0.0 ? wish.periods : wish.instead);
  return span;
}

Measured measure(const Span& span, const std::vector<Quantity>& of, const std::atomic<bool>* stop,
                 const std::function<void(double periods)>& progress) {
  return span.cycle ? measure(*span.problem, span.cycle->orbit, of) : measure(*span.motion, span.end, of, stop, progress);
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
    throw InputError("spectrum: a stretch of " + shown(options.stretch) + " forcing periods is longer than the motion, " +
                     shown(span.periods()));
  return density(*span.motion, of, options);
}

}  // namespace slapstick
