/// Makes basins of the pixels of a plane of starts.
#include "slapstick/sweep/basins.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/ranges.hpp"
#include "model/fault.hpp"
#include "section/settling.hpp"
#include "slapstick/base/error.hpp"
#include "sweep/attractors.hpp"
#include "sweep/map_check.hpp"

namespace slapstick::sweep {

MapProblem starts_over(const Model& model, const State& start, const StartAxis& x, const StartAxis& y) {
  if (x.place >= start.size() || y.place >= start.size() || x.place == y.place)
    throw InputError("basins: the axes need two different numbers of the state");
  MapProblem problem;
  problem.x = x.values;
  problem.y = y.values;
  problem.keep_states = true;
  problem.one_model = true;
  problem.model_at = [model](double, double) { return model; };
  problem.start_at = [start, x = x.place, y = y.place](double of_x, double of_y) {
    State state = start;
    state[x] = of_x;
    state[y] = of_y;
    return state;
  };
  return problem;
}

long Basins::count(std::int32_t what) const { return ranges::count(of, what); }

BasinBuilder::BasinBuilder(const MapProblem& problem)
    : problem_(problem), model_((check_map(problem), problem.model_at(problem.x.from, problem.y.from))) {
  if (!problem.keep_states) throw InputError("basins: keep_states must be set, as starts_over does");
  basins_.x = problem.x;
  basins_.y = problem.y;
  basins_.driven = section::driven(model_);
  basins_.of.assign(static_cast<std::size_t>(pixel_count(problem)), Basins::missing);
}

/// A start that the stops forbid is no failure.
std::int32_t BasinBuilder::kind_of(std::int32_t pixel, const Finding& found) const {
  if (!found.failed) return Basins::undecided;
  const State start = problem_.start_at(problem_.x_at(pixel), problem_.y_at(pixel));
  const std::optional<Fault> fault = first_fault(model_, start);
  return fault && fault->behind_stop ? Basins::inadmissible : Basins::failed;
}

void BasinBuilder::add(const Pixel& pixel) {
  const Finding& found = pixel.found.front();
  if (found.failed || found.attractor == Attractor::undecided) {
    const std::int32_t kind = basins_.of[static_cast<std::size_t>(pixel.number)] = kind_of(pixel.number, found);
    if (kind == Basins::failed) basins_.failures[pixel.number] = pixel.failure;
    return;
  }
  if (pixel.carried.size() != 2 * static_cast<std::size_t>(model_.size()))
    throw InputError("basins: a pixel has no state; keep_states must be set where it is computed");
  found_.push_back(found);
  found_.back().values = static_cast<std::int32_t>(found_.size() - 1);  // place of its state
  states_.insert(states_.end(), pixel.carried.begin(), pixel.carried.end());
}

namespace {

/// What a state on an attractor is, for its numbers: those of the pixel are its class alone. Also of a run that was
/// stopped: it is short.
Classification classified(const MapProblem& problem, const System& system, const Finding& found, const State& state) {
  constexpr int rounds = 5;  // of the cycle: half of the periods are left out
  ClassifyOptions options = problem.classify;
  options.cancel = nullptr;
  options.progress = {};
  return classify_quickly(system, state, std::max(problem.periods, rounds * found.n), options);
}

/// Its class stays that of the pixel: near the border of two classes rounding may name another.
Classification attractor_of(const MapProblem& problem, const System& system, const Finding& found, const State& state) {
  Classification attractor = classified(problem, system, found, state);
  const std::string label = found.label(section::driven(system));
  if (attractor.label != label) {
    attractor = {};
    attractor.attractor = found.attractor;
    attractor.n = found.n;
    attractor.p = found.p;
    attractor.sticking = found.sticking;
    attractor.chatter = found.chatter;
    attractor.label = label;
    attractor.exponent = found.exponent;
    attractor.period = section::driven(system) ? found.n * system.period() : 0.0;
  }
  attractor.state = state;
  return attractor;
}

/// Wilson's interval of 95 % for a share.
void set_share(long of_all, Basin& basin) {
  constexpr double z = 1.959963984540054;
  const auto n = static_cast<double>(of_all), p = static_cast<double>(basin.starts) / n;
  const double middle = (p + z * z / (2.0 * n)) / (1.0 + z * z / n);
  const double half = z / (1.0 + z * z / n) * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
  basin.share = p;
  basin.share_from = std::max(0.0, middle - half);
  basin.share_to = std::min(1.0, middle + half);
}

/// Most starts first; of equal ones that with the first pixel.
void order(Basins& basins) {
  std::vector<std::int32_t> places(basins.basins.size()), rank(basins.basins.size());
  std::iota(places.begin(), places.end(), 0);
  const auto more = [&](std::int32_t a, std::int32_t b) {
    const Basin &one = basins.basins[static_cast<std::size_t>(a)], &other = basins.basins[static_cast<std::size_t>(b)];
    return one.starts != other.starts ? one.starts > other.starts : one.first < other.first;
  };
  std::sort(places.begin(), places.end(), more);
  std::vector<Basin> sorted;
  for (const std::int32_t place : places) {
    rank[static_cast<std::size_t>(place)] = static_cast<std::int32_t>(sorted.size());
    sorted.push_back(std::move(basins.basins[static_cast<std::size_t>(place)]));
  }
  basins.basins = std::move(sorted);
  for (std::int32_t& of : basins.of)
    if (of >= 0) of = rank[static_cast<std::size_t>(of)];
}

}  // namespace

Basins BasinBuilder::take() {
  std::sort(found_.begin(), found_.end(), [](const Finding& a, const Finding& b) { return a.pixel < b.pixel; });
  const System system(model_);
  Attractors known(system);
  for (const double x : {problem_.x.from, problem_.x.to})
    for (const double y : {problem_.y.from, problem_.y.to}) known.reach(problem_.start_at(x, y));
  const auto width = static_cast<std::ptrdiff_t>(2 * model_.size());
  for (const Finding& found : found_) {
    const auto first = states_.begin() + found.values * width;
    const State state(first, first + width);
    int place = known.find(found.attractor, found.label(basins_.driven), state);
    if (place < 0) {
      basins_.basins.push_back({attractor_of(problem_, system, found, state), found.pixel});
      Basin& basin = basins_.basins.back();
      basin.by_class = Attractors::by_class(basin.attractor);
      place = known.add(basin.attractor);
    }
    ++basins_.basins[static_cast<std::size_t>(place)].starts;
    basins_.of[static_cast<std::size_t>(found.pixel)] = place;
  }
  const auto outside = [](std::int32_t of) { return of == Basins::inadmissible || of == Basins::missing; };
  const long all = static_cast<long>(basins_.of.size()) - ranges::count_if(basins_.of, outside);
  for (Basin& basin : basins_.basins) set_share(all, basin);
  order(basins_);
  basins_.complete = basins_.count(Basins::missing) == 0;
  return std::move(basins_);
}

Basins run_basins(const MapProblem& problem) {
  BasinBuilder builder(problem);
  MapProblem gathered = problem;
  gathered.finished = [&](std::span<const Pixel> pixels) {
    for (const Pixel& pixel : pixels) builder.add(pixel);
    if (problem.finished) problem.finished(pixels);
  };
  (void)run_tiles(gathered);
  return builder.take();
}

}  // namespace slapstick::sweep
