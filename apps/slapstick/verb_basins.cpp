/// slapstick basins MODEL --x VAR=A:B:COUNT --y VAR=A:B:COUNT
#include <cmath>
#include <cstdio>

#include "base/text.hpp"
#include "basin_figure.hpp"
#include "map_store.hpp"
#include "orbit_options.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "slapstick/base/error.hpp"
#include "verb.hpp"

namespace slapstick::app {
namespace {

using sweep::Basins;

struct Options {
  BasinOptions basins;
  std::string out, table, plot, plot_size, store;
  long long box = 5;
  bool resume = false, progress = false;
};

Basins gathered(BasinWish& wish, const Options& options, const Context& context) {
  sweep::MapProblem& problem = wish.plane.problem;
  Progress progress("starts", static_cast<double>(sweep::pixel_count(problem)), options.progress);
  problem.progress = [&](long done, long) { progress.update(static_cast<double>(done)); };
  problem.cancel = &context.stop;
  if (options.store.empty()) return sweep::run_basins(problem);
  return chart::stored_basins(wish.plane, open_store(options.store, chart::facts_of(wish.plane), options.resume));
}

Json number_or_null(double value) { return std::isnan(value) ? Json() : Json(value); }

Json basin_json(std::size_t number, const std::string& title, const sweep::Basin& basin, const Model& model) {
  const Classification& found = basin.attractor;
  Json multipliers = Json::list(), json = Json::object();
  for (const auto& one : found.multipliers) multipliers.push(Json::list(std::vector<double>{one.real(), one.imag()}));
  json.set("basin", number).set("name", title).set("class", found.label);
  json.set("attractor", std::string(name(found.attractor))).set("by_class", basin.by_class);
  json.set("starts", basin.starts).set("share", basin.share);
  json.set("share_from", basin.share_from).set("share_to", basin.share_to);
  if (found.n > 0) {
    json.set("n", found.n).set("p", found.chatter == Chatter::complete ? Json("inf") : Json(found.p));
    json.set("multipliers", std::move(multipliers));
  }
  json.set("exponent", number_or_null(found.exponent)).set("state", state_json(found.state, model));
  return json;
}

Json result_json(const BasinWish& wish, const Basins& found, int box) {
  Json parameters = Json::object(), list = Json::list(), json = Json::object();
  for (const auto& [name, value] : wish.chosen.definition.values(wish.chosen.overrides)) parameters.set(name, value);
  const std::vector<std::string> names = basin_names(found);
  for (std::size_t i = 0; i < found.basins.size(); ++i)
    list.push(basin_json(i + 1, names[i], found.basins[i], wish.chosen.model));
  const sweep::BasinEntropy entropy = sweep::basin_entropy(found, box);
  const sweep::Uncertainty uncertain = sweep::uncertainty(found);
  std::vector<double> distances(uncertain.distances.begin(), uncertain.distances.end());
  json.set("model", wish.chosen.model.name).set("parameters", std::move(parameters));
  json.set("x", wish.plane.x).set("y", wish.plane.y).set("starts", sweep::pixel_count(wish.plane.problem));
  json.set("undecided", found.count(Basins::undecided)).set("not_admissible", found.count(Basins::inadmissible));
  json.set("failed", found.count(Basins::failed)).set("not_computed", found.count(Basins::missing));
  json.set("basins", std::move(list));
  json.set("entropy", Json::object()
                          .set("box", entropy.box)
                          .set("boxes", entropy.boxes)
                          .set("on_boundary", entropy.on_boundary)
                          .set("whole", number_or_null(entropy.whole))
                          .set("boundary", number_or_null(entropy.boundary)));
  json.set("uncertainty", Json::object()
                              .set("distances", Json::list(distances))
                              .set("shares", Json::list(uncertain.shares))
                              .set("exponent", number_or_null(uncertain.exponent))
                              .set("error", number_or_null(uncertain.error)));
  return json;
}

std::string_view class_of(const Basins& basins, std::int32_t of) {
  if (of >= 0) return basins.basins[static_cast<std::size_t>(of)].attractor.label;
  return of == Basins::undecided      ? "undecided"
         : of == Basins::inadmissible ? "not-admissible"
         : of == Basins::failed       ? "failed"
                                      : "not-computed";
}

/// A row for each start. One that belongs to no basin has the number 0.
void write_table(const BasinWish& wish, const Basins& basins, TableOutput& table) {
  for (std::size_t i = 0; i < basins.of.size(); ++i) {
    const auto pixel = static_cast<std::int32_t>(i);
    table.number(wish.plane.problem.x_at(pixel)).number(wish.plane.problem.y_at(pixel));
    table.number(std::max(basins.of[i] + 1, 0)).word(class_of(basins, basins.of[i])).end_row();
  }
  table.commit();
}

TableFacts facts_of(const BasinWish& wish) {
  TableFacts facts = table_facts(wish.chosen);
  facts.attributes.push_back({"x_variable", wish.plane.x});
  facts.attributes.push_back({"y_variable", wish.plane.y});
  const sweep::MapProblem& problem = wish.plane.problem;
  facts.axes = {{"y", wish.plane.y, static_cast<std::size_t>(problem.y.count)},
                {"x", wish.plane.x, static_cast<std::size_t>(problem.x.count)}};
  return facts;
}

/// Says what numbers may hide. @throws NumericalError if every start failed
void report(const BasinWish& wish, const Basins& found, bool stored) {
  const long all = sweep::pixel_count(wish.plane.problem), missing = found.count(Basins::missing);
  if (found.count(Basins::inadmissible) == all)
    throw InputError("--x and --y: the stops forbid every start of the plane");
  if (missing > 0)
    std::fprintf(stderr, "slapstick: stopped after %ld of %ld starts; shares are those of the finished ones%s\n",
                 all - missing, all, stored ? ", and --resume goes on" : "");
  if (const long undecided = found.count(Basins::undecided); undecided > 0)
    std::fprintf(stderr, "slapstick: %ld of %ld starts are undecided: %s\n", undecided, all,
                 wish.plane.problem.level == sweep::Level::quick ? "more --periods, or --level full, names more of them"
                                                                 : "a longer --transient or --most-periods names more");
  if (found.failures.empty()) return;
  const auto& [pixel, why] = *found.failures.begin();
  const std::string text = std::to_string(found.failures.size()) + " of " + std::to_string(all) +
                           " starts failed, first " + wish.plane.x + " = " + shown(wish.plane.problem.x_at(pixel)) +
                           ", " + wish.plane.y + " = " + shown(wish.plane.problem.y_at(pixel)) + ": " + why;
  if (found.basins.empty()) throw NumericalError(text);
  std::fprintf(stderr, "slapstick: %s\n", text.c_str());
}

int run(const Options& options, const Context& context) {
  FileRoles roles;
  roles.add("MODEL", options.basins.model.source);
  roles.add("--out", options.out);
  roles.add("--table", options.table);
  roles.add("--store", options.store);
  roles.add_plot(options.plot);
  BasinWish wish = basin_wish(options.basins);
  const Plot plot(options.plot, options.plot_size);
  plot.demand_room(basin_outline(wish));
  Output out(options.out);
  std::optional<TableOutput> table;
  if (!options.table.empty())
    table.emplace(options.table, std::vector<std::string>{"x", "y", "basin", "class"}, facts_of(wish));
  const Basins found = gathered(wish, options, context);
  report(wish, found, !options.store.empty());
  if (table) write_table(wish, found, *table);
  out.write(result_json(wish, found, static_cast<int>(options.box)).dump() + "\n");
  out.commit();
  const int status = found.complete ? done : interrupted;
  return plot.write_or_say(plot.wanted() ? basin_figure(wish, found) : figure::Figure{}, false, status);
}

}  // namespace

Action add_basins(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  options->basins.declare(arguments);
  arguments.count("--box", options->box, 2, 1000, "side in starts of the boxes from which the entropy is taken (5)");
  arguments.text("--out", options->out, "FILE", "write the JSON there instead of to standard output");
  arguments.text("--table", options->table, "F.csv", "write a row for each start there (.csv, .npz or .h5)");
  arguments.text("--plot", options->plot, "F.png", "draw the basins (.png, .pdf, .svg, .tex or .py)");
  declare_plot_size(arguments, options->plot_size);
  arguments.text("--store", options->store, "F.db", "write each start there as it is finished");
  arguments.flag("--resume", options->resume, "compute only what is not there yet").with({"--store"});
  arguments.flag("--progress", options->progress, "show progress even if standard error is not a terminal");
  arguments.footer(
      "Each start of a plane of initial values, and the attractor that its motion comes to. Initial values that no "
      "axis "
      "has are\n"
      "those of --state or of the model. As JSON: the attractors with their shares, the basin entropy, and the "
      "exponent "
      "of\n"
      "uncertainty of the boundary.\n"
      "  slapstick basins vibro-impact --set omega=2.82 --x x1=-0.5:0.5:200 --y v1=-1:1:200 --plot basins.png");
  return [options](const Context& context) { return run(*options, context); };
}

}  // namespace slapstick::app
