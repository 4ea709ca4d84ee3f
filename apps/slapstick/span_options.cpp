/// Finds the cycle or the motion that is measured.
#include "span_options.hpp"

#include <cmath>
#include <cstdio>

#include "base/text.hpp"
#include "slapstick/base/error.hpp"
#include "work.hpp"

namespace slapstick::app {

Json span_json(const Span& span) {
  Json json = Json::object();
  if (span.cycle) {
    json.set("kind", "cycle").set("class", span.cycle->label);
    if (span.cycle->orbit.shape.n > 0) json.set("n", span.cycle->orbit.shape.n);
    return json;
  }
  return json.set("kind", "motion").set("transient", span.motion->time().since({})).set("periods", span.periods());
}

void SpanOptions::declare(Arguments& arguments) {
  model.declare(arguments);
  model.declare_state(arguments);
  arguments.number("--transient", transient, "N", "forcing periods to leave out first (500; of a record none)",
                   {.least = 0.0, .most = 1e9});
  const std::vector<std::string> of_a_cycle = {"--orbit", "--stable", "--unstable", "--symmetric", "--nearest"};
  arguments.count("--periods", periods, 1, 1'000'000'000, "measure over N forcing periods instead of a cycle")
      .without({"--time"})
      .without(of_a_cycle);
  arguments.number("--time", time, "T", "the same by a time in the model's unit", not_negative).without(of_a_cycle);
  orbit.declare_choice(arguments);
  arguments.text("--out", out, "FILE", "write there instead of to standard output");
  arguments.flag("--progress", progress, "show progress even if standard error is not a terminal");
}

void SpanOptions::check() const {
  const bool begins = transient != not_given;
  if (begins && orbit.any() && transient != std::floor(transient))
    throw InputError("--transient: " + shown(transient) +
                     " is no whole number, and the search for an orbit counts periods");
}

Stretch SpanOptions::stretch(const ChosenModel& chosen, long long instead) const {
  const double length = time > 0.0 ? time / chosen.model.forcing_period() : static_cast<double>(periods);
  const auto begin = transient == not_given ? std::nullopt : std::optional(transient);
  try {
    return stretch_of(chosen.model, begin, length, static_cast<double>(instead));
  } catch (const InputError& error) {
    throw InputError("--" + error.message() + " (--periods, --time)");
  }
}

double SpanOptions::whole(const ChosenModel& chosen, long long instead) const {
  const Stretch looked = stretch(chosen, instead);
  return looked.transient + looked.periods;
}

namespace {

/// A length that was asked for may lie behind the record.
void say_end_of_record(const Model& model, const Stretch& looked) {
  const auto record = record_of(model);
  if (record && looked.transient >= record->end)
    std::fprintf(stderr, "slapstick: signal '%s' ends before what is measured, and keeps its last value\n",
                 record->signal.c_str());
}

}  // namespace

std::optional<Span> SpanOptions::span(const ChosenModel& chosen, long long instead, const Context& context,
                                      Progress* bar) const {
  const State start = model.start(chosen);
  const Stretch looked = stretch(chosen, instead);
  say_end_of_record(chosen.model, looked);
  SpanWish wish{looked.transient, static_cast<double>(periods), looked.periods, &context.stop, {}};
  if (bar != nullptr) wish.progress = [bar](double now) { bar->update(now); };
  if (time > 0.0) wish.periods = time / chosen.model.forcing_period();
  const System system =
      affordable_system(chosen, {looked.transient + looked.periods, time > 0.0 ? "--time" : "--periods"});
  if (!orbit.any()) return find_span(chosen.definition, chosen.overrides, system, start, wish);
  OrbitOptions meant = orbit;
  meant.transient = static_cast<long long>(looked.transient);
  Span span;
  span.problem = orbit::pose(chosen.definition.family({}, chosen.overrides), {});
  span.cycle = std::move(find_orbit(*span.problem, system, start, meant, context.stop).orbit);
  return span;
}

void check_of_stretch(const std::string& argument, const Wanted& one) {
  try {
    check_statistic_of_stretch(one.quantity, one.statistic);
  } catch (const InputError& error) {
    throw InputError(argument + ": " + error.message());
  }
}

std::vector<Wanted> parse_wanted(const std::string& argument, const std::string& text,
                                 const std::vector<Quantity>& all) {
  std::vector<Wanted> wanted;
  try {
    for (const std::string& word : split(text, ',')) {
      const auto parts = split(word, ':');
      if (parts[0].empty()) throw InputError(in_quotes(word) + " is not of the form Q or Q:STAT");
      wanted.push_back({find_quantity(all, parts[0]), parts.size() > 1 ? word.substr(parts[0].size() + 1) : ""});
      if (parts.size() > 1) check_statistic(wanted.back().quantity, wanted.back().statistic);
    }
  } catch (const InputError& error) {
    throw InputError(argument + ": " + error.message());
  }
  return wanted;
}

std::vector<Quantity> functions_of_time(const std::string& argument, const std::string& text,
                                        const ChosenModel& chosen) {
  std::vector<Quantity> of;
  if (text.empty()) return of;
  for (const Wanted& one : parse_wanted(argument, text, quantities(chosen.definition, chosen.overrides))) {
    const std::string& name = one.quantity.name;
    if (!one.statistic.empty())
      throw InputError(argument + ": " + in_quotes(name + ":" + one.statistic) + ": values are wanted, not statistics");
    if (one.quantity.at_impacts())
      throw InputError(argument + ": " + in_quotes(name) + " is a quantity at impacts: no function of time");
    of.push_back(one.quantity);
  }
  return of;
}

void declare_of(Arguments& arguments, std::string& of) {
  arguments.text("--of", of, "Q[:STAT],..", "statistics of quantities over the cycle, as `measure` gives them");
}

std::vector<Wanted> parse_of(const std::string& of, const ChosenModel& chosen) {
  return of.empty() ? std::vector<Wanted>{} : parse_wanted("--of", of, quantities(chosen.definition, chosen.overrides));
}

}  // namespace slapstick::app
