/// Charts: their words and what stores say of them.
#include "slapstick/chart/chart.hpp"

#include "base/text.hpp"
#include "chart/words.hpp"
#include "io/table.hpp"

namespace slapstick::chart {
namespace {

std::string start_words(const sweep::MapProblem& problem) {
  switch (problem.start) {
    case sweep::MapStart::reset:
      return "reset";
    case sweep::MapStart::carry:
      return "carry";
    case sweep::MapStart::random:
      break;
  }
  return std::to_string(problem.starts);
}

}  // namespace

std::string axis_words(const std::string& name, const sweep::GridAxis& axis) {
  return name + "=" + number_text(axis.from) + ":" + number_text(axis.to) + ":" + std::to_string(axis.count);
}

void add_analysis_words(const sweep::MapProblem& problem, std::vector<std::string>& words) {
  const ClassifyOptions& classify = problem.classify;
  words.insert(words.end(), {"--level", problem.level == sweep::Level::quick ? "quick" : "full"});
  for (const auto& [name, value] : {std::pair<const char*, int>{"--periods", problem.periods},
                                    {"--transient", classify.transient_periods},
                                    {"--most-periods", classify.most_periods},
                                    {"--exponent-periods", classify.exponent_periods},
                                    {"--most-n", classify.most_n}}) {
    words.emplace_back(name);
    words.push_back(std::to_string(value));
  }
}

Chart over(ModelDefinition definition, Overrides values, std::string x, const sweep::GridAxis& x_axis, std::string y,
           const sweep::GridAxis& y_axis) {
  Chart chart{.definition = std::move(definition), .values = std::move(values), .x = std::move(x), .y = std::move(y)};
  chart.problem.x = x_axis;
  chart.problem.y = y_axis;
  const auto at = [values = chart.values, x = chart.x, y = chart.y](double of_x, double of_y) {
    Overrides all = values;
    all[x] = of_x;
    all[y] = of_y;
    return all;
  };
  chart.problem.model_at = [at, model = chart.definition](double of_x, double of_y) {
    return model.build(at(of_x, of_y));
  };
  chart.problem.start_at = [at, model = chart.definition](double of_x, double of_y) {
    return model.start(at(of_x, of_y));
  };
  return chart;
}

std::string state_words(const Overrides& named) {
  std::string words;
  for (const auto& [name, value] : named) words += (words.empty() ? "" : ",") + name + "=" + number_text(value);
  return words;
}

std::vector<std::string> option_words(const Chart& chart) {
  const sweep::MapProblem& problem = chart.problem;
  const char* direction = problem.direction == sweep::Direction::up     ? "up"
                          : problem.direction == sweep::Direction::down ? "down"
                                                                        : "both";
  std::vector<std::string> words{"--x", axis_words(chart.x, problem.x), "--y", axis_words(chart.y, problem.y)};
  const auto level_ends = static_cast<std::ptrdiff_t>(words.size()) + 2;  // in the order of the stores that are there
  add_analysis_words(problem, words);
  words.insert(words.begin() + level_ends, {"--start", start_words(problem), "--direction", direction});
  words.insert(words.end(), {"--seed", std::to_string(problem.seed), "--measured-periods",
                             std::to_string(problem.measured_periods)});
  if (problem.refine > 0) words.insert(words.end(), {"--refine", std::to_string(problem.refine)});
  std::vector<std::string> of;
  for (std::size_t k = 0; k < problem.of.size(); ++k) of.push_back(problem.of[k].name + ":" + problem.statistics[k]);
  if (!of.empty()) words.insert(words.end(), {"--of", joined(of, ",")});
  if (!chart.state.empty()) words.insert(words.end(), {"--state", chart.state});
  for (const std::string& stop : chart.stops) words.insert(words.end(), {"--stop", stop});
  return words;
}

store::StoreFacts run_facts(const std::string& verb, const ModelDefinition& definition, const Overrides& values,
                            const std::vector<std::string>& options, long cells, int shard, int shards,
                            const std::string& kernel) {
  return {{"verb", verb},
          {"version", SLAPSTICK_VERSION},
          {"kernel", kernel},
          {"model", definition.to_toml(values)},
          {"options", joined(options, "\n")},
          {"shard", std::to_string(shard + 1) + "/" + std::to_string(shards)},
          {"cells", std::to_string(cells)}};
}

store::StoreFacts facts_of(const Chart& chart) {
  return run_facts("map", chart.definition, chart.values, option_words(chart), sweep::pixel_count(chart.problem),
                   chart.problem.shard, chart.problem.shards, sweep::runs_in_lanes(chart.problem) ? "lanes" : "motion");
}

sweep::Map stored_map(const Chart& chart, const std::string& path, bool resume) {
  sweep::MapProblem problem = chart.problem;
  const MapStore bound(store::Store::to_write(path, facts_of(chart), resume), problem);
  const bool complete = sweep::run_tiles(problem);
  sweep::Map map = read_map(bound.kept(), problem);
  map.complete = complete;
  return map;
}

}  // namespace slapstick::chart
