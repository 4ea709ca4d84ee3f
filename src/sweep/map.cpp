/// Runs a map: which pixels are a tile, which tiles are a chain, and what happens to the finished ones.
#include "slapstick/sweep/map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

#include "base/ranges.hpp"
#include "base/text.hpp"
#include "slapstick/base/error.hpp"
#include "sweep/executor.hpp"
#include "sweep/finding_kinds.hpp"
#include "sweep/known_cycles.hpp"
#include "sweep/map_check.hpp"
#include "sweep/map_pixel.hpp"
#include "sweep/refinement.hpp"

namespace slapstick::sweep {
namespace {

void demand_of_map(bool good, const std::string& message) {
  if (!good) throw InputError("map: " + message);
}

void check_axis(const char* name, const GridAxis& axis) {
  const std::string of = name;
  demand_of_map(std::isfinite(axis.from) && std::isfinite(axis.to), of + ": from and to must be finite");
  demand_of_map(axis.count >= 1, of + ".count = " + std::to_string(axis.count) + " is below 1");
  demand_of_map(
      axis.count == 1 ? axis.from == axis.to : axis.from < axis.to,
      of + ": from = " + shown(axis.from) + " is not below to = " + shown(axis.to) + " (one value needs from == to)");
}

void check_refine(const MapProblem& problem) {
  if (problem.refine == 0) return;
  demand_of_map(problem.refine >= 2, "refine = " + std::to_string(problem.refine) + " is below 2");
  demand_of_map(problem.start == MapStart::reset,
                "refine needs start = reset: carried states need every pixel of a row, random ones "
                "show other attractors at each");
  demand_of_map(problem.shards == 1, "refine needs shards = 1: what is computed next depends on all pixels before");
  demand_of_map(!problem.known || problem.finding_of, "known needs finding_of");
}

void check_one_model(const MapProblem& problem) {
  if (!problem.one_model) return;
  demand_of_map(problem.start == MapStart::reset, "one_model needs start = reset");
  demand_of_map(problem.keep_states, "one_model needs keep_states: a cycle is known by a state on it");
  demand_of_map(problem.shards == 1, "one_model needs shards = 1: all pixels depend on those that are looked at first");
  demand_of_map(!problem.known || (problem.finding_of && problem.carried_of), "known needs finding_of and carried_of");
}

}  // namespace

void check_map(const MapProblem& problem) {
  demand_of_map(problem.model_at != nullptr && problem.start_at != nullptr, "model_at and start_at must be given");
  check_axis("x", problem.x);
  check_axis("y", problem.y);
  constexpr double most_pixels = 0.5 * std::numeric_limits<std::int32_t>::max();
  demand_of_map(static_cast<double>(problem.x.count) * problem.y.count < most_pixels,
                "more pixels than one map can have");
  demand_of_map(problem.periods >= 20, "periods = " + std::to_string(problem.periods) + " is below 20");
  demand_of_map(problem.starts >= 2 || problem.start != MapStart::random,
                "starts = " + std::to_string(problem.starts) + " is below 2");
  demand_of_map(problem.start == MapStart::carry || problem.direction == Direction::up,
                "direction is for start = carry; else all directions are the same");
  demand_of_map(!problem.keep_states || problem.start != MapStart::random, "keep_states is not for start = random");
  demand_of_map(problem.of.size() == problem.statistics.size(), "every quantity needs a statistic");
  for (std::size_t k = 0; k < problem.of.size(); ++k) check_statistic_of_stretch(problem.of[k], problem.statistics[k]);
  demand_of_map(problem.measured_periods >= 1, "measured_periods must be positive");
  demand_of_map(problem.shards >= 1 && problem.shard >= 0 && problem.shard < problem.shards,
                "shard must be in 0 .. shards - 1");
  demand_of_map(problem.threads >= 0, "threads = " + std::to_string(problem.threads) + " is below 0");
  demand_of_map(!problem.known || problem.carried_of || problem.start != MapStart::carry, "known needs carried_of");
  check_refine(problem);
  check_one_model(problem);
}

namespace {

/// How the pixels of a problem are cut into tiles. With `carry` a chain goes through the columns of a band of rows, and
/// a tile is a column of the band; else a tile is a run of pixels.
class Tiling {
 public:
  explicit Tiling(const MapProblem& problem) : problem_(problem), carry_(problem.start == MapStart::carry) {
    const auto parts = [](long whole, long part) { return (whole + part - 1) / part; };
    const long pixels = static_cast<long>(problem.x.count) * problem.y.count;
    bands_ = static_cast<int>(carry_ ? parts(problem.y.count, band) : parts(pixels, run()));
    const int all = bands_ * directions();
    for (int chain = problem.shard; chain < all; chain += problem.shards) chains_.push_back(chain);
  }

  /// Of a refined map: these pixels only, in runs.
  Tiling(const MapProblem& problem, std::vector<std::int32_t> pixels) : problem_(problem), pixels_(std::move(pixels)) {
    const int tiles = (static_cast<int>(pixels_.size()) + run() - 1) / run();
    for (int tile = 0; tile < tiles; ++tile) chains_.push_back(tile);
  }

  [[nodiscard]] Chains chains() const {
    return {.chains = static_cast<int>(chains_.size()), .length = carry_ ? problem_.x.count : 1};
  }

  /// The pixels of a cell, without starts.
  [[nodiscard]] std::vector<PixelTask> tile(const Cell& cell) const {
    if (!pixels_.empty()) return listed(cell.chain * run());
    const int chain = chains_[static_cast<std::size_t>(cell.chain)], place = chain % bands_;
    std::vector<PixelTask> tasks;
    if (!carry_) {
      const int end = std::min((place + 1) * run(), problem_.x.count * problem_.y.count);
      for (int number = place * run(); number < end; ++number) tasks.push_back({number, Direction::up, {}});
      return tasks;
    }
    const Direction direction =
        problem_.direction == Direction::both ? (chain < bands_ ? Direction::up : Direction::down) : problem_.direction;
    const int ix = direction == Direction::up ? cell.step : problem_.x.count - 1 - cell.step;
    for (int iy = place * band; iy < std::min((place + 1) * band, problem_.y.count); ++iy)
      tasks.push_back({iy * problem_.x.count + ix, direction, {}});
    return tasks;
  }

  /// Pixels of all cells.
  [[nodiscard]] long size() const {
    long pixels = 0;
    for (int chain = 0; chain < chains().chains; ++chain) pixels += static_cast<long>(tile({chain, 0}).size());
    return pixels * chains().length;
  }

 private:
  static constexpr int band = 8;
  /// Pixels of a tile: some tens of milliseconds. Many pixels keep lanes full, many tiles keep threads busy.
  [[nodiscard]] int run() const {
    if (!runs_in_lanes(problem_)) return 4;
    const long all = static_cast<long>(problem_.x.count) * problem_.y.count;
    const long pixels = pixels_.empty() ? all : static_cast<long>(pixels_.size());
    return static_cast<int>(std::clamp(pixels / 64, 32L, 256L));
  }
  [[nodiscard]] int directions() const { return problem_.direction == Direction::both ? 2 : 1; }
  [[nodiscard]] std::vector<PixelTask> listed(int from) const {
    std::vector<PixelTask> tasks;
    for (int i = from; i < std::min(from + run(), static_cast<int>(pixels_.size())); ++i)
      tasks.push_back({pixels_[static_cast<std::size_t>(i)], Direction::up, {}});
    return tasks;
  }

  const MapProblem& problem_;
  bool carry_ = false;
  int bands_ = 0;
  std::vector<std::int32_t> pixels_;
  std::vector<int> chains_;
};

/// The pixels that are looked at first: a grid over the plane.
std::vector<std::int32_t> looked_at_first(const MapProblem& problem) {
  constexpr int side = 8;  // more find attractors of smaller share, and cost what Newton's method costs each
  std::vector<std::int32_t> pixels;
  const auto middle = [](int k, int parts, int count) {
    return static_cast<int>((2L * k + 1L) * count / (2L * parts));
  };
  const int rows = std::min(side, problem.y.count), columns = std::min(side, problem.x.count);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      pixels.push_back(middle(row, rows, problem.y.count) * problem.x.count + middle(column, columns, problem.x.count));
  return pixels;
}

/// One map while it runs.
class MapRun {
 public:
  explicit MapRun(const MapProblem& problem) : problem_(problem) {}

  bool operator()() {
    if (problem_.refine > 0) return run_refined();
    if (problem_.one_model && runs_in_lanes(problem_)) return run_after_first_look();
    const Tiling tiling(problem_);
    total_ = tiling.size();
    return run_tiling(tiling);
  }

 private:
  bool run_tiling(const Tiling& tiling) {
    const long to_do = done_ + tiling.size();
    const bool all = run_chains(
        tiling.chains(), problem_.threads,
        [&](const Cell& cell, const Starts& start, const HandOn& hand_on) { run_tile(tiling, cell, start, hand_on); },
        problem_.cancel);
    return all && done_ == to_do;
  }

  /// Some pixels, and then the others, to which the cycles of the first are known.
  bool run_after_first_look() {
    std::vector<std::int32_t> first = looked_at_first(problem_), others, unknown;
    total_ = static_cast<long>(problem_.x.count) * problem_.y.count;
    for (const std::int32_t pixel : first) {
      if (problem_.known && problem_.known(pixel, Direction::up))
        first_look_[pixel] = {problem_.finding_of(pixel, Direction::up), problem_.carried_of(pixel, Direction::up)};
      else
        unknown.push_back(pixel);
    }
    done_ = static_cast<long>(first.size() - unknown.size());
    looks_first_ = true;
    if (!unknown.empty() && !run_tiling(Tiling(problem_, std::move(unknown)))) return false;
    looks_first_ = false;
    const System system(problem_.model_at(problem_.x.from, problem_.y.from));
    KnownCycles cycles(system, problem_.classify);
    for (const auto& [pixel, seen] : first_look_)
      if (!seen.found.failed) cycles.add(seen.found, seen.state);
    known_cycles_ = &cycles;
    for (std::int32_t pixel = 0; pixel < total_; ++pixel)
      if (!first_look_.contains(pixel)) others.push_back(pixel);
    return others.empty() || run_tiling(Tiling(problem_, std::move(others)));
  }

  /// Round by round: what a round wants depends on all rounds before.
  bool run_refined() {
    Refinement refinement(problem_.x.count, problem_.y.count, problem_.refine);
    for (;;) {
      std::vector<std::int32_t> unknown;
      const std::vector<std::int32_t> wanted = refinement.wanted();
      if (wanted.empty()) return true;
      for (const std::int32_t pixel : wanted) {
        if (problem_.known && problem_.known(pixel, Direction::up))
          refinement.set(pixel, kinds_.number(problem_.finding_of(pixel, Direction::up)));
        else
          unknown.push_back(pixel);
      }
      total_ += static_cast<long>(wanted.size());
      done_ += static_cast<long>(wanted.size() - unknown.size());
      refinement_ = &refinement;
      if (!unknown.empty() && !run_tiling(Tiling(problem_, std::move(unknown)))) return false;
    }
  }

  void run_tile(const Tiling& tiling, const Cell& cell, const Starts& start, const HandOn& hand_on) {
    std::vector<PixelTask> tasks = tiling.tile(cell);
    for (std::size_t i = 0; i < tasks.size() && i < start.size(); ++i) tasks[i].start = start[i].state;
    const auto is_known = [&](const PixelTask& task) {
      return problem_.known && problem_.known(task.number, task.direction);
    };
    std::vector<PixelTask> unknown;
    ranges::copy_if(tasks, std::back_inserter(unknown), [&](const PixelTask& task) { return !is_known(task); });
    const std::vector<Pixel> pixels = analyse(problem_, unknown, known_cycles_);
    deliver(pixels, pixels.size() + tasks.size() - unknown.size());
    if (pixels.size() == unknown.size() && problem_.start == MapStart::carry) hand_on(starts_after(tasks, pixels));
  }

  /// What the next tile of a chain begins with: of new pixels and of known ones.
  [[nodiscard]] Starts starts_after(const std::vector<PixelTask>& tasks, const std::vector<Pixel>& pixels) const {
    Starts next;
    auto pixel = pixels.begin();
    for (const PixelTask& task : tasks) {
      const bool is_new = pixel != pixels.end() && pixel->number == task.number;
      next.push_back({is_new ? (pixel++)->carried : problem_.carried_of(task.number, task.direction)});
    }
    return next;
  }

  void deliver(const std::vector<Pixel>& pixels, std::size_t done) {
    const std::scoped_lock lock(delivery_);
    if (problem_.finished && !pixels.empty()) problem_.finished(pixels);
    if (looks_first_)
      for (const Pixel& pixel : pixels) first_look_[pixel.number] = {pixel.found.front(), pixel.carried};
    if (refinement_ != nullptr)
      for (const Pixel& pixel : pixels) refinement_->set(pixel.number, kinds_.number(pixel.found.front()));
    done_ += static_cast<long>(done);
    if (problem_.progress && done > 0) problem_.progress(done_, total_);
  }

  struct Seen {
    Finding found;
    State state;
  };

  const MapProblem& problem_;
  std::mutex delivery_;
  std::map<std::int32_t, Seen> first_look_;
  bool looks_first_ = false;
  const KnownCycles* known_cycles_ = nullptr;
  Refinement* refinement_ = nullptr;
  FindingKinds kinds_;
  long done_ = 0, total_ = 0;
};

}  // namespace

bool runs_in_lanes(const MapProblem& problem) {
  return problem.level == Level::quick && problem.start != MapStart::random;
}

long pixel_count(const MapProblem& problem) {
  const bool both = problem.start == MapStart::carry && problem.direction == Direction::both;
  return static_cast<long>(problem.x.count) * problem.y.count * (both ? 2 : 1);
}

bool run_tiles(const MapProblem& problem) {
  check_map(problem);
  return MapRun(problem)();
}

Map run_map(const MapProblem& problem) {
  MapBuilder builder(problem);
  MapProblem gathered = problem;
  gathered.finished = [&](std::span<const Pixel> pixels) {
    for (const Pixel& pixel : pixels) builder.add(pixel);
    if (problem.finished) problem.finished(pixels);
  };
  const bool complete = run_tiles(gathered);
  return builder.take(complete);
}

}  // namespace slapstick::sweep
