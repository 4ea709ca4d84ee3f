#pragma once
/// `spectrum --sweep NAME=A:B --over PERIODS --hold K`: the lines of a quantity at each value of a run-up.
#include "run_up.hpp"
#include "slapstick/quantity/order_map.hpp"
#include "spectrum_figure.hpp"

namespace slapstick::app {

struct OrderMapWish {
  RunUpRange range;
  long long settle = 0;
  double highest_order = 20.0;
  std::string out, plot, plot_size;
  bool progress = false;
};

/// A table with a row for each value and order: the parameter, time, order, frequency, amplitude.
/// @returns the exit status @throws InputError naming the argument, NumericalError as order_map
int order_map_run(const OrderMapWish& wish, const ChosenModel& chosen, const State& start, const Quantity& of,
                  const SpectrumLabels& labels, const Context& context);

/// A waterfall: the spectrum of each value stands on a line at the height of the value.
[[nodiscard]] figure::Figure waterfall_figure(const OrderMap& map, const SpectrumLabels& labels,
                                              const std::string& parameter);

}  // namespace slapstick::app
