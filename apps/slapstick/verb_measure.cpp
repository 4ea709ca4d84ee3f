/// slapstick measure MODEL
#include "measured_json.hpp"
#include "output.hpp"
#include "slapstick/base/error.hpp"
#include "span_options.hpp"

namespace slapstick::app {
namespace {

constexpr long long periods_without_cycle = 1000;

struct Options {
  SpanOptions span;
  std::vector<std::string> sensitivity;
  long long bins = 0;
};

int run(const Options& all, const Context& context) {
  const SpanOptions& options = all.span;
  FileRoles roles;
  roles.add("MODEL", options.model.source);
  roles.add("--out", options.out);
  options.check();
  if (!all.sensitivity.empty() && (options.periods > 0 || options.time > 0.0))
    throw InputError(std::string("--sensitivity: only for a cycle, and ") +
                     (options.periods > 0 ? "--periods" : "--time") + " measures over a time");
  const ChosenModel chosen = options.model.load();
  const std::vector<Wanted> wanted = parse_wanted("--of", options.of, quantities(chosen.definition, chosen.overrides));
  Output out(options.out);
  Progress progress("periods", options.whole(chosen, periods_without_cycle), options.progress);
  const auto span = options.span(chosen, periods_without_cycle, context, &progress);
  if (!span) return interrupted;
  for (const Wanted& one : wanted)
    if (!span->cycle && !one.statistic.empty()) check_of_stretch("--of", one);
  const Measured found =
      measure(*span, quantities_of(wanted), &context.stop, [&](double now) { progress.update(now); });
  if (!(found.duration > 0.0)) return interrupted;  // Ctrl-C before anything was measured
  if (!all.sensitivity.empty() && !span->cycle)
    throw InputError(
        "--sensitivity: only for a cycle, and the motion settles on none, or on one of a family, which has no "
        "derivative; --orbit 1-1 chooses another");
  const Sensitivity rates =
      span->cycle ? sensitivity_of(all.sensitivity, chosen, span->cycle->orbit, wanted) : Sensitivity{};
  Json json = Json::object(), parameters = Json::object();
  for (const auto& [name, value] : chosen.definition.values(chosen.overrides)) parameters.set(name, value);
  json.set("model", chosen.model.name).set("parameters", std::move(parameters));
  json.set("complete", found.complete);
  json.set("over", span_json(*span).set("time", found.duration)).set("values", values_json(wanted, found));
  json.set("units", units_json(wanted));
  if (!all.sensitivity.empty()) json.set("sensitivity", sensitivity_json(wanted, found, rates));
  if (!found.stops.empty()) json.set("impacts", impact_statistics_json(found, static_cast<int>(all.bins)));
  out.write(json.dump() + "\n");
  out.commit();
  return found.complete ? done : interrupted;
}

}  // namespace

Action add_measure(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  options->span.declare(arguments);
  arguments
      .text("--of", options->span.of, "Q[:STAT],..",
            "quantities, and of each one statistic or all: mean, rms, min, max, min_at, max_at, peak_to_peak, "
            "crest, impulse, number; of a cycle h1 .. h16, h1:phase ..")
      .required();
  arguments.count("--bins", options->bins, 1, 100'000, "histograms of the impacts of every stop, with N bins (none)");
  declare_sensitivity(arguments, options->sensitivity);
  arguments.footer(
      "Statistics without sampling: integrals and extremes of the closed forms. Over the cycle that the motion settles "
      "on,\n"
      "or over --periods after the transient (1000 where there is no cycle). 'slapstick quantities MODEL' lists "
      "names.\n"
      "With --orbit, --stable, --unstable, --symmetric or --nearest over the periodic orbit that they say, as of "
      "`orbit`.\n"
      "  slapstick measure vibro-impact --set omega=2.9 --of F_stop:mean,a1,power_in:mean");
  return [options](const Context& context) { return run(*options, context); };
}

}  // namespace slapstick::app
