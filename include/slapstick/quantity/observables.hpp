#pragma once
/// The [[observable]]s of a model file at instants of a motion: those that name quantities too.
///
///     Observables observables(system, definition.observer());
///     while (sampled.next(end) == SampledMotion::Item::sample) use(observables.within(motion, sample));
///
/// Forces and accelerations are those of the mode that the instant is in, as Reader says.
/// Cost: some hundred nanoseconds an instant and expression. Threads: one at a time. Source: docs/reference/measure.md.
#include "slapstick/io/observer.hpp"
#include "slapstick/quantity/reader.hpp"
#include "slapstick/section/sampled_motion.hpp"

namespace slapstick {

class Observables {
 public:
  /// @param system  of the definition with the observer's values
  Observables(const System& system, Observer observer);

  /// At a sample of a motion, in the order of ModelDefinition::observables. Valid until the next call.
  [[nodiscard]] const std::vector<double>& within(const Motion& motion, const SampledMotion::Sample& sample);

 private:
  double period_;
  Observer observer_;
  Reader reader_;
};

}  // namespace slapstick
