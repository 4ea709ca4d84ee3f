/// Puts pixels of a map into a store, and takes them out.
#include "map_store.hpp"

#include "base/text.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::app {
namespace {

using sweep::Direction;
using sweep::Finding;

std::int64_t number_of(std::int32_t pixel, Direction direction, const sweep::MapProblem& problem) {
  const auto layer = static_cast<std::int64_t>(problem.x.count) * problem.y.count;
  const bool second = problem.direction == Direction::both && direction == Direction::down;
  return pixel + (second ? layer : 0);
}

constexpr std::size_t fixed = 11;  ///< numbers of a finding before its statistics

void append(const Finding& found, std::vector<double>& to) {
  to.insert(to.end(), {static_cast<double>(found.attractor), static_cast<double>(found.doubt),
                       static_cast<double>(found.chatter), found.sticking ? 1.0 : 0.0, found.failed ? 1.0 : 0.0,
                       static_cast<double>(found.n), static_cast<double>(found.p), static_cast<double>(found.starts),
                       found.exponent, found.multiplier.real(), found.multiplier.imag()});
}

Finding finding_of(const double* numbers) {
  Finding found;
  found.attractor = static_cast<Attractor>(numbers[0]);
  found.doubt = static_cast<Doubt>(numbers[1]);
  found.chatter = static_cast<Chatter>(numbers[2]);
  found.sticking = numbers[3] != 0.0;
  found.failed = numbers[4] != 0.0;
  found.n = static_cast<std::int32_t>(numbers[5]);
  found.p = static_cast<std::int32_t>(numbers[6]);
  found.starts = static_cast<std::int32_t>(numbers[7]);
  found.exponent = numbers[8];
  found.multiplier = {numbers[9], numbers[10]};
  return found;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : "\n") + word;
  return text;
}

}  // namespace

StoreFacts run_facts(const std::string& verb, const ChosenModel& chosen, const std::vector<std::string>& options, long cells,
                     int shard, int shards, const std::string& kernel) {
  return {{"verb", verb},
          {"version", SLAPSTICK_VERSION},
          {"kernel", kernel},
          {"model", chosen.definition.to_toml(chosen.overrides)},
          {"options", joined(options)},
          {"shard", std::to_string(shard + 1) + "/" + std::to_string(shards)},
          {"cells", std::to_string(cells)}};
}

StoreFacts map_facts_of(const MapOptions& options, const MapWish& wish) {
  const sweep::MapProblem& problem = wish.problem;
  return run_facts("map", wish.chosen, options.words(), sweep::pixel_count(problem), problem.shard, problem.shards,
                   sweep::runs_in_lanes(problem) ? "lanes" : "motion");
}

std::unique_ptr<MapWish> wish_of(const Store& store) {
  if (store.fact("verb") != "map") throw InputError("store export: the store is of " + in_quotes(store.fact("verb")) + ", not of a map; the verb itself with --store, --resume and --out writes its table");
  MapOptions options;
  Arguments arguments("map", "");
  options.declare(arguments);
  std::vector<std::string> words{"MODEL"};
  for (const std::string& word : split(store.fact("options"), '\n')) words.push_back(word);
  static_cast<void>(arguments.parse(words));
  options.shard = store.fact("shard");
  return map_wish(options, options.model.with_sets(ModelDefinition::parse(store.fact("model"), "the store's model")));
}

StoredCell cell_of(const sweep::Pixel& pixel, const sweep::MapProblem& problem) {
  StoredCell cell{number_of(pixel.number, pixel.direction, problem), {}, pixel.failure, pixel.carried};
  const std::size_t width = problem.of.size();
  for (std::size_t k = 0; k < pixel.found.size(); ++k) {
    append(pixel.found[k], cell.numbers);
    const auto first = pixel.values.begin() + static_cast<std::ptrdiff_t>(k * width);
    cell.numbers.insert(cell.numbers.end(), first, first + static_cast<std::ptrdiff_t>(width));
  }
  return cell;
}

sweep::Pixel pixel_of(const StoredCell& cell, const sweep::MapProblem& problem) {
  const std::int64_t layer = static_cast<std::int64_t>(problem.x.count) * problem.y.count;
  const std::size_t width = fixed + problem.of.size();
  if (cell.number < 0 || cell.number >= sweep::pixel_count(problem) || cell.numbers.size() % width != 0)
    throw StorageError("the store's cell " + std::to_string(cell.number) + " does not belong to this map");
  sweep::Pixel pixel;
  pixel.number = static_cast<std::int32_t>(cell.number % layer);
  const bool down = cell.number >= layer || problem.direction == Direction::down;
  pixel.direction = down ? Direction::down : Direction::up;
  pixel.failure = cell.failure;
  pixel.carried = cell.carried;
  for (std::size_t at = 0; at < cell.numbers.size(); at += width) {
    pixel.found.push_back(finding_of(cell.numbers.data() + at));
    pixel.found.back().pixel = pixel.number;
    pixel.found.back().direction = pixel.direction;
    for (std::size_t k = fixed; k < width; ++k) pixel.values.push_back(cell.numbers[at + k]);
  }
  return pixel;
}

sweep::Map read_map(const Store& store, const MapWish& wish) {
  sweep::MapBuilder builder(wish.problem);
  long cells = 0;
  store.for_each([&](const StoredCell& cell) {
    builder.add(pixel_of(cell, wish.problem));
    ++cells;
  });
  return builder.take(cells == sweep::pixel_count(wish.problem));
}

MapStore::MapStore(Store store, sweep::MapProblem& problem)
    : store_(std::move(store)), problem_(problem), known_(static_cast<std::size_t>(sweep::pixel_count(problem))) {
  store_.for_each([&](const StoredCell& cell) {
    const sweep::Pixel pixel = pixel_of(cell, problem_);
    known_[static_cast<std::size_t>(number_of(pixel.number, pixel.direction, problem_))] = true;
  });
  problem.known = [this](std::int32_t pixel, Direction direction) {
    return known_[static_cast<std::size_t>(number_of(pixel, direction, problem_))];
  };
  problem.carried_of = [this](std::int32_t pixel, Direction direction) {
    const std::lock_guard lock(mutex_);
    const auto cell = store_.find(number_of(pixel, direction, problem_));
    return cell ? cell->carried : State{};
  };
  problem.finished = [this](std::span<const sweep::Pixel> pixels) { note(pixels); };
}

void MapStore::note(std::span<const sweep::Pixel> pixels) {
  std::vector<StoredCell> cells;
  for (const sweep::Pixel& pixel : pixels) cells.push_back(cell_of(pixel, problem_));
  const std::lock_guard lock(mutex_);
  store_.add(cells);
}

}  // namespace slapstick::app
