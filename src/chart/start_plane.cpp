/// Planes of starts: their words and what stores say of them.
#include "slapstick/chart/start_plane.hpp"

#include <algorithm>

#include "base/ranges.hpp"
#include "base/text.hpp"
#include "chart/words.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::chart {
namespace {

sweep::StartAxis axis_of(const char* argument, const std::string& name, const sweep::GridAxis& values,
                         const ModelDefinition& definition, const Model& model) {
  const std::vector<std::string> names = state_names(model);
  const auto found = std::find(names.begin(), names.end(), name);
  const auto is_it = [&](const Parameter& one) { return one.name == name; };
  const bool is_parameter = ranges::any_of(definition.parameters(), is_it);
  if (found == names.end())
    throw InputError(std::string(argument) + ": " + in_quotes(name) +
                     " is no displacement or velocity of the model, which has " + joined(names, ", ") +
                     (is_parameter ? "; a chart over a parameter is a map" : ""));
  const auto place = static_cast<std::size_t>(found - names.begin());
  if (place % 2 == 1 && model.is_inner(static_cast<int>(place / 2)))
    throw InputError(std::string(argument) + ": " + in_quotes(name) +
                     " follows from the displacements, so that no start has another");
  return {place, values};
}

/// One way of many to say what is computed.
std::vector<std::string> option_words(const StartPlane& plane) {
  const sweep::MapProblem& problem = plane.problem;
  std::vector<std::string> words{"--x", axis_words(plane.x, problem.x), "--y", axis_words(plane.y, problem.y)};
  add_analysis_words(problem, words);
  Overrides others;
  const std::vector<std::string> names = state_names(plane.definition.build(plane.values));
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] != plane.x && names[i] != plane.y) others[names[i]] = plane.start[i];
  if (!others.empty()) words.insert(words.end(), {"--state", state_words(others)});
  for (const std::string& stop : plane.stops) words.insert(words.end(), {"--stop", stop});
  return words;
}

}  // namespace

StartPlane starts_over(ModelDefinition definition, Overrides values, State start, std::string x,
                       const sweep::GridAxis& x_axis, std::string y, const sweep::GridAxis& y_axis) {
  const Model model = definition.build(values);
  const sweep::StartAxis across = axis_of("x", x, x_axis, definition, model),
                         up = axis_of("y", y, y_axis, definition, model);
  if (across.place == up.place) throw InputError("y: " + in_quotes(y) + " is the axis of x too");
  sweep::MapProblem problem = sweep::starts_over(model, start, across, up);
  return {std::move(definition), std::move(values), std::move(x), std::move(y), std::move(start), {},
          std::move(problem)};
}

store::StoreFacts facts_of(const StartPlane& plane) {
  return run_facts("basins", plane.definition, plane.values, option_words(plane), sweep::pixel_count(plane.problem), 0,
                   1, sweep::runs_in_lanes(plane.problem) ? "lanes" : "motion");
}

sweep::Basins stored_basins(const StartPlane& plane, store::Store store) {
  sweep::MapProblem problem = plane.problem;
  const MapStore bound(std::move(store), problem);
  (void)sweep::run_tiles(problem);
  sweep::BasinBuilder builder(problem);
  for_each_pixel(bound.kept(), problem, [&](const sweep::Pixel& pixel) { builder.add(pixel); });
  return builder.take();
}

sweep::Basins stored_basins(const StartPlane& plane, const std::string& path, bool resume) {
  return stored_basins(plane, store::Store::to_write(path, facts_of(plane), resume));
}

}  // namespace slapstick::chart
