#pragma once
/// What is measured over: the cycle that a motion settles on, or the motion itself for a time.
///
///     const auto span = find_span(definition, {}, system, definition.start(), {});
///     const Measured found = measure(*span, {find_quantity(quantities(definition), "F_stop")});
///
/// Threads: a Span belongs to one thread at a time. Cost: the transient, and what `orbit::settle` takes for a cycle.
/// Source: docs/reference/measure.md.
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "slapstick/quantity/measure.hpp"
#include "slapstick/quantity/spectrum.hpp"

namespace slapstick {

/// The stretch of time in which the signals of a model change that do not repeat: from their first point to their last,
/// as far as a motion from t = 0 on has it, in forcing periods.
struct Record {
  double begin = 0.0, end = 0.0;  ///< end <= 0: it is over at the start
  std::string signal;             ///< that ends last
};
/// Nothing of a model without such signals.
[[nodiscard]] std::optional<Record> record_of(const Model& model);

/// What of a motion is looked at, in forcing periods.
struct Stretch {
  double transient = 0.0, periods = 0.0;
};
/// @param transient  nothing: 500, or what comes before the record
/// @param periods  0: what is left of the record, or `instead`
/// @throws InputError for a negative transient, and where nothing is left of the record
[[nodiscard]] Stretch stretch_of(const Model& model, std::optional<double> transient, double periods, double instead);

struct SpanWish {
  std::optional<double> transient = {};  ///< as stretch_of
  double periods = 0.0;                  ///< length of the motion in forcing periods; 0: the cycle, or the record ..
  double instead = 1000;                 ///< .. or, where there is neither, this many periods
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double periods)> progress = {};  ///< called during the transient
};

struct Span {
  std::shared_ptr<const orbit::Problem> problem;  ///< of the cycle ..
  std::optional<orbit::Solution> cycle;           ///< .. or none: then the motion
  std::optional<Motion> motion;                   ///< after the transient
  Instant end;                                    ///< of the motion

  /// Of the motion, in forcing periods.
  [[nodiscard]] double periods() const { return end.since(motion->time()); }
};

/// @param system  of the definition with these overrides
/// @returns nothing if it was stopped
/// @throws InputError and NumericalError as orbit::settle and Motion::advance do
[[nodiscard]] std::optional<Span> find_span(const ModelDefinition& definition, const Overrides& overrides,
                                            const System& system, const State& start, const SpanWish& wish);

/// Of the cycle or of the motion. @throws as the measures of these
[[nodiscard]] Measured measure(const Span& span, const std::vector<Quantity>& of,
                               const std::atomic<bool>* stop = nullptr,
                               const std::function<void(double periods)>& progress = {});

/// measure_rates of a cycle of a model by parameters or groups, at their present values.
/// @throws InputError for an unknown name, or a group whose members differ; as measure_rates
[[nodiscard]] std::vector<Measured> measure_rates(const ModelDefinition& definition, const Overrides& overrides,
                                                  const std::vector<std::string>& parameters, orbit::Orbit cycle,
                                                  const std::vector<Quantity>& of);

/// The density of the motion of a span, in as many stretches as fit.
/// @throws InputError if none fits, and as density of a motion
[[nodiscard]] DensitySpectrum density(const Span& span, const Quantity& of, DensityOptions options);

}  // namespace slapstick
