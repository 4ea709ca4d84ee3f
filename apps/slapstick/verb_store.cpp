/// slapstick store info|merge|export F.db ..
#include <cstdio>

#include "base/text.hpp"
#include "chart_figure.hpp"
#include "map_store.hpp"
#include "map_table.hpp"
#include "output.hpp"
#include "slapstick/base/error.hpp"
#include "store_info.hpp"
#include "verb.hpp"

namespace slapstick::app {
namespace {

struct Options {
  std::string action;
  std::vector<std::string> files;
  std::string out, plot, plot_size, show;
  InsetOptions insets;
};

const std::string& only_file(const Options& options) {
  if (options.files.size() != 1) throw InputError("store " + options.action + ": one store is wanted");
  return options.files.front();
}

int info(const Options& options) {
  Output out(options.out);
  const Store store = Store::to_read(only_file(options));
  store.check();
  out.write(store_info(store).dump() + "\n");
  out.commit();
  return done;
}

/// The facts of the whole of which a store is a shard.
StoreFacts whole_facts(const Store& store) {
  StoreFacts facts = store.facts();
  for (auto& [name, value] : facts)
    if (name == "shard") value = "1/1";
  return facts;
}

int merge(const Options& options, const Context& context) {
  if (options.files.size() < 2) throw InputError("store merge: two stores or more are wanted");
  if (options.out.empty()) throw InputError("store merge: --out F.db is wanted, the store to join them in");
  for (const std::string& file : options.files) {
    FileRoles roles;
    roles.add("a store", file);
    roles.add("--out", options.out);
  }
  const StoreFacts facts = whole_facts(Store::to_read(options.files.front()));
  Store into = open_store(options.out, facts, false);
  for (const std::string& file : options.files) {
    const Store from = Store::to_read(file);
    if (whole_facts(from) != facts)
      throw InputError("store merge: " + in_quotes(file) + " is of another run than " +
                       in_quotes(options.files.front()));
    std::vector<StoredCell> some;
    constexpr std::size_t at_once = 1000;
    from.for_each([&](const StoredCell& cell) {
      some.push_back(cell);
      if (some.size() < at_once) return;
      into.add(some);
      some.clear();
    });
    into.add(some);
    if (context.stop) return interrupted;
  }
  Output out("");
  out.write(store_info(into).dump() + "\n");
  out.commit();
  return done;
}

int write_out(const Options& options) {
  const Store store = Store::to_read(only_file(options));
  FileRoles roles;
  roles.add("the store", options.files.front());
  roles.add("--out", options.out);
  roles.add_plot(options.plot);
  const std::unique_ptr<MapWish> wish = wish_of(store);
  const ChartLook look{shown_columns(*wish, options.show), chart_insets(*wish, options.insets)};
  const Plot plot(options.plot, options.plot_size);
  plot.demand_room(chart_outline(*wish, look));
  TableOutput table(options.out, map_columns(*wish), map_facts(*wish));
  const sweep::Map map = chart::read_map(store, wish->problem);
  if (map.complete && wish->problem.refine > 0)
    std::fprintf(stderr, "slapstick: %ld of %s pixels were computed, the others are filled in\n", store.count(),
                 store.fact("cells").c_str());
  if (!map.complete)
    std::fprintf(stderr, "slapstick: the store has %ld of %s cells\n", store.count(), store.fact("cells").c_str());
  if (options.plot.empty() || !options.out.empty()) write_map(*wish, map, table);
  return plot.wanted() ? plot.write_or_say(chart_figure(*wish, map, look), map.findings.empty(), done) : done;
}

}  // namespace

Action add_store(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  arguments.positional("ACTION", options->action,
                       "info: what it holds, every cell looked at; merge: joins stores; export: a table or picture");
  arguments.positionals("FILES", options->files, "the store, or for merge the stores");
  arguments.text("--out", options->out, "FILE",
                 "of merge: the new store; of export: the table (.csv, .npz or .h5), else standard output");
  arguments.text("--plot", options->plot, "F.png", "of export: draw the chart");
  declare_plot_size(arguments, options->plot_size);
  arguments.text("--show", options->show, "class,..", "of export: what the panels are, as of `map`");
  options->insets.declare(arguments);
  arguments.footer(
      "Stores are written by `map --store F.db`. Equal results have equal hashes.\n"
      "  slapstick store info chart.db\n"
      "  slapstick store merge part-*.db --out chart.db\n"
      "  slapstick store export chart.db --out chart.h5 --plot chart.png");
  return [options, &arguments](const Context& context) {
    if (options->action != "export")
      for (const char* name : {"--plot", "--show"})
        if (arguments.given(name)) throw InputError(std::string(name) + ": only for store export");
    if (options->action == "info") return info(*options);
    if (options->action == "merge") return merge(*options, context);
    if (options->action == "export") return write_out(*options);
    throw InputError("store: " + in_quotes(options->action) + " must be info, merge or export");
  };
}

}  // namespace slapstick::app
