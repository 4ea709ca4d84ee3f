#pragma once
/// Two-parameter charts: what the motion is at every pixel of a grid of two parameters, on all cores, with the same
/// bits on any number.
///
///     sweep::MapProblem problem;
///     problem.model_at = [&](double omega, double friction) { return definition.build({{"omega", omega}, ..}); };
///     problem.start_at = [&](double omega, double friction) { return definition.start({{"omega", omega}, ..}); };
///     problem.x = {1.0, 6.0, 400}, problem.y = {0.05, 0.3, 300};
///     const sweep::Map map = sweep::run_map(problem);
///     for (const sweep::Finding& found : map.findings) use(map.x_of(found), map.y_of(found), found.label(map.driven));
///
/// `quick` names within `periods` periods a cycle that Newton's method confirms, or says undecided. Its periods run in
/// the lanes of a batch (sweep/batch.hpp) where lanes take the model, else it is `classify_quickly`. `full` is
/// `classify`. Both have the same words; where both decide they agree.
///
///   reset   every pixel begins at the problem's own start;
///   carry   a pixel begins where its neighbour in the row ended up, going up or down through x; up and down together
///           show coexisting attractors;
///   random  several starts at every pixel, and every attractor that is found: the first start is the problem's own,
///           the others are random admissible states about it, which depend on the pixel's model and the seed only.
///
/// With `refine` a map computes a coarse grid and then only where classes differ; the other pixels are filled in.
/// A filled pixel is wrong only if the whole region of its class, pixels that hang together by edges, holds no computed
/// pixel; a region that holds a pixel of the coarse grid is right to the last pixel.
///
/// A pixel depends on its own start only and is kept under its number: nothing depends on threads, on shards or on what
/// was known before. Cost: of `quick` some 0.4 ms a pixel for the paper's system, docs/howto/charts.md.
/// Source: docs/howto/charts.md.
#include <atomic>
#include <complex>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "slapstick/attractor/classify.hpp"
#include "slapstick/quantity/measure.hpp"
#include "slapstick/sweep/diagram.hpp"

namespace slapstick::sweep {

/// Equidistant values; both ends are values. from < to and count >= 2, or from == to and count 1.
struct GridAxis {
  double from = 0.0, to = 1.0;
  int count = 2;
  [[nodiscard]] double value(int i) const { return sweep_value(from, to, count, i); }
};

enum class Level { quick, full };
enum class MapStart { reset, carry, random };

/// What one motion is at a pixel, or one of the attractors there.
struct Finding {
  std::int32_t pixel = 0;               ///< iy * x.count + ix
  Direction direction = Direction::up;  ///< in which the start was carried; else up
  Attractor attractor = Attractor::undecided;
  Doubt doubt = Doubt::none;
  Chatter chatter = Chatter::none;
  bool sticking = false;
  bool failed = false;  ///< the reason is in Map::failures; nothing else is meant
  /// Not computed: attractor, n, p, chatter, sticking and failed are what all computed pixels of the cell around have
  /// in common; the rest is not known, its numbers are NaN.
  bool filled = false;
  std::int32_t n = 0, p = 0;             ///< as of Classification
  std::int32_t starts = 1;               ///< of `random`: how many of them lead there
  std::int32_t values = 0;               ///< place of its statistics among Map::values, in rows
  double exponent = 0.0;                 ///< as of Classification; NaN where `quick` knows none
  std::complex<double> multiplier = {};  ///< of a cycle the largest; else NaN

  /// "1-1-II", "chaotic", ..; "failed". @param driven  false: "free-1-I"
  [[nodiscard]] std::string label(bool driven = true) const;
};

/// All that is known of one pixel in one direction.
struct Pixel {
  std::int32_t number = 0;  ///< iy * x.count + ix
  Direction direction = Direction::up;
  std::vector<Finding> found;  ///< one; of `random` one for each attractor, the one with most starts first
  std::vector<double> values;  ///< of each finding each of MapProblem::of; NaN where a measure fails
  std::string failure;         ///< one line, what the NumericalError or InputError said; else empty
  /// Where the motion ended up, on its attractor at phase 0: of `carry`, for the next pixel of the row, and of
  /// `keep_states`. Empty: not known.
  State carried;
};

struct MapProblem {
  std::function<Model(double x, double y)> model_at;  ///< called from several threads at once
  std::function<State(double x, double y)> start_at;  ///< likewise
  GridAxis x, y;
  /// `model_at` gives one model everywhere, as in a plane of starts: cycles that a first look of some pixels finds are
  /// known to the others, whose motions are sooner seen to come to them. Which pixels are looked at first depends on
  /// the problem only. Of `reset` with keep_states, without shards; of `full` and with `refine` no cycle is known.
  bool one_model = false;
  Level level = Level::quick;
  int periods = 300;  ///< of `quick`: within which a cycle is to be confirmed, >= 20
  /// Of both levels most_n and stops, of `full` all except cancel and progress.
  ClassifyOptions classify = {};
  MapStart start = MapStart::reset;
  Direction direction = Direction::up;  ///< of `carry`
  bool keep_states = false;             ///< each pixel has its Pixel::carried; not of `random`
  int starts = 2;                       ///< of `random`, >= 2
  std::uint64_t seed = 1;
  /// Measured over the cycle, or, where there is no cycle, over `measured_periods` on; a statistic of each.
  std::vector<Quantity> of = {};
  std::vector<std::string> statistics = {};
  int measured_periods = 100;
  /// Of `reset`, without shards: side of the coarse cells in pixels, >= 2; 0: every pixel is computed. Which pixels are
  /// computed depends on the problem only.
  int refine = 0;
  /// Only every `shards`-th tile, beginning with number `shard` of 0 .. shards - 1. A tile is a run of pixels, of
  /// `carry` a band of rows; what belongs to which shard depends on the problem only.
  int shard = 0, shards = 1;
  int threads = 0;  ///< 0: all
  /// Whether a pixel need not be computed, because a run before has it; and of `carry` and `one_model` its
  /// Pixel::carried. Called from any thread.
  std::function<bool(std::int32_t number, Direction)> known = {};
  std::function<State(std::int32_t number, Direction)> carried_of = {};
  /// Of `refine` and `one_model`: what a known pixel is. Called from the caller's thread.
  std::function<Finding(std::int32_t number, Direction)> finding_of = {};
  /// Takes each tile as it is finished, from any of the threads, but never two at once; of a run that is stopped the
  /// finished pixels of a tile.
  std::function<void(std::span<const Pixel>)> finished = {};
  /// Called after every tile with the numbers of pixels done and to do, never two at once. With `refine` the number of
  /// those to do grows: it is what is wanted so far.
  std::function<void(long done, long total)> progress = {};
  const std::atomic<bool>* cancel = nullptr;  ///< set it and the map returns soon with what is complete

  /// The parameters of a pixel, iy * x.count + ix.
  [[nodiscard]] double x_at(std::int32_t pixel) const { return x.value(pixel % x.count); }
  [[nodiscard]] double y_at(std::int32_t pixel) const { return y.value(pixel / x.count); }
};

struct Map {
  GridAxis x, y;
  bool driven = true;
  std::vector<Finding> findings;                                 ///< by direction (up first), pixel, and starts
  std::size_t width = 0;                                         ///< statistics of each finding
  std::vector<double> values;                                    ///< row by row
  std::map<std::pair<int, std::int32_t>, std::string> failures;  ///< by direction and pixel
  bool complete = true;                                          ///< false if cancelled; a shard is complete by itself
  /// Of a refined map that is complete: for each pixel the place among `findings` of the computed one that stands for
  /// it. Else empty.
  std::vector<std::int32_t> stands_for;

  /// The motions of all pixels, filled ones included, and the i-th of them: those of `findings`, or one a pixel.
  [[nodiscard]] std::size_t rows() const { return stands_for.empty() ? findings.size() : stands_for.size(); }
  [[nodiscard]] Finding row(std::size_t i) const;
  [[nodiscard]] double x_of(const Finding& found) const { return x.value(found.pixel % x.count); }
  [[nodiscard]] double y_of(const Finding& found) const { return y.value(found.pixel / x.count); }
  [[nodiscard]] std::span<const double> values_of(const Finding& found) const {
    return {values.data() + static_cast<std::size_t>(found.values) * width, width};
  }
};

/// Gathers pixels that come in any order.
class MapBuilder {
 public:
  explicit MapBuilder(const MapProblem& problem);
  void add(const Pixel& pixel);
  /// In order; a refined map with its other pixels filled in, and incomplete if a pixel for that is missing.
  /// @param complete  as of Map
  [[nodiscard]] Map take(bool complete);

 private:
  bool fill();

  Map map_;
  int refine_ = 0;
};

/// Whether pixels are computed in lanes where the model allows; their bits are not those of a Motion.
[[nodiscard]] bool runs_in_lanes(const MapProblem& problem);

/// Pixels that a whole problem has, in all directions.
[[nodiscard]] long pixel_count(const MapProblem& problem);

/// Runs the map and gives each tile to `finished`; keeps nothing. A failure at one pixel is noted there and ends
/// nothing; the next pixel of a row then begins where this one began.
/// @returns whether it is complete
/// @throws InputError for a meaningless problem, naming the field; what `finished` and `progress` throw
bool run_tiles(const MapProblem& problem);

/// The same, gathered. Memory: 64 bytes a computed pixel and 8 a statistic; with `refine` 8 more for every pixel.
[[nodiscard]] Map run_map(const MapProblem& problem);

}  // namespace slapstick::sweep
