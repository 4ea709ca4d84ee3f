/// Takes the lines of a quantity at each value of a run-up.
#include "slapstick/quantity/order_map.hpp"

#include <cmath>

#include "base/text.hpp"
#include "flow/compiled_system.hpp"
#include "quantity/fourier.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/stage.hpp"

namespace slapstick {
namespace {

void check(long hold, const Quantity& of, const OrderMapOptions& options) {
  if (of.at_impacts()) throw InputError("order map: " + in_quotes(of.name) + " is a quantity at impacts, not of time");
  if (!(options.highest_order > 0.0))
    throw InputError("order map: the highest order " + shown(options.highest_order) + " is not positive");
  if (options.settle < 0 || options.settle >= hold)
    throw InputError("order map: settle = " + std::to_string(options.settle) + " is outside [0, " +
                     std::to_string(hold) + "), the periods at each value");
}

}  // namespace

OrderMap order_map(RunUp& run, const Quantity& of, const OrderMapOptions& options) {
  const auto hold = static_cast<long>(run.end().period);
  check(hold, of, options);
  const auto measured = static_cast<double>(hold - options.settle);
  OrderMap map;
  for (double k = 0.0; k <= options.highest_order * measured; ++k) map.order.push_back(k / measured);
  const std::vector<Quantity> one = {of};
  while (run.next()) {
    Motion& motion = run.motion();
    const System& system = motion.system();
    const double begin = run.time({});
    map.complete = run_to(motion, Instant{options.settle, 0.0}, options.stop, [] {});
    const double T = measured * system.period();
    quantity::Fourier fourier(T, map.order.size());
    quantity::Tracer tracer(system.model(), system.compiled().frame(), {system.period(), 0.0}, one, fourier);
    map.complete = map.complete && quantity::trace(motion, run.end(), tracer, options.stop);
    if (!map.complete) break;
    for (const std::complex<double>& sum : fourier.take())
      map.amplitude.push_back((map.amplitude.size() % map.order.size() == 0 ? 1.0 : 2.0) * std::abs(sum) / T);
    map.value.push_back(run.value());
    map.time.push_back(begin);
    map.period.push_back(system.period());
    if (options.progress) options.progress(static_cast<long>(map.value.size()));
  }
  return map;
}

}  // namespace slapstick
