/// Writes statistics as JSON.
#include "measured_json.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "slapstick/base/error.hpp"

namespace slapstick::app {
namespace {

constexpr std::array<std::pair<const char*, Statistics StopStatistics::*>, 3> impact_keys = {
    {{"w", &StopStatistics::w}, {"impulse", &StopStatistics::impulse}, {"energy_lost", &StopStatistics::loss}}};
constexpr std::array impact_names = {"mean", "rms", "min", "q05", "q25", "q50", "q75", "q95", "max"};

}  // namespace

std::vector<Quantity> quantities_of(const std::vector<Wanted>& wanted) {
  std::vector<Quantity> of;
  for (const Wanted& one : wanted) of.push_back(one.quantity);
  return of;
}

/// {"Q:STAT": of(k, STAT), ..}
template <class Of>
static Json by_statistic(const std::vector<Wanted>& wanted, const Of& of) {
  Json values = Json::object();
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const auto names =
        wanted[k].statistic.empty() ? usual_statistics(wanted[k].quantity) : std::vector{wanted[k].statistic};
    for (const std::string& name : names) values.set(wanted[k].quantity.name + ":" + name, of(k, name));
  }
  return values;
}

Json values_json(const std::vector<Wanted>& wanted, const Measured& found) {
  return by_statistic(wanted, [&](std::size_t k, const std::string& name) { return statistic(found.of[k], name); });
}

Json values_json(const std::vector<Wanted>& wanted, const orbit::Problem& problem, const orbit::Orbit& orbit) {
  return values_json(wanted, measure(problem, orbit, quantities_of(wanted)));
}

void declare_sensitivity(Arguments& arguments, std::vector<std::string>& names) {
  arguments
      .repeated("--sensitivity", names, "NAME",
                "of a cycle: the exact derivative of every statistic by this parameter or group; repeatable")
      .with({"--of"});
}

Sensitivity sensitivity_of(const std::vector<std::string>& names, const ChosenModel& chosen, const orbit::Orbit& cycle,
                           const std::vector<Wanted>& wanted) {
  if (names.empty()) return {};
  try {
    return {names, measure_rates(chosen.definition, chosen.overrides, names, cycle, quantities_of(wanted))};
  } catch (const InputError& error) {
    throw InputError("--sensitivity: " + error.message());
  }
}

namespace {

/// The derivatives of the statistics that `impacts` has.
Json impact_rates_json(const Measured& found, const Measured& rate) {
  Json stops = Json::object();
  for (std::size_t i = 0; i < found.stops.size(); ++i) {
    Json one = Json::object();
    for (const auto& [key, of] : impact_keys) {
      if (found.stops[i].compliant && of != &StopStatistics::w) continue;
      Json values = Json::object();
      for (const char* name : impact_names)
        values.set(name, statistic_rate(found.stops[i].*of, rate.stops[i].*of, name));
      one.set(key, std::move(values));
    }
    stops.set(found.stops[i].stop, std::move(one));
  }
  return stops;
}

}  // namespace

Json sensitivity_json(const std::vector<Wanted>& wanted, const Measured& found, const Sensitivity& sensitivity) {
  Json json = Json::object();
  for (std::size_t j = 0; j < sensitivity.rates.size(); ++j) {
    const Measured& rate = sensitivity.rates[j];
    Json one = Json::object();
    one.set("time", rate.duration).set("values", by_statistic(wanted, [&](std::size_t k, const std::string& name) {
                                         return statistic_rate(found.of[k], rate.of[k], name);
                                       }));
    if (!found.stops.empty()) one.set("impacts", impact_rates_json(found, rate));
    json.set(sensitivity.parameters[j], std::move(one));
  }
  return json;
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
    edges.push_back(i == bins ? of.values.back()
                              : of.values.front() + (of.values.back() - of.values.front()) * i / bins);
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
    for (const auto& [key, of] : impact_keys) {
      if (stop.compliant && of != &StopStatistics::w) continue;
      Json values = Json::object();
      for (const char* name : impact_names) values.set(name, statistic(stop.*of, name));
      if (bins > 0) values.set("histogram", histogram_json(stop.*of, bins));
      one.set(key, std::move(values));
    }
    stops.set(stop.stop, std::move(one));
  }
  return stops;
}

}  // namespace slapstick::app
