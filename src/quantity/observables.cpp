/// Reads the quantities that observables name, and then the observables.
#include "slapstick/quantity/observables.hpp"

namespace slapstick {

Observables::Observables(const System& system, Observer observer)
    : period_(system.period()), observer_(std::move(observer)), reader_(system, observer_.quantities()) {}

const std::vector<double>& Observables::within(const Motion& motion, const SampledMotion::Sample& sample) {
  const double time = sample.time.seconds(period_);
  if (observer_.quantities().empty()) return observer_.read(time, sample.state);
  return observer_.read(time, sample.state, reader_.within(motion, sample.within));
}

}  // namespace slapstick
