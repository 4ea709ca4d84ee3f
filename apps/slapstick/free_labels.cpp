/// Finds places for labels where nothing else is drawn.
#include "free_labels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "base/ranges.hpp"
#include "frame_shares.hpp"

namespace slapstick::app {
namespace {

constexpr double cell_cm = 0.1;
constexpr double height_cm = 0.3;  ///< of a number

/// What is drawn, in cells of the paper.
class Drawn {
 public:
  void line(const figure::Line& line, const FrameShares& frame) {
    for (std::size_t i = 1; i < line.x.size(); ++i) {
      const PlaceOnPaper a = frame.cm(line.x[i - 1], line.y[i - 1]), b = frame.cm(line.x[i], line.y[i]);
      const double length = distance(a, b);
      if (!std::isfinite(length)) continue;
      const int pieces = 1 + static_cast<int>(length / cell_cm);
      for (int k = 0; k <= pieces; ++k) {
        const double part = static_cast<double>(k) / pieces;
        add({a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)});
      }
    }
  }
  void add(const PlaceOnPaper& place) {
    if (std::isfinite(place.x) && std::isfinite(place.y))
      cells_.emplace(static_cast<int>(std::lround(place.x / cell_cm)),
                     static_cast<int>(std::lround(place.y / cell_cm)));
  }
  [[nodiscard]] double distance_to(const PlaceOnPaper& place) const {
    double least = FrameShares::width_cm;
    for (const auto& [column, row] : cells_)
      least = std::min(least, distance(place, {column * cell_cm, row * cell_cm}));
    return least;
  }

 private:
  std::set<std::pair<int, int>> cells_;
};

/// A place of the picture, and where it lies on paper.
struct Candidate {
  double x = 0.0, y = 0.0;
  PlaceOnPaper at;
};

/// Places on the lines of a branch, not too many.
std::vector<Candidate> candidates(const figure::Panel& panel, std::size_t first, std::size_t last,
                                  const FrameShares& frame) {
  constexpr std::size_t most_candidates = 150;
  std::size_t points = 0;
  for (std::size_t i = first; i < last; ++i) points += panel.lines[i].x.size();
  const std::size_t every = 1 + points / most_candidates;
  std::vector<Candidate> all;
  std::size_t count = 0;
  for (std::size_t i = first; i < last; ++i)
    for (std::size_t k = 0; k < panel.lines[i].x.size(); ++k)
      if (count++ % every == 0)
        all.push_back({panel.lines[i].x[k], panel.lines[i].y[k], frame.cm(panel.lines[i].x[k], panel.lines[i].y[k])});
  return all;
}

/// How far a number is from what it might cover; beyond so much all places are alike.
double room(const Candidate& candidate, const Drawn& others) {
  const double edge = std::min({candidate.at.x, FrameShares::width_cm - candidate.at.x, candidate.at.y,
                                FrameShares::height_cm - candidate.at.y});
  constexpr double clear_space = 0.5;  // cm
  return std::min({others.distance_to(candidate.at), edge, clear_space});
}

/// A branch all of whose lines are of the size of its number is not covered by it: the number stands beside.
bool is_small(const figure::Panel& panel, std::size_t first, std::size_t last, const FrameShares& frame) {
  double longest = 0.0;
  for (std::size_t i = first; i < last; ++i) {
    const figure::Line& line = panel.lines[i];
    const PlaceOnPaper start = frame.cm(line.x.front(), line.y.front());
    for (std::size_t k = 0; k < line.x.size(); ++k)
      longest = std::max(longest, distance(frame.cm(line.x[k], line.y[k]), start));
  }
  return longest < 2.0 * height_cm;
}

/// Places about a place, inside the frame.
std::vector<Candidate> beside(const Candidate& place, const FrameShares& frame) {
  constexpr int directions = 16;
  std::vector<Candidate> all;
  const PlaceOnPaper unit = frame.cm(place.x + 1.0, place.y + 1.0);
  const double per_x = 1.0 / (unit.x - place.at.x), per_y = 1.0 / (unit.y - place.at.y);
  for (const double far : {1.2, 1.8, 2.4, 3.0})
    for (int k = 0; k < directions; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / directions;
      const double dx = far * height_cm * std::cos(angle), dy = far * height_cm * std::sin(angle);
      all.push_back({place.x + dx * per_x, place.y + dy * per_y, {place.at.x + dx, place.at.y + dy}});
    }
  return all;
}

}  // namespace

void add_branch_numbers(figure::Panel& panel, const std::vector<std::size_t>& first_line) {
  const FrameShares frame(panel);
  Drawn fixed;  // markers, and numbers as they come
  std::vector<figure::Line> leaders;
  for (const figure::Points& points : panel.points)
    for (std::size_t i = 0; points.over_lines && i < points.x.size(); ++i)
      fixed.add(frame.cm(points.x[i], points.y[i]));
  for (std::size_t b = 0; b < first_line.size(); ++b) {
    const std::size_t first = first_line[b], last = b + 1 < first_line.size() ? first_line[b + 1] : panel.lines.size();
    Drawn others = fixed;
    for (std::size_t i = 0; i < panel.lines.size(); ++i)
      if (i < first || i >= last) others.line(panel.lines[i], frame);
    std::vector<Candidate> places = candidates(panel, first, last, frame);
    if (places.empty()) continue;
    const Candidate middle = places[places.size() / 2];
    const bool small = is_small(panel, first, last, frame);
    if (small) {
      for (std::size_t i = first; i < last; ++i) others.line(panel.lines[i], frame);
      places = beside(middle, frame);
    }
    const auto best = ranges::max_element(places, {}, [&](const Candidate& c) { return room(c, others); });
    const figure::Colour colour = panel.lines[first].colour;
    if (small)
      leaders.push_back({.x = {middle.x, best->x}, .y = {middle.y, best->y}, .colour = colour, .width_pt = 0.3});
    panel.marks.push_back({.x = best->x, .y = best->y, .label = std::to_string(b + 1), .colour = colour});
    fixed.add(best->at);
  }
  panel.lines.insert(panel.lines.end(), leaders.begin(), leaders.end());
}

void add_names(figure::Panel& panel, const std::vector<NamedPlace>& places) {
  const FrameShares frame(panel);
  Drawn others;
  for (const figure::Line& line : panel.lines) others.line(line, frame);
  for (const NamedPlace& place : places) others.add(frame.cm(place.x, place.y));
  constexpr double one_place_cm = 0.15;
  std::vector<NamedPlace> named;
  for (const NamedPlace& place : places) {
    const auto is_here = [&](const NamedPlace& other) {
      return other.name == place.name &&
             distance(frame.cm(other.x, other.y), frame.cm(place.x, place.y)) < one_place_cm;
    };
    if (ranges::any_of(named, is_here)) continue;
    named.push_back(place);
    const std::vector<Candidate> about = beside({place.x, place.y, frame.cm(place.x, place.y)}, frame);
    const double half_cm = 0.08 * static_cast<double>(place.name.size());
    const auto room_for_text = [&](const Candidate& c) {  // a name is wider than high
      const double left = others.distance_to({c.at.x - half_cm, c.at.y});
      const double right = others.distance_to({c.at.x + half_cm, c.at.y});
      return std::min({room(c, others), left, right});
    };
    const auto best = ranges::max_element(about, {}, room_for_text);
    panel.lines.push_back({.x = {place.x, best->x}, .y = {place.y, best->y}, .width_pt = 0.3});
    panel.marks.push_back({.x = best->x, .y = best->y, .label = place.name, .colour = figure::colours::black});
    for (const double part : {-1.0, -0.5, 0.0, 0.5, 1.0}) others.add({best->at.x + part * half_cm, best->at.y});
  }
}

}  // namespace slapstick::app
