/// slapstick lyapunov MODEL
#include <cmath>

#include "base/ranges.hpp"
#include "base/text.hpp"
#include "io/json.hpp"
#include "model_options.hpp"
#include "output.hpp"
#include "parameter_ranges.hpp"
#include "progress.hpp"
#include "slapstick/attractor/lyapunov.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/sweep/diagram.hpp"
#include "slapstick/sweep/parallel.hpp"
#include "verb.hpp"
#include "work.hpp"

namespace slapstick::app {
namespace {

struct Options {
  ModelOptions model;
  std::string sweep, out;
  double error = 0.0;
  long long transient = 500, periods = 20'000, threads = 0;
  bool progress = false;
};

LyapunovOptions how(const Options& options, const Context& context) {
  return {.transient_periods = static_cast<long>(options.transient),
          .most_periods = static_cast<long>(options.periods),
          .error = options.error,
          .cancel = &context.stop};
}

/// JSON has no infinity.
Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(value < 0.0 ? "-inf" : "inf"); }

Json list_json(const std::vector<double>& values) {
  Json list = Json::list();
  for (const double value : values) list.push(number_json(value));
  return list;
}

/// Per period -> per unit of time.
std::vector<double> per_time(std::vector<double> values, const LyapunovExponents& found) {
  for (double& value : values) value /= found.period;
  return values;
}

Json result_json(const LyapunovExponents& found, const ChosenModel& chosen) {
  Json json = Json::object(), parameters = Json::object();
  for (const auto& [name, value] : chosen.definition.values(chosen.overrides)) parameters.set(name, value);
  json.set("model", chosen.model.name).set("parameters", std::move(parameters));
  json.set("exponents", list_json(per_time(found.per_period, found)));
  json.set("errors", list_json(per_time(found.errors, found)));
  if (chosen.model.forced())
    json.set("exponents_per_period", list_json(found.per_period)).set("errors_per_period", list_json(found.errors));
  json.set("sum", number_json(found.sum / found.period));
  json.set("sum_by_contraction", number_json(found.contraction / found.period));
  return json.set("kaplan_yorke", found.dimension).set("periods", found.periods);
}

/// What is wrong with a result that was computed.
std::string complaint(const LyapunovExponents& found, const Options& options) {
  if (!found.sum_rule_holds())
    return "the sum rule fails: exponents " + shown(found.sum) + ", contraction " + shown(found.contraction) +
           " per period, rounding " + shown(found.rounding);
  if (!found.reached)
    return "an error is above --error " + shown(options.error) + " after " + std::to_string(found.periods) +
           " periods; more --periods";
  return {};
}

int one(const Options& options, const ChosenModel& chosen, const Context& context) {
  Output out(options.out);
  const State start = options.model.start(chosen);
  const Work work{static_cast<double>(options.transient + options.periods), "--periods"};
  const System system = affordable_system(chosen, work);
  Progress progress("periods at most", work.periods, options.progress);
  LyapunovOptions asked = how(options, context);
  asked.progress = [&](long periods) { progress.update(static_cast<double>(periods)); };
  const LyapunovExponents found = lyapunov(system, start, asked);
  if (found.interrupted) return interrupted;
  out.write(result_json(found, chosen).dump() + "\n");
  out.commit();
  if (const std::string why = complaint(found, options); !why.empty())
    throw NumericalError("lyapunov: " + why + "; the result is written");
  return done;
}

/// The exponents at one value of a sweep, or why there are none.
struct Row {
  double value = 0.0;
  LyapunovExponents found;
  std::string failure;
};

Row row_at(const Options& options, const ChosenModel& chosen, const Sweep& sweep, int index, const Context& context) {
  Row row;
  row.value = sweep::sweep_value(sweep.from, sweep.to, sweep.count, index);
  Overrides values = chosen.overrides;
  values[sweep.name] = row.value;
  try {
    const System system(chosen.definition.build(values));
    row.found = lyapunov(system, options.model.start(chosen, {{sweep.name, row.value}}), how(options, context));
    row.failure = complaint(row.found, options);
  } catch (const std::runtime_error& error) {
    row.failure = error.what();
  }
  return row;
}

bool has_exponents(const Row& row) { return !row.found.per_period.empty(); }

/// One row a value, all values that are there: each exponent per unit of time, the errors, the dimension.
void write_rows(const Options& options, const Sweep& sweep, const std::vector<Row>& rows) {
  const auto first = ranges::find_if(rows, has_exponents);
  if (first == rows.end()) return;
  std::vector<std::string> columns = {sweep.name};
  const std::size_t count = first->found.per_period.size();
  for (const char* kind : {"exponent", "error"})
    for (std::size_t i = 1; i <= count; ++i) columns.push_back(kind + std::to_string(i));
  columns.insert(columns.end(), {"kaplan_yorke", "periods"});
  TableOutput table(options.out, columns);
  for (const Row& row : rows) {
    if (!has_exponents(row)) continue;
    table.number(row.value).numbers(per_time(row.found.per_period, row.found));
    table.numbers(per_time(row.found.errors, row.found));
    table.number(row.found.dimension).number(static_cast<double>(row.found.periods));
    table.end_row();
  }
  table.commit();
}

int many(const Options& options, const ChosenModel& chosen, const Context& context) {
  const Sweep sweep = parse_sweep(options.sweep);
  if (chosen.overrides.contains(sweep.name))
    throw InputError("--sweep: " + in_quotes(sweep.name) + " is given by --set too");
  const Work work{static_cast<double>(options.transient + options.periods), "--periods"};
  for (const double value : {sweep.from, sweep.to})
    static_cast<void>(affordable_system(chosen, work, {{sweep.name, value}}));
  std::vector<Row> rows(static_cast<std::size_t>(sweep.count));
  Progress progress("values", sweep.count, options.progress);
  std::atomic<int> finished{0};
  const auto use = [&](int i) {
    rows[static_cast<std::size_t>(i)] = row_at(options, chosen, sweep, i, context);
    progress.update(++finished);
  };
  sweep::for_each_index(sweep.count, static_cast<int>(options.threads), use, &context.stop);
  std::erase_if(rows,
                [](const Row& row) { return row.found.interrupted || (!has_exponents(row) && row.failure.empty()); });
  write_rows(options, sweep, rows);
  const auto failed = ranges::count_if(rows, [](const Row& row) { return !row.failure.empty(); });
  if (context.stop.load()) return interrupted;
  if (failed == 0) return done;
  const auto first = ranges::find_if(rows, [](const Row& row) { return !row.failure.empty(); });
  throw NumericalError("lyapunov: " + std::to_string(failed) + " of " + std::to_string(sweep.count) +
                       " values, first " + sweep.name + " = " + shown(first->value) + ": " + first->failure +
                       "; the rows are written");
}

}  // namespace

Action add_lyapunov(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  options->model.declare(arguments);
  options->model.declare_state(arguments);
  arguments.count("--transient", options->transient, 0, 1'000'000'000, "forcing periods to leave out first (500)");
  arguments.count("--periods", options->periods, 20, 1'000'000'000,
                  "periods that the exponents are averaged over; with --error their greatest number (20000)");
  arguments.number("--error", options->error, "E", "end as soon as every standard error per period is below E",
                   positive);
  arguments.text("--sweep", options->sweep, "NAME=A:B:COUNT", "curves of exponents: a CSV row for each value");
  arguments.count("--threads", options->threads, 0, 1024, "of --sweep; 0: all. The result is the same (0)");
  arguments.text("--out", options->out, "FILE", "write there instead of to standard output");
  arguments.flag("--progress", options->progress, "show progress even if standard error is not a terminal");
  arguments.footer(
      "All Lyapunov exponents, largest first, per unit of time and, if forced, per forcing period; -inf where stick, "
      "a\n"
      "closed stop or complete chatter forgets a direction. docs/explanation/lyapunov.md says how, and what checks the "
      "numbers.\n"
      "  slapstick lyapunov vibro-impact --set omega=6.69");
  return [options, &arguments](const Context& context) {
    FileRoles roles;
    roles.add("MODEL", options->model.source);
    roles.add("--out", options->out);
    const ChosenModel chosen = options->model.load();
    return options->sweep.empty() ? one(*options, chosen, context) : many(*options, chosen, context);
  };
}

}  // namespace slapstick::app
