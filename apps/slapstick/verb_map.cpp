/// slapstick map MODEL --x NAME=A:B:COUNT --y NAME=A:B:COUNT
#include <cstdio>

#include "base/ranges.hpp"
#include "base/text.hpp"
#include "chart_curves.hpp"
#include "chart_figure.hpp"
#include "map_options.hpp"
#include "map_store.hpp"
#include "map_table.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "slapstick/base/error.hpp"
#include "slurm_script.hpp"
#include "store_info.hpp"
#include "verb.hpp"

namespace slapstick::app {
namespace {

struct Options {
  MapOptions map;
  InsetOptions insets;
  std::string out, plot, plot_size, show, store;
  long long slurm = 0, curves = 0;
  bool resume = false, progress = false;
};

/// Says on standard error what a table cannot. @throws NumericalError if every pixel failed
void report(const MapWish& wish, const sweep::Map& map) {
  const auto known = static_cast<long>(map.findings.size()), all = sweep::pixel_count(wish.problem);
  if (!map.complete && wish.problem.start != sweep::MapStart::random)
    std::fprintf(stderr, "slapstick: stopped after %ld of %ld pixels; the finished ones are written\n", known, all);
  if (!map.complete && wish.problem.start == sweep::MapStart::random)
    std::fprintf(stderr, "slapstick: stopped before the end; what is complete is written\n");
  if (map.complete && wish.problem.refine > 0)
    std::fprintf(stderr, "slapstick: %ld of %ld pixels (%.3g %%) were computed, the others are filled in\n", known, all,
                 100.0 * static_cast<double>(known) / static_cast<double>(all));
  if (map.failures.empty()) return;
  const auto& [place, why] = *map.failures.begin();
  const sweep::Finding first{.pixel = place.second};
  const std::string text = std::to_string(map.failures.size()) + " of " + std::to_string(all) +
                           " pixels failed, first " + wish.x.name + " = " + shown(map.x_of(first)) + ", " +
                           wish.y.name + " = " + shown(map.y_of(first)) + ": " + why;
  if (ranges::none_of(map.findings, [](const sweep::Finding& found) { return !found.failed; }))
    throw NumericalError(text);
  std::fprintf(stderr, "slapstick: %s\n", text.c_str());
}

/// @returns whether it is complete
bool run(MapWish& wish, const Options& options, const Context& context) {
  const bool refined = wish.problem.refine > 0;
  Progress progress(refined ? "pixels wanted so far" : "pixels",
                    static_cast<double>(sweep::pixel_count(wish.problem)) / wish.problem.shards, options.progress);
  wish.problem.progress = [&](long done, long total) {
    if (refined) return progress.update(static_cast<double>(done), static_cast<double>(total));
    progress.update(static_cast<double>(done));
  };
  wish.problem.cancel = &context.stop;
  return sweep::run_tiles(wish.problem);
}

sweep::Map gathered(MapWish& wish, const Options& options, const Context& context) {
  if (options.store.empty()) {
    sweep::MapBuilder builder(wish.problem);
    wish.problem.finished = [&](std::span<const sweep::Pixel> pixels) {
      for (const sweep::Pixel& pixel : pixels) builder.add(pixel);
    };
    const bool complete = run(wish, options, context);
    return builder.take(complete);
  }
  const chart::MapStore store(open_store(options.store, chart::facts_of(wish.chart()), options.resume), wish.problem);
  const bool complete = run(wish, options, context);
  sweep::Map map = chart::read_map(store.kept(), wish.problem);
  map.complete = complete;
  return map;
}

/// With a store and no other output: what the store then holds.
int only_store(MapWish& wish, const Options& options, const Context& context) {
  const chart::MapStore store(open_store(options.store, chart::facts_of(wish.chart()), options.resume), wish.problem);
  const bool complete = run(wish, options, context);
  if (!complete)
    std::fprintf(stderr, "slapstick: stopped before the end; %s has what is complete, and --resume goes on\n",
                 options.store.c_str());
  Output out("");
  out.write(store_info(store.kept()).dump() + "\n");
  out.commit();
  return complete ? done : interrupted;
}

ChartLook look_of(const MapWish& wish, const Options& options) {
  return {shown_columns(wish, options.show), chart_insets(wish, options.insets)};
}

/// The script instead of the map.
int print_script(const Options& options) {
  const std::unique_ptr<MapWish> wish = map_wish(options.map);
  static_cast<void>(look_of(*wish, options));
  Output out("");
  out.write(slurm_script(options.map, chart::option_words(wish->chart()),
                         {.tasks = static_cast<int>(options.slurm),
                          .store = options.store,
                          .out = options.out,
                          .plot = options.plot,
                          .plot_size = options.plot_size,
                          .show = options.show,
                          .insets = options.insets.texts}));
  out.commit();
  return done;
}

int map(const Options& options, const Context& context) {
  if (options.slurm > 0) return print_script(options);
  FileRoles roles;
  roles.add("MODEL", options.map.model.source);
  roles.add("--out", options.out);
  roles.add("--store", options.store);
  roles.add_plot(options.plot);
  const std::unique_ptr<MapWish> wish = map_wish(options.map);
  const ChartLook look = look_of(*wish, options);
  if (!options.store.empty() && options.out.empty() && options.plot.empty()) return only_store(*wish, options, context);
  const Plot plot(options.plot, options.plot_size);
  plot.demand_room(chart_outline(*wish, look));
  TableOutput table(options.out, map_columns(*wish), map_facts(*wish));
  const sweep::Map found = gathered(*wish, options, context);
  if (options.store.empty() || !options.out.empty()) write_map(*wish, found, table);
  figure::Figure picture;
  if (plot.wanted()) picture = chart_figure(*wish, found, look);
  if (options.curves > 0 && !context.stop) {
    const chart::Curves curves =
        chart::find_curves(wish->chart(), found, static_cast<int>(options.curves), &context.stop);
    draw_curves(curves, picture);
    report_curves(curves);
  }
  const int status = plot.write_or_say(std::move(picture), found.findings.empty(), found.complete ? done : interrupted);
  report(*wish, found);
  return status;
}

}  // namespace

Action add_map(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  options->map.declare(arguments);
  arguments.text("--out", options->out, "F.csv",
                 "write the table there (.csv, .npz or .h5) instead of to standard output");
  arguments.text("--plot", options->plot, "F.png", "draw the chart (.png, .pdf, .svg, .tex or .py)");
  declare_plot_size(arguments, options->plot_size);
  arguments.text("--show", options->show, "class,..",
                 "what the panels of the picture are: class, exponent, multiplier, n, p, attractors, Q:STAT of --of "
                 "(class and those of --of)");
  options->insets.declare(arguments);
  arguments
      .count("--curves", options->curves, 0, 1000,
             "lay up to N bifurcation curves over the chart, found from its own boundaries (0)")
      .with({"--plot"})
      .with({"--start reset"})
      .without({"--slurm"});
  arguments.text("--store", options->store, "F.db", "write each pixel there as it is finished");
  arguments.flag("--resume", options->resume, "compute only what is not there yet").with({"--store"});
  arguments
      .count("--slurm", options->slurm, 1, 100'000,
             "print a script for `sbatch` that computes the map into --store in N tasks")
      .with({"--store"})
      .without({"--shard", "--resume", "--threads", "--refine"});
  arguments.flag("--progress", options->progress, "show progress even if standard error is not a terminal");
  arguments.footer(
      "A chart over two parameters: at every pixel the class n-p-I or n-p-II, the kind of attractor, exponent and "
      "multiplier.\n"
      "  slapstick map vibro-impact --x omega=1:6:200 --y friction=0.05:0.3:120 --plot chart.png --out chart.csv");
  return [options](const Context& context) { return map(*options, context); };
}

}  // namespace slapstick::app
