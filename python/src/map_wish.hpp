#pragma once
/// What charts and planes of starts are asked for, as the caller has it.
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "slapstick/base/error.hpp"
#include "slapstick/sweep/map.hpp"

namespace slapstick::python {

struct Wish {
  std::string x_name, y_name;
  std::tuple<double, double, int> x, y;
  std::string level, rule, direction;
  int periods, starts;
  std::uint64_t seed;
  int most_n, transient, most_periods, exponent_periods, measured_periods;
  std::vector<std::string> stops;
  std::vector<Quantity> of;
  std::vector<std::string> statistics;
  int shard, shards, threads, refine;
  std::string store;
  bool resume;
};

template <class T>
T one_of(const std::string& argument, const std::string& word, const std::vector<std::pair<std::string, T>>& words) {
  std::string known;
  for (const auto& [name, value] : words) {
    if (name == word) return value;
    known += (known.empty() ? "" : ", ") + name;
  }
  throw InputError(argument + ": '" + word + "' is none of " + known);
}

inline sweep::GridAxis axis_of(const std::tuple<double, double, int>& of) {
  return {std::get<0>(of), std::get<1>(of), std::get<2>(of)};
}

/// How each pixel is analysed, and on how many threads.
inline void analyse_as(const Wish& wish, const Model& model, sweep::MapProblem& problem) {
  problem.level =
      one_of<sweep::Level>("level", wish.level, {{"quick", sweep::Level::quick}, {"full", sweep::Level::full}});
  problem.periods = wish.periods;
  problem.classify.most_n = wish.most_n;
  problem.classify.transient_periods = wish.transient;
  problem.classify.most_periods = wish.most_periods;
  problem.classify.exponent_periods = wish.exponent_periods;
  problem.classify.stops = StopChoice(model, wish.stops);
  problem.threads = wish.threads;
}

}  // namespace slapstick::python
