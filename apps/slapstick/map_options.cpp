/// Reads the options of `map` and makes its problem of them.
#include "map_options.hpp"

#include "base/ranges.hpp"
#include "base/text.hpp"
#include "measured_diagram.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::app {

void MapOptions::declare(Arguments& arguments) {
  model.declare(arguments);
  model.declare_state(arguments);
  arguments.text("--x", x, "NAME=A:B:COUNT", "the parameter across, its range and the number of values").required();
  arguments.text("--y", y, "NAME=A:B:COUNT", "the parameter upwards").required();
  analysis.declare(arguments);
  arguments.text(
      "--start", start, "reset|carry|N",
      "begin each pixel anew, or where its neighbour in the row ended up, or at N random states and keep every "
      "attractor (reset)");
  arguments
      .choice("--direction", direction, {"up", "down", "both"},
              "through the values of x; both shows coexisting attractors (up)")
      .with({"--start carry"});
  arguments.count("--seed", seed, 0, 4'294'967'295, "of --start N: the number that chooses the random states (1)")
      .without({"--start reset", "--start carry"});
  arguments.text("--of", of, "Q:STAT,..",
                 "statistics of quantities over the cycle, or without one over --measured-periods");
  arguments.count("--measured-periods", measured_periods, 1, 1'000'000'000, "where there is no cycle (100)")
      .with({"--of"});
  arguments.count("--threads", threads, 0, 1024, "0: all cores; the result is the same for any number (0)");
  arguments
      .count("--refine", refine, 2, 1024,
             "compute every N-th pixel of every N-th row, and beyond that only where classes differ; the others are "
             "filled in, and marked (every pixel is computed)")
      .with({"--start reset"})
      .without({"--shard"});
  arguments.text("--shard", shard, "I/N", "only every N-th tile, beginning with the I-th (1 to N)").with({"--store"});
}

namespace {

Overrides values_at(const MapWish& wish, double x, double y) {
  Overrides overrides = wish.chosen.overrides;
  overrides[wish.x.name] = x;
  overrides[wish.y.name] = y;
  return overrides;
}

void read_start(const MapOptions& options, sweep::MapProblem& problem) {
  if (options.start == "carry") {
    problem.start = sweep::MapStart::carry;
  } else if (options.start != "reset") {
    if (options.start.find_first_not_of("0123456789") != std::string::npos || options.start.empty())
      throw InputError("--start: " + in_quotes(options.start) + " must be reset, carry or a number");
    problem.start = sweep::MapStart::random;
    problem.starts = static_cast<int>(parse_integer("--start", options.start, 2, 100'000));
  }
  problem.direction = options.direction == "up"     ? sweep::Direction::up
                      : options.direction == "down" ? sweep::Direction::down
                                                    : sweep::Direction::both;
}

void read_shard(const std::string& text, sweep::MapProblem& problem) {
  if (text.empty()) return;
  const auto parts = split(text, '/');
  if (parts.size() != 2) throw InputError("--shard: " + in_quotes(text) + " is not of the form I/N");
  problem.shards = static_cast<int>(parse_integer("--shard N", parts[1], 1, 1'000'000));
  problem.shard = static_cast<int>(parse_integer("--shard I", parts[0], 1, problem.shards)) - 1;
}

void read_quantities(const MapOptions& options, MapWish& wish) {
  if (options.of.empty()) return;
  wish.of = parse_statistics("--of", options.of, wish.chosen);
  for (const Wanted& one : wish.of) {
    if (one.quantity.kind == Quantity::Kind::parameter)
      throw InputError("--of: " + in_quotes(one.quantity.name) + " is a parameter, which no motion changes");
    check_of_stretch("--of", one);
    wish.problem.of.push_back(one.quantity);
    wish.problem.statistics.push_back(one.statistic);
  }
}

/// The corners of the chart.
void check_corners(const MapOptions& options, const MapWish& wish) {
  const Work work = options.analysis.work();
  for (const double x : {wish.x.from, wish.x.to}) {
    for (const double y : {wish.y.from, wish.y.to}) {
      try {
        const Overrides here{{wish.x.name, x}, {wish.y.name, y}};
        const System system = affordable_system(wish.chosen, work, here);
        demand_period(system.model());
        validate(system.model(), options.model.start(wish.chosen, here));
      } catch (const InputError& error) {
        throw InputError("--x " + wish.x.name + "=" + shown(x) + " --y " + wish.y.name + "=" + shown(y) + ": " +
                         error.message());
      }
    }
  }
}

void check_names(const MapWish& wish) {
  if (wish.x.name == wish.y.name) throw InputError("--y: " + in_quotes(wish.y.name) + " is the parameter of --x too");
  for (const auto& [argument, name] : {std::pair{"--x", wish.x.name}, std::pair{"--y", wish.y.name}})
    if (wish.chosen.overrides.contains(name))
      throw InputError(std::string(argument) + ": " + in_quotes(name) + " is given by --set too");
  const double pixels = static_cast<double>(wish.x.count) * wish.y.count;
  if (pixels > 1e9)
    throw InputError("--x and --y give " + shown(pixels) + " pixels, more than the 1e9 that a map may have");
}

}  // namespace

std::unique_ptr<MapWish> map_wish(const MapOptions& options) { return map_wish(options, options.model.load()); }

std::unique_ptr<MapWish> map_wish(const MapOptions& options, ChosenModel chosen) {
  auto wish = std::make_unique<MapWish>(MapWish{std::move(chosen),
                                                parse_sweep(options.x, "--x"),
                                                parse_sweep(options.y, "--y"),
                                                {},
                                                options.model.state,
                                                options.analysis.stops.names,
                                                {}});
  check_names(*wish);
  sweep::MapProblem& problem = wish->problem;
  read_start(options, problem);
  read_shard(options.shard, problem);
  check_corners(options, *wish);
  options.analysis.apply(wish->chosen.model, problem);
  read_quantities(options, *wish);
  problem.x = {wish->x.from, wish->x.to, wish->x.count};
  problem.y = {wish->y.from, wish->y.to, wish->y.count};
  problem.refine = static_cast<int>(options.refine);
  problem.seed = static_cast<std::uint64_t>(options.seed);
  problem.measured_periods = static_cast<int>(options.measured_periods);
  problem.threads = static_cast<int>(options.threads);
  const MapWish* one = wish.get();
  problem.model_at = [one](double x, double y) { return one->chosen.definition.build(values_at(*one, x, y)); };
  const ModelOptions model = options.model;
  problem.start_at = [one, model](double x, double y) {
    return model.start(one->chosen, {{one->x.name, x}, {one->y.name, y}});
  };
  return wish;
}

}  // namespace slapstick::app
