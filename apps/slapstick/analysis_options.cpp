/// Reads how pixels are analysed.
#include "analysis_options.hpp"

#include "slapstick/base/error.hpp"

namespace slapstick::app {

void AnalysisOptions::declare(Arguments& arguments) {
  arguments.choice(
      "--level", level, {"quick", "full"},
      "quick: a cycle that Newton's method confirms within --periods, or undecided; full: as `classify` (quick)");
  arguments
      .count("--periods", periods, 20, 1'000'000'000, "forcing periods within which a cycle is to be confirmed (300)")
      .with({"--level quick"});
  arguments.count("--transient", transient, 0, 1'000'000'000, "as `classify` (500)").with({"--level full"});
  arguments.count("--most-periods", most_periods, 10, 1'000'000'000, "as `classify` (20000)").with({"--level full"});
  arguments.count("--exponent-periods", exponent_periods, 400, 100'000'000, "as `classify` (4000)")
      .with({"--level full"});
  arguments.count("--most-n", most_n, 1, 4096, "longest cycle sought, in forcing periods or returns (64)");
  stops.declare(arguments, "count the impacts of this stop only; may be repeated (all)");
}

Work AnalysisOptions::work() const {
  constexpr double least_search = 10.0;  // periods
  if (level == "quick") return {static_cast<double>(periods), "--periods"};
  return {static_cast<double>(transient) + least_search, "--transient"};
}

void AnalysisOptions::apply(const Model& model, sweep::MapProblem& problem) const {
  problem.level = level == "quick" ? sweep::Level::quick : sweep::Level::full;
  problem.periods = static_cast<int>(periods);
  problem.classify.transient_periods = static_cast<int>(transient);
  problem.classify.most_periods = static_cast<int>(most_periods);
  problem.classify.exponent_periods = static_cast<int>(exponent_periods);
  problem.classify.most_n = static_cast<int>(most_n);
  problem.classify.stops = stops.choice(model);
}

}  // namespace slapstick::app
