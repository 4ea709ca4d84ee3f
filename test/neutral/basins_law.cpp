/// The law between `basins` and `classify`: a start belongs to the basin of the attractor that its own motion comes to.
#include <algorithm>
#include <complex>

#include "base/text.hpp"
#include "neutral/laws.hpp"
#include "neutral/spectrum.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/motion.hpp"
#include "slapstick/sweep/basins.hpp"
#include "sweep/attractors.hpp"

namespace slapstick::neutral {
namespace {

using sweep::Basin;
using sweep::Basins;

/// More starts than the 8 x 8 whose cycles are then known to the others.
constexpr int across = 10;
constexpr int every = 7;  ///< of these starts is compared: in all columns, since 7 and 10 have no common divisor

const ClassifyOptions long_search{.transient_periods = 100, .most_periods = 1000, .most_n = 16, .exponent_periods = 0};

/// A plane of the first coordinate about the file's own start. A smaller plane meets fewer attractors: with 0.5 and 1
/// in place of these numbers 2 of 50 files had several basins.
sweep::MapProblem plane(const Model& model, const State& start) {
  constexpr double far = 3.0, fast = 3.0;
  sweep::MapProblem problem = sweep::starts_over(model, start, {0, {start[0] - far, start[0] + far, across}},
                                                 {1, {start[1] - fast, start[1] + fast, across}});
  problem.classify.most_n = long_search.most_n;
  problem.periods = 100;  // a start that takes longer is undecided, and not compared
  problem.threads = 1;
  return problem;
}

bool admissible(const System& system, const State& start) {
  try {
    const Motion motion(system, start);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Do starts 1e-9 away come to something else? Then the start is on a boundary, and rounding decides.
bool on_boundary(const System& system, const State& start, const std::string& label) {
  for (const double part : {-1e-9, 1e-9}) {
    State beside = start;
    beside[0] += part, beside[1] -= part;
    if (!admissible(system, beside) || classify(system, beside, long_search).label != label) return true;
  }
  return false;
}

bool same_multipliers(const Classification& one, const Classification& other) {
  constexpr double half_the_digits = 1e-5;
  Spectrum left = other.multipliers;
  return left.size() == one.multipliers.size() &&
         std::ranges::all_of(one.multipliers, [&](const std::complex<double>& multiplier) {
           return std::abs(*take_nearest(left, multiplier) - multiplier) <= half_the_digits;
         });
}

/// What speaks against a start's basin; "" if nothing does.
/// @param reached  from which all motions begin: the size of what rounding leaves of a place
std::string against(const System& system, const Basin& basin, const State& start, const sweep::MapProblem& reached) {
  const Classification found = classify(system, start, long_search);
  if (found.attractor == Attractor::undecided) return "";
  const auto said = [&](const std::string& what) {
    return on_boundary(system, start, found.label)
               ? ""
               : what + " of a start (" + shown(start[0]) + ", " + shown(start[1]) + ")";
  };
  if (found.label != basin.attractor.label) return said("basin " + basin.attractor.label + ", class " + found.label);
  const bool by_class = sweep::Attractors::by_class(found);
  if (basin.by_class != by_class) return said(found.label + " that is one of a family to one verb only");
  if (by_class) return "";
  sweep::Attractors attractors(system);
  for (std::int32_t pixel = 0; pixel < across * across; ++pixel)
    attractors.reach(reached.start_at(reached.x_at(pixel), reached.y_at(pixel)));
  const int place = attractors.add(basin.attractor);
  if (attractors.find(found.attractor, found.label, found.state) != place)
    return said("basin of another " + found.label + " than classify's");
  return same_multipliers(basin.attractor, found) ? "" : said("other multipliers of " + found.label);
}

}  // namespace

std::optional<std::string> basins_classify(const ModelDefinition& definition, const Question& question) {
  constexpr std::size_t many_events = 60;  // in five periods: a hundred motions would take a minute
  if (ask(Verb::simulate, definition, question).rows.size() > many_events) return std::nullopt;
  const System system(definition.build());
  const sweep::MapProblem problem = plane(system.model(), definition.start());
  const Basins found = sweep::run_basins(problem);
  bool compared = false;
  for (std::int32_t pixel = 0; pixel < across * across; pixel += every) {
    const std::int32_t place = found.of[static_cast<std::size_t>(pixel)];
    const State start = problem.start_at(problem.x_at(pixel), problem.y_at(pixel));
    if (admissible(system, start) == (place == Basins::inadmissible))
      return "a start (" + shown(start[0]) + ", " + shown(start[1]) +
             ") is admissible to basins or to simulate, and not to the other";
    if (place < 0) continue;
    if (std::string said = against(system, found.basins[static_cast<std::size_t>(place)], start, problem);
        !said.empty())
      return said;
    compared = true;
  }
  return compared ? std::optional<std::string>("") : std::nullopt;
}

}  // namespace slapstick::neutral
