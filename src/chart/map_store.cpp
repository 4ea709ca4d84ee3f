/// Puts pixels of a map into a store, and takes them out.
#include <mutex>

#include "slapstick/base/error.hpp"
#include "slapstick/chart/chart.hpp"

namespace slapstick::chart {
namespace {

using store::StoredCell;
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

}  // namespace

void for_each_pixel(const store::Store& store, const sweep::MapProblem& problem,
                    const std::function<void(const sweep::Pixel&)>& use) {
  store.for_each([&](const StoredCell& cell) { use(pixel_of(cell, problem)); });
}

sweep::Map read_map(const store::Store& store, const sweep::MapProblem& problem) {
  sweep::MapBuilder builder(problem);
  long cells = 0;
  for_each_pixel(store, problem, [&](const sweep::Pixel& pixel) {
    builder.add(pixel);
    ++cells;
  });
  return builder.take(problem.refine > 0 || cells == sweep::pixel_count(problem));
}

struct MapStore::Bound {
  Bound(store::Store of, const sweep::MapProblem& to)
      : kept(std::move(of)), problem(to), known(static_cast<std::size_t>(sweep::pixel_count(to))) {
    kept.for_each([&](const StoredCell& cell) {
      const sweep::Pixel pixel = pixel_of(cell, problem);
      known[static_cast<std::size_t>(number_of(pixel.number, pixel.direction, problem))] = true;
    });
  }

  [[nodiscard]] std::optional<StoredCell> find(std::int32_t pixel, Direction direction) {
    const std::scoped_lock lock(mutex);
    return kept.find(number_of(pixel, direction, problem));
  }

  void note(std::span<const sweep::Pixel> pixels) {
    std::vector<StoredCell> cells;
    for (const sweep::Pixel& pixel : pixels) cells.push_back(cell_of(pixel, problem));
    const std::scoped_lock lock(mutex);
    kept.add(cells);
  }

  store::Store kept;
  const sweep::MapProblem& problem;
  std::vector<bool> known;  // as they were at the start: only then are they asked for
  std::mutex mutex;
};

MapStore::MapStore(store::Store of, sweep::MapProblem& problem)
    : bound_(std::make_unique<Bound>(std::move(of), problem)) {
  Bound* bound = bound_.get();
  problem.known = [bound](std::int32_t pixel, Direction direction) {
    return bound->known[static_cast<std::size_t>(number_of(pixel, direction, bound->problem))];
  };
  problem.carried_of = [bound](std::int32_t pixel, Direction direction) {
    const auto cell = bound->find(pixel, direction);
    return cell ? cell->carried : State{};
  };
  problem.finding_of = [bound](std::int32_t pixel, Direction direction) {
    const auto cell = bound->find(pixel, direction);
    return cell ? pixel_of(*cell, bound->problem).found.at(0) : Finding{};
  };
  problem.finished = [bound](std::span<const sweep::Pixel> pixels) { bound->note(pixels); };
}

MapStore::~MapStore() = default;
const store::Store& MapStore::kept() const { return bound_->kept; }

}  // namespace slapstick::chart
