/// Gathers the pixels of a map, and fills in those that a refined one has not computed.
#include <algorithm>
#include <limits>
#include <tuple>

#include "section/settling.hpp"
#include "slapstick/sweep/map.hpp"
#include "sweep/finding_kinds.hpp"
#include "sweep/map_check.hpp"
#include "sweep/refinement.hpp"

namespace slapstick::sweep {

std::string Finding::label(bool driven) const {
  return failed ? "failed" : class_label(attractor, n, p, sticking, chatter, driven);
}

Finding Map::row(std::size_t i) const {
  if (stands_for.empty()) return findings[i];
  Finding found = findings[static_cast<std::size_t>(stands_for[i])];
  if (static_cast<std::size_t>(found.pixel) == i) return found;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  found.pixel = static_cast<std::int32_t>(i);
  found.filled = true;
  found.doubt = Doubt::none;
  found.exponent = none;
  found.multiplier = {none, none};
  found.values = width == 0 ? 0 : static_cast<std::int32_t>(values.size() / width - 1);  // the last row is NaN
  return found;
}

MapBuilder::MapBuilder(const MapProblem& problem) {
  check_map(problem);
  map_.x = problem.x;
  map_.y = problem.y;
  map_.driven = section::driven(problem.model_at(problem.x.from, problem.y.from));
  map_.width = problem.of.size();
  const auto pixels = static_cast<std::size_t>(pixel_count(problem));
  refine_ = problem.refine;
  if (refine_ > 0) return;
  map_.findings.reserve(pixels);
  map_.values.reserve(pixels * map_.width);
}

void MapBuilder::add(const Pixel& pixel) {
  const auto first = static_cast<std::int32_t>(map_.width == 0 ? 0 : map_.values.size() / map_.width);
  for (std::size_t k = 0; k < pixel.found.size(); ++k) {
    map_.findings.push_back(pixel.found[k]);
    map_.findings.back().values = first + static_cast<std::int32_t>(k);
  }
  map_.values.insert(map_.values.end(), pixel.values.begin(), pixel.values.end());
  if (!pixel.failure.empty()) map_.failures[{static_cast<int>(pixel.direction), pixel.number}] = pixel.failure;
}

Map MapBuilder::take(bool complete) {
  // In place: a stable sort would ask for half as much memory again. Findings of one pixel have ascending `values`.
  const auto place = [](const Finding& of) { return std::tuple(of.direction, of.pixel, of.values); };
  std::sort(map_.findings.begin(), map_.findings.end(),
            [&](const Finding& a, const Finding& b) { return place(a) < place(b); });
  map_.complete = complete && (refine_ == 0 || fill());
  return std::move(map_);
}

/// Goes through the rounds of the run once more. @returns false if a pixel is missing; then nothing is filled in
bool MapBuilder::fill() {
  std::vector<std::int32_t> places(static_cast<std::size_t>(map_.x.count) * static_cast<std::size_t>(map_.y.count), -1);
  for (std::size_t i = 0; i < map_.findings.size(); ++i)
    places[static_cast<std::size_t>(map_.findings[i].pixel)] = static_cast<std::int32_t>(i);
  Refinement refinement(map_.x.count, map_.y.count, refine_);
  FindingKinds kinds;
  for (auto wanted = refinement.wanted(); !wanted.empty(); wanted = refinement.wanted()) {
    for (const std::int32_t pixel : wanted) {
      const std::int32_t place = places[static_cast<std::size_t>(pixel)];
      if (place < 0) return false;
      refinement.set(pixel, kinds.number(map_.findings[static_cast<std::size_t>(place)]));
    }
  }
  map_.stands_for = refinement.sources();
  for (std::int32_t& source : map_.stands_for) source = places[static_cast<std::size_t>(source)];
  map_.values.resize(map_.values.size() + map_.width, std::numeric_limits<double>::quiet_NaN());
  return true;
}

}  // namespace slapstick::sweep
