#pragma once
/// Spectra over a run-up: an order map, or waterfall.
///
///     RunUp run(..);
///     const OrderMap map = order_map(run, quantity, {});
///
/// At each value of the parameter the motion is one in constant conditions for whole forcing periods, and
///
///     c = 1/T integral f(t) exp(-i order omega t) dt   over the T of the step that is measured
///
/// is an exact integral, impulses included. Orders are multiples of 1 / (periods that are measured). Where the motion
/// has settled on a cycle of n periods, n a divisor of these, c is the cycle's line (quantity/spectrum.hpp). What
/// happens on the way from the last value to this one leaks into the neighbours of a line.
/// Cost: as spectrum, and a System for each value. Threads: as a Motion's. Source: docs/reference/measure.md.
#include <atomic>
#include <functional>
#include <vector>

#include "slapstick/flow/run_up.hpp"
#include "slapstick/model/quantity.hpp"

namespace slapstick {

struct OrderMapOptions {
  double highest_order = 20.0;
  long settle = 0;  ///< forcing periods at the beginning of each value that are not measured; less than hold
  const std::atomic<bool>* stop = nullptr;
  std::function<void(long steps)> progress = {};
};

struct OrderMap {
  std::vector<double> value, time, period;  ///< of each step: of the parameter, at its begin, of the forcing
  std::vector<double> order;                ///< of each line
  std::vector<double> amplitude;            ///< step by step: value.size() * order.size() numbers
  bool complete = true;                     ///< false: stopped; the steps are those that were finished
};

/// The run is followed to its end.
/// @throws InputError for a quantity at impacts, an order that is not positive, or a settle of hold or more periods;
/// NumericalError as Motion::advance
[[nodiscard]] OrderMap order_map(RunUp& run, const Quantity& of, const OrderMapOptions& options);

}  // namespace slapstick
