/// slapstick measure MODEL
#include <algorithm>

#include "output.hpp"
#include "slapstick/base/error.hpp"
#include "span_options.hpp"

namespace slapstick::app {
namespace {

constexpr long long periods_without_cycle = 1000;

Json impacts_json(const Measured& found) {
  Json stops = Json::object();
  for (const StopStatistics& stop : found.stops) {
    Json one = Json::object();
    const auto count = static_cast<double>(stop.w.values.size());
    one.set("number", static_cast<long>(stop.w.values.size())).set("rate", count / found.duration);
    for (const auto& [key, of] : {std::pair("w", &stop.w), std::pair("impulse", &stop.impulse), std::pair("energy_lost", &stop.loss)}) {
      Json values = Json::object();
      for (const char* name : {"mean", "rms", "min", "q05", "q25", "q50", "q75", "q95", "max"}) values.set(name, statistic(*of, name));
      one.set(key, std::move(values));
    }
    stops.set(stop.stop, std::move(one));
  }
  return stops;
}

Json values_json(const std::vector<Wanted>& wanted, const Measured& found) {
  Json values = Json::object();
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const auto names = wanted[k].statistic.empty() ? usual_statistics(wanted[k].quantity) : std::vector{wanted[k].statistic};
    for (const std::string& name : names) values.set(wanted[k].quantity.name + ":" + name, statistic(found.of[k], name));
  }
  return values;
}

int run(const SpanOptions& options, const Context& context) {
  FileRoles roles;
  roles.add("MODEL", options.model.source);
  roles.add("--out", options.out);
  options.check();
  const ChosenModel chosen = options.model.load();
  const std::vector<Wanted> wanted = parse_wanted("--of", options.of, quantities(chosen.definition, chosen.overrides));
  Output out(options.out);
  const auto span = options.span(chosen, periods_without_cycle, context);
  if (!span) return interrupted;
  std::vector<Quantity> of;
  for (const Wanted& one : wanted) of.push_back(one.quantity);
  const Measured found = measure(*span, of, &context.stop);
  if (!found.complete) return interrupted;
  Json json = Json::object(), parameters = Json::object(), units = Json::object();
  for (const auto& [name, value] : chosen.definition.values(chosen.overrides)) parameters.set(name, value);
  for (const Quantity& one : of) units.set(one.name, one.unit);
  json.set("model", chosen.model.name).set("parameters", std::move(parameters));
  json.set("over", span_json(*span).set("time", found.duration)).set("values", values_json(wanted, found));
  json.set("units", std::move(units));
  if (!found.stops.empty()) json.set("impacts", impacts_json(found));
  out.write(json.dump() + "\n");
  out.commit();
  return done;
}

}  // namespace

Action add_measure(Arguments& arguments) {
  auto options = std::make_shared<SpanOptions>();
  options->declare(arguments);
  arguments.text("--of", options->of, "Q[:STAT],..",
                 "quantities, and of each one statistic or all: mean, rms, min, max, min_at, max_at, peak_to_peak, "
                 "crest, impulse, number");
  arguments.footer(
      "Statistics without sampling: integrals and extremes of the closed forms. Over the cycle that the motion settles "
      "on,\n"
      "or over --periods after the transient (1000 where there is no cycle). 'slapstick quantities MODEL' lists names.\n"
      "  slapstick measure vibro-impact --set omega=2.9 --of F_stop:mean,a1,power_in:mean");
  return [options](const Context& context) { return run(*options, context); };
}

}  // namespace slapstick::app
