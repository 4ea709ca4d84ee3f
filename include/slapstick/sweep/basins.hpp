#pragma once
/// Basins of attraction: which attractor the motion from each start of a grid comes to.
///
///     const Model model = load_model("vibro-impact").build();
///     sweep::MapProblem problem = sweep::starts_over(model, start, {0, {-0.5, 0.5, 400}}, {1, {-1.0, 1.0, 400}});
///     const sweep::Basins found = sweep::run_basins(problem);
///     for (const sweep::Basin& basin : found.basins) use(basin.attractor.label, basin.share);
///
/// A pixel is a start: the axes give two numbers of the state, `start` the others. Each start is analysed as a pixel of
/// a map is (sweep/map.hpp): a cycle counts once Newton's method confirms it and the motion closes in on it at the rate
/// of its multipliers. Starts belong to one basin if they come to one attractor. Two cycles are one if a state of the
/// first lies on the second (docs, section 1). Members of a continuum of cycles, what friction holds at rest and
/// chaotic motions are told apart by their class only.
///
/// Nothing depends on threads. Cost: that of a map of as many pixels, and some microseconds a pixel for the comparison.
/// Source: docs/howto/basins.md; Daza et al. (2016) for the entropy, McDonald et al. (1985) for the exponent.
#include "slapstick/sweep/map.hpp"

namespace slapstick::sweep {

/// An axis of starts: a number of the user's state, x1, v1, x2, .., and its values.
struct StartAxis {
  std::size_t place = 0;
  GridAxis values;
};

/// The starts of a plane. What remains to be chosen are level, periods, classify, threads, and what takes results.
[[nodiscard]] MapProblem starts_over(const Model& model, const State& start, const StartAxis& x, const StartAxis& y);

/// The starts that come to one attractor.
struct Basin {
  Classification attractor;
  std::int32_t first = 0;  ///< its first pixel
  bool by_class = false;   ///< all that have this class: a continuum, what friction holds, chaos
  long starts = 0;         ///< how many pixels it has
  double share = 0.0;      ///< of the starts that are admissible and were looked at
  /// Wilson's interval of 95 %, as if the starts were independent.
  double share_from = 0.0, share_to = 1.0;
};

struct Basins {
  /// What a pixel is that belongs to no basin.
  static constexpr std::int32_t undecided = -1, inadmissible = -2, failed = -3, missing = -4;

  GridAxis x, y;
  bool driven = true;
  std::vector<Basin> basins;                     ///< that with most starts first
  std::vector<std::int32_t> of;                  ///< of each pixel the place of its basin, or one of the numbers above
  std::map<std::int32_t, std::string> failures;  ///< by pixel; a stop that forbids a start is no failure
  bool complete = true;                          ///< false if it was cancelled: some pixels are missing

  [[nodiscard]] long count(std::int32_t what) const;
};

/// Gathers pixels that come in any order.
class BasinBuilder {
 public:
  /// @param problem  of starts_over; must outlive this object
  explicit BasinBuilder(const MapProblem& problem);
  void add(const Pixel& pixel);
  /// Compares the attractors, in the order of the pixels.
  [[nodiscard]] Basins take();

 private:
  [[nodiscard]] std::int32_t kind_of(std::int32_t pixel, const Finding& found) const;

  const MapProblem& problem_;
  Model model_;
  Basins basins_;
  std::vector<Finding> found_;
  std::vector<double> states_;
  std::vector<std::string> failures_;
};

/// @throws InputError as run_map
[[nodiscard]] Basins run_basins(const MapProblem& problem);

/// How hard it is to say where a start of a box of pixels goes: -sum p ln p over the basins, p the share of each.
struct BasinEntropy {
  int box = 5;            ///< side in pixels
  long boxes = 0;         ///< whole ones, every pixel of which belongs to a basin
  long on_boundary = 0;   ///< .. to several
  double whole = 0.0;     ///< mean over all boxes
  double boundary = 0.0;  ///< .. over those with several basins, at most ln of how many a box meets; NaN if none has
};
/// @param box  >= 2
[[nodiscard]] BasinEntropy basin_entropy(const Basins& basins, int box = 5);

/// How the share of uncertain starts falls with the error of a start: f(e) ~ e^exponent. The boundary's dimension in
/// the plane is 2 - exponent; a smooth one has exponent 1.
struct Uncertainty {
  std::vector<int> distances;  ///< in pixels: 1, 2, 4, ..
  /// Pairs of starts so far apart along an axis that belong to different basins, of as many as there are starts, along
  /// both axes. Not counted is a pair that only a boundary within the largest distance of the rim parts.
  std::vector<double> shares;
  double exponent =
      0.0;  ///< of the straight line of least squares through the logarithms; NaN below three, or if one is 0
  double error = 0.0;  ///< standard error of that fit: how the shares scatter, no bound
};
[[nodiscard]] Uncertainty uncertainty(const Basins& basins);

}  // namespace slapstick::sweep
