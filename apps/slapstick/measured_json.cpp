/// Writes statistics as JSON.
#include "measured_json.hpp"

#include <algorithm>
#include <utility>

namespace slapstick::app {

std::vector<Quantity> quantities_of(const std::vector<Wanted>& wanted) {
  std::vector<Quantity> of;
  for (const Wanted& one : wanted) of.push_back(one.quantity);
  return of;
}

Json values_json(const std::vector<Wanted>& wanted, const Measured& found) {
  Json values = Json::object();
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const auto names = wanted[k].statistic.empty() ? usual_statistics(wanted[k].quantity) : std::vector{wanted[k].statistic};
    for (const std::string& name : names) values.set(wanted[k].quantity.name + ":" + name, statistic(found.of[k], name));
  }
  return values;
}

Json values_json(const std::vector<Wanted>& wanted, const orbit::Problem& problem, const orbit::Orbit& orbit) {
  return values_json(wanted, measure(problem, orbit, quantities_of(wanted)));
}

Json units_json(const std::vector<Wanted>& wanted) {
  Json units = Json::object();
  for (const Wanted& one : wanted) units.set(one.quantity.name, one.quantity.unit);
  return units;
}

Json histogram_json(const Statistics& of, int bins) {
  std::vector<double> edges;
  Json counts = Json::list();
  const auto begin = of.values.begin(), end = of.values.end();
  if (of.values.empty()) bins = 0;
  if (bins > 0 && of.values.front() == of.values.back()) bins = 1;
  for (int i = 0; i <= bins && bins > 0; ++i)
    edges.push_back(i == bins ? of.values.back() : of.values.front() + (of.values.back() - of.values.front()) * i / bins);
  for (int i = 0; i < bins; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const auto to = i + 1 == bins ? end : std::lower_bound(begin, end, edges[at + 1]);
    counts.push(static_cast<long>(to - std::lower_bound(begin, end, edges[at])));
  }
  return Json::object().set("edges", Json::list(edges)).set("counts", std::move(counts));
}

Json impact_statistics_json(const Measured& found, int bins) {
  Json stops = Json::object();
  for (const StopStatistics& stop : found.stops) {
    Json one = Json::object();
    const auto count = static_cast<double>(stop.w.values.size());
    one.set("number", static_cast<long>(stop.w.values.size())).set("rate", count / found.duration);
    for (const auto& [key, of] : {std::pair("w", &stop.w), std::pair("impulse", &stop.impulse), std::pair("energy_lost", &stop.loss)}) {
      if (stop.compliant && of != &stop.w) continue;
      Json values = Json::object();
      for (const char* name : {"mean", "rms", "min", "q05", "q25", "q50", "q75", "q95", "max"}) values.set(name, statistic(*of, name));
      if (bins > 0) values.set("histogram", histogram_json(*of, bins));
      one.set(key, std::move(values));
    }
    stops.set(stop.stop, std::move(one));
  }
  return stops;
}

}  // namespace slapstick::app
