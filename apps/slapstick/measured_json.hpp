#pragma once
/// Statistics as JSON: what `measure`, `orbit` and `classify` write of `--of`.
#include <vector>

#include "io/json.hpp"
#include "slapstick/orbit/periodic_orbit.hpp"
#include "span_options.hpp"

namespace slapstick::app {

/// The quantities of a wish, in its order.
[[nodiscard]] std::vector<Quantity> quantities_of(const std::vector<Wanted>& wanted);

/// {"Q:STAT": number, ..}: of each quantity the statistic that is wanted, or all that are usual.
[[nodiscard]] Json values_json(const std::vector<Wanted>& wanted, const Measured& found);
/// The same of the cycle of an orbit, stable or not. @throws NumericalError as measure
[[nodiscard]] Json values_json(const std::vector<Wanted>& wanted, const orbit::Problem& problem,
                               const orbit::Orbit& orbit);

/// The derivatives of what is measured on a cycle by parameters or groups (--sensitivity).
struct Sensitivity {
  std::vector<std::string> parameters;
  std::vector<Measured> rates;
};
/// Declares --sensitivity. @throws InputError naming it, as measure_rates
void declare_sensitivity(Arguments& arguments, std::vector<std::string>& names);
[[nodiscard]] Sensitivity sensitivity_of(const std::vector<std::string>& names, const ChosenModel& chosen,
                                         const orbit::Orbit& cycle, const std::vector<Wanted>& wanted);
/// {NAME: {"time": d duration, "values": {"Q:STAT": ..}, "impacts": {STOP: {"w": {"mean": ..}, ..}}}, ..}
[[nodiscard]] Json sensitivity_json(const std::vector<Wanted>& wanted, const Measured& found,
                                    const Sensitivity& sensitivity);

/// {"Q": unit, ..}
[[nodiscard]] Json units_json(const std::vector<Wanted>& wanted);

/// Of every stop the number of impacts, their rate, and statistics of speed, impulse and energy.
/// @param bins  of their histograms; 0: none
[[nodiscard]] Json impact_statistics_json(const Measured& found, int bins);

/// {"edges": [..], "counts": [..]}: `bins` equal bins from the least value to the greatest; each has its lower edge,
/// the last one both. One bin if all values are equal.
[[nodiscard]] Json histogram_json(const Statistics& of, int bins);

}  // namespace slapstick::app
