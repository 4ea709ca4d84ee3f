/// slapstick classify MODEL
#include <algorithm>
#include <cmath>

#include "io/json.hpp"
#include "measured_json.hpp"
#include "model_options.hpp"
#include "orbit_options.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "slapstick/attractor/classify.hpp"
#include "stop_options.hpp"
#include "verb.hpp"
#include "work.hpp"

namespace slapstick::app {
namespace {

struct Options {
  ModelOptions model;
  StopOptions stops;
  std::string of, out;
  long long transient = 500, most_periods = 20'000, most_n = 64, exponent_periods = 4000, quick = 0;
  bool progress = false;
};

/// As an option is written: "most_n" -> "most-n".
std::string dashed(std::string_view option) {
  std::string text(option);
  std::replace(text.begin(), text.end(), '_', '-');
  return text;
}

/// With several stops each impact says which one was hit.
Json impacts_json(const std::vector<CycleImpact>& impacts, const Model& model) {
  const auto names = state_names(model);
  Json list = Json::list();
  for (const CycleImpact& impact : impacts) {
    Json state = Json::object();
    for (std::size_t i = 0; i < names.size(); ++i) state.set(names[i], impact.state[i]);
    Json item = Json::object();
    item.set("phase", impact.phase).set("w", impact.w);
    if (several_stops(model)) item.set("contact", stop_name(model, impact.contact));
    item.set("state", std::move(state));
    list.push(std::move(item));
  }
  return list;
}

Json complex_json(const std::vector<std::complex<double>>& numbers) {
  Json list = Json::list();
  for (const auto& number : numbers) list.push(Json::list(std::vector<double>{number.real(), number.imag()}));
  return list;
}

bool has_derivative(const Classification& found) { return !std::isnan(found.exponent); }

Json cycle_json(const Classification& found, Json json, const Model& model) {
  json.set("n", found.n);
  json.set("p", found.chatter == Chatter::complete ? Json("inf") : Json(found.p));
  if (found.label.starts_with("free")) json.set("period", found.period);
  json.set("sticking_fraction", found.sticking_fraction)
      .set("multipliers", has_derivative(found) ? complex_json(found.multipliers) : Json());
  if (!has_derivative(found)) json.set("why_no_multipliers", no_derivative);
  json.set("return_distance", found.return_distance)
      .set("approach", found.approach)
      .set("impacts", impacts_json(found.impacts, model));
  return json;
}

bool is_cycle(const Classification& found) { return found.n > 0; }

/// At rest, or on a closed curve of the linear motion about a state of rest: known by eigenvalues.
bool is_at_rest(const Classification& found) {
  return found.attractor == Attractor::equilibrium || !found.eigenvalues.empty();
}

/// What is missing for a class, and the option that would decide.
std::string missing(const Classification& found, const Options& options) {
  const std::string option = dashed(option_that_decides(found.doubt));
  std::string decides = " (--" + option;
  if (option == "most-n") decides += ", now " + std::to_string(options.most_n);
  if (option == "most-periods") decides += ", now " + std::to_string(options.most_periods);
  if (option == "exponent-periods") decides += ", now " + std::to_string(options.exponent_periods);
  decides += ")";
  switch (found.doubt) {
    case Doubt::none:
      break;
    case Doubt::not_confirmed:
      return "Newton's method confirmed no cycle within --quick; without it more is looked at";
    case Doubt::approach:
      return "the motion still closes in on something: leave out or search more periods" + decides;
    case Doubt::long_cycle:
      return "the motion repeats itself, but not within the longest cycle that was sought" + decides;
    case Doubt::exponent:
      return "exponent, averages and rotation number do not agree on a kind: a longer run tells" + decides;
    case Doubt::no_return:
      return "the motion had no event for long, but one may come yet: nothing proves that the motion stays as it is";
    case Doubt::growth:
      return "the motion grows, or goes away, without bound: the model has no class from this start";
  }
  return {};
}

Json result_json(const Classification& found, const Options& options, const ChosenModel& chosen) {
  const auto names = state_names(chosen.model);
  Json parameters = Json::object(), state = Json::object(), json = Json::object();
  for (const auto& [name, value] : chosen.definition.values(chosen.overrides)) parameters.set(name, value);
  for (std::size_t i = 0; i < names.size(); ++i) state.set(names[i], found.state[i]);
  json.set("model", chosen.model.name).set("parameters", std::move(parameters));
  json.set("class", found.label).set("attractor", std::string(name(found.attractor)));
  json.set("sticking", found.sticking).set("chatter", std::string(name(found.chatter)));
  if (is_cycle(found)) json = cycle_json(found, std::move(json), chosen.model);
  if (found.family > 0) json.set("family", found.family);
  if (is_at_rest(found)) json.set("eigenvalues", complex_json(found.eigenvalues)).set("approach", found.approach);
  const bool averaged = !is_cycle(found) && !is_at_rest(found) && options.quick == 0 &&
                        found.doubt != Doubt::no_return && found.doubt != Doubt::growth;
  const bool rest_rate = is_at_rest(found) && (found.sticking || !found.eigenvalues.empty());
  if (averaged || is_cycle(found) || rest_rate)
    json.set("exponent", has_derivative(found) ? Json(found.exponent) : Json());
  if (averaged) json.set("exponent_error", found.exponent_error).set("birkhoff_digits", found.digits);
  if (found.curves > 0)
    json.set("rotation", found.rotation).set("rotation_digits", found.rotation_digits).set("curves", found.curves);
  if (found.doubt != Doubt::none)
    json.set("doubt", std::string(name(found.doubt))).set("missing", missing(found, options));
  if (!found.drift.empty()) {
    Json drift = Json::object();
    for (std::size_t i = 0; i < found.drift.size(); ++i) drift.set(chosen.model.coordinates[i].name, found.drift[i]);
    json.set("drift", std::move(drift));
  }
  json.set("periods_used", found.periods_used).set("state", std::move(state));
  return json;
}

/// --of: over the cycle, or where there is no cycle over 1000 periods of the attractor. @returns false if it was
/// stopped
bool add_values(const std::vector<Wanted>& wanted, const Classification& found, const ChosenModel& chosen,
                const System& system, const Context& context, Json& json) {
  SpanWish wish;
  wish.transient = 0;
  wish.stop = &context.stop;
  const auto span = find_span(chosen.definition, chosen.overrides, system, found.state, wish);
  if (!span) return false;
  const Measured measured = measure(*span, quantities_of(wanted), &context.stop);
  json.set("over", span_json(*span).set("time", measured.duration)).set("values", values_json(wanted, measured));
  json.set("units", units_json(wanted));
  return measured.complete;
}

void declare(Arguments& arguments, Options* options) {
  options->model.declare(arguments);
  options->model.declare_state(arguments);
  arguments.count("--transient", options->transient, 0, 1'000'000'000,
                  "forcing periods to leave out first (500); of a motion without a drive its returns");
  arguments.count("--most-periods", options->most_periods, 10, 1'000'000'000, "search for a cycle this long (20000)");
  arguments.count("--most-n", options->most_n, 1, 4096, "longest cycle sought, in forcing periods or returns (64)");
  arguments.count("--exponent-periods", options->exponent_periods, 400, 100'000'000,
                  "length of the run from which exponent, averages and rotation number are taken (4000)");
  arguments
      .count("--quick", options->quick, 20, 1'000'000'000,
             "look at N periods only, half of them transient: a cycle that Newton's method confirms, or "
             "undecided")
      .without({"--transient", "--most-periods", "--exponent-periods"});
  options->stops.declare(arguments, "count and list the impacts of this stop only; may be repeated (all)");
  declare_of(arguments, options->of);
  arguments.text("--out", options->out, "FILE", "write the JSON there instead of to standard output");
  arguments.flag("--progress", options->progress, "show progress even if standard error is not a terminal");
  arguments.footer(
      "The class n-p-I or n-p-II: n forcing periods, p impacts (inf with complete chatter), II if the blocks stick.\n"
      "A compliant stop counts by its engagements.\n"
      "Without a drive a motion comes to rest (equilibrium), or to a cycle free-p-I or free-p-II; periods are "
      "returns.\n"
      "A motion without a cycle is quasi-periodic, chaotic or undecided; docs/explanation/classify.md says how that is "
      "decided.\n"
      "  slapstick classify vibro-impact --set omega=1.5");
}

}  // namespace

Action add_classify(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  declare(arguments, options.get());
  return [options, &arguments](const Context& context) {
    FileRoles roles;
    roles.add("MODEL", options->model.source);
    roles.add("--out", options->out);
    Output out(options->out);
    const ChosenModel chosen = options->model.load();
    const StopChoice stops = options->stops.choice(chosen.model);
    const State start = options->model.start(chosen);
    const std::vector<Wanted> wanted = parse_of(options->of, chosen);
    constexpr double least_search = 10.0;  // periods
    const System system =
        affordable_system(chosen, {static_cast<double>(options->transient) + least_search, "--transient"});
    Progress progress("periods at most", static_cast<double>(options->transient + options->most_periods),
                      options->progress);
    const ClassifyOptions how{.transient_periods = static_cast<int>(options->transient),
                              .most_periods = static_cast<int>(options->most_periods),
                              .most_n = static_cast<int>(options->most_n),
                              .exponent_periods = static_cast<int>(options->exponent_periods),
                              .stops = stops,
                              .cancel = &context.stop,
                              .progress = [&](long periods) { progress.update(static_cast<double>(periods)); }};
    const Classification found = options->quick > 0
                                     ? classify_quickly(system, start, static_cast<int>(options->quick), how)
                                     : classify(system, start, how);
    if (found.interrupted) return interrupted;
    Json json = result_json(found, *options, chosen);
    if (!wanted.empty() && !add_values(wanted, found, chosen, system, context, json)) return interrupted;
    out.write(json.dump() + "\n");
    out.commit();
    return done;
  };
}

}  // namespace slapstick::app
