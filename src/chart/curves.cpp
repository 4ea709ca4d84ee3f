/// Finds the bifurcation curves behind the boundaries of a map.
#include "slapstick/chart/curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "base/ranges.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/orbit/search.hpp"

namespace slapstick::chart {
namespace {

struct Edge {
  int a = 0, b = 0;  ///< pixels; b is right of a, or above
  bool across = true;
  bool explained = false;
};

/// The pixels of a map with their classes.
class Pixels {
 public:
  explicit Pixels(const sweep::Map& map) : map_(map), places_(static_cast<std::size_t>(map.x.count) * map.y.count, -1) {
    for (std::size_t i = 0; i < map.findings.size(); ++i) {
      std::int32_t& place = places_[static_cast<std::size_t>(map.findings[i].pixel)];
      if (place < 0) place = static_cast<std::int32_t>(i);
      labels_.push_back(map.findings[i].label(map.driven));
    }
    if (!map.stands_for.empty()) places_ = map.stands_for;
  }

  [[nodiscard]] const std::string& label(int pixel) const {
    static const std::string none;
    const std::int32_t place = places_[static_cast<std::size_t>(pixel)];
    return place < 0 ? none : labels_[static_cast<std::size_t>(place)];
  }
  [[nodiscard]] bool is_cycle(int pixel) const {
    const std::int32_t place = places_[static_cast<std::size_t>(pixel)];
    return place >= 0 && map_.findings[static_cast<std::size_t>(place)].n > 0;
  }
  [[nodiscard]] double x(int pixel) const { return map_.x.value(pixel % map_.x.count); }
  [[nodiscard]] double y(int pixel) const { return map_.y.value(pixel / map_.x.count); }

  [[nodiscard]] std::vector<Edge> edges() const {
    std::vector<Edge> all;
    const int nx = map_.x.count, ny = map_.y.count;
    const auto look = [&](int a, int b, bool across) {
      if (label(a) != label(b) && (is_cycle(a) || is_cycle(b))) all.push_back({a, b, across});
    };
    for (int iy = 0; iy < ny; ++iy) {
      for (int ix = 0; ix < nx; ++ix) {
        if (ix + 1 < nx) look(iy * nx + ix, iy * nx + ix + 1, true);
        if (iy + 1 < ny) look(iy * nx + ix, (iy + 1) * nx + ix, false);
      }
    }
    return all;
  }

  /// In pixels from the middle of the first one.
  [[nodiscard]] double across(double x) const {
    return (x - map_.x.from) / (map_.x.to - map_.x.from) * (map_.x.count - 1);
  }
  [[nodiscard]] double up(double y) const { return (y - map_.y.from) / (map_.y.to - map_.y.from) * (map_.y.count - 1); }
  /// The pixel at such a place, or -1.
  [[nodiscard]] int at(double across, double up) const {
    const double ix = std::round(across), iy = std::round(up);
    if (!(ix >= 0.0 && ix < map_.x.count && iy >= 0.0 && iy < map_.y.count)) return -1;
    return static_cast<int>(iy) * map_.x.count + static_cast<int>(ix);
  }

 private:
  const sweep::Map& map_;
  std::vector<std::int32_t> places_;  // of each pixel the finding that it is, or that stands for it; -1: none
  std::vector<std::string> labels_;   // of each finding
};

struct Axis {
  const std::string& name;
  const sweep::GridAxis& range;
};

/// The two parameters in the order in which an edge is crossed: the first goes from pixel to pixel.
struct Order {
  Axis first, second;
};

/// The special point that a cycle meets on the way from one pixel to its neighbour.
std::optional<orbit::SpecialPoint> special_between(const Chart& chart, const Pixels& pixels, const Edge& edge,
                                                   bool from_a, const Order& order, const std::atomic<bool>* stop) {
  const int from = from_a ? edge.a : edge.b, to = from_a ? edge.b : edge.a;
  const auto first = [&](int pixel) { return edge.across ? pixels.x(pixel) : pixels.y(pixel); };
  const double second = edge.across ? pixels.y(from) : pixels.x(from), begin = first(from), end = first(to);
  Overrides values = chart.values;
  values[order.second.name] = second;
  const auto problem = orbit::pose(chart.definition.family({order.first.name}, values), {begin});
  const double x = pixels.x(from), y = pixels.y(from);
  const System system(chart.problem.model_at(x, y));
  const orbit::Settled settled = orbit::settle(*problem, system, chart.problem.start_at(x, y), {.stop = stop});
  if (!settled.orbit) return std::nullopt;
  orbit::ContinuationOptions how;
  const double width = std::abs(end - begin);
  how.from = std::max(order.first.range.from, std::min(begin, end) - width);
  how.to = std::min(order.first.range.to, std::max(begin, end) + width);
  how.most_points = 100;
  how.stop = stop;
  const orbit::Branch branch = orbit::follow(*problem, settled.orbit->orbit, how);
  std::optional<orbit::SpecialPoint> nearest;
  for (const orbit::SpecialPoint& special : branch.special) {
    const bool between = special.value >= std::min(begin, end) && special.value <= std::max(begin, end);
    if (between && (!nearest || std::abs(special.value - begin) < std::abs(nearest->value - begin))) nearest = special;
  }
  if (nearest) nearest->solution.orbit.values = {nearest->value, second};
  return nearest;
}

/// Its motions, with a break where points between them are none.
void keep_motions(const orbit::Curve& curve, std::size_t first_parameter, FoundCurve& found) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  bool goes_on = true;
  for (const orbit::CurvePoint& point : curve.points) {
    if (point.solution.is_motion && !goes_on && !found.x.empty()) found.x.push_back(none), found.y.push_back(none);
    goes_on = point.solution.is_motion;
    if (!goes_on) continue;
    found.x.push_back(point.values[first_parameter]);
    found.y.push_back(point.values[1 - first_parameter]);
  }
}

/// The curve of a special point over the chart, its motions only.
FoundCurve curve_of(const Chart& chart, const orbit::SpecialPoint& special, const Order& order, bool across,
                    const std::atomic<bool>* stop) {
  const auto problem = orbit::pose(chart.definition.family({order.first.name, order.second.name}, chart.values),
                                   special.solution.orbit.values);
  orbit::CurveOptions how{.from = order.first.range.from,
                          .to = order.first.range.to,
                          .second_from = order.second.range.from,
                          .second_to = order.second.range.to};
  how.most_points = 400;
  how.stop = stop;
  FoundCurve found{.type = special.type};
  keep_motions(orbit::locus(*problem, special, how), across ? 0 : 1, found);
  return found;
}

std::optional<FoundCurve> curve_at(const Chart& chart, const Pixels& pixels, const Edge& edge,
                                   const std::atomic<bool>* stop) {
  const Axis x{chart.x, chart.problem.x}, y{chart.y, chart.problem.y};
  const Order order = edge.across ? Order{x, y} : Order{y, x};
  for (const bool from_a : {true, false}) {
    if (!pixels.is_cycle(from_a ? edge.a : edge.b)) continue;
    try {
      const auto special = special_between(chart, pixels, edge, from_a, order, stop);
      if (!special) continue;
      FoundCurve found = curve_of(chart, *special, order, edge.across, stop);
      if (found.x.size() < 2) continue;
      found.from = pixels.label(edge.a);
      found.to = pixels.label(edge.b);
      return found;
    } catch (const NumericalError&) {  // this edge is left
    } catch (const InputError&) {
    }
  }
  return std::nullopt;
}

/// How far a point is from a segment.
double distance(double x, double y, double ax, double ay, double bx, double by) {
  const double dx = bx - ax, dy = by - ay, length = dx * dx + dy * dy;
  const double t = length > 0.0 ? std::clamp(((x - ax) * dx + (y - ay) * dy) / length, 0.0, 1.0) : 0.0;
  return std::hypot(x - ax - t * dx, y - ay - t * dy);
}

/// use(ax, ay, bx, by) for each segment, in pixels.
template <class Use>
void for_each_segment(const FoundCurve& curve, const Pixels& pixels, const Use& use) {
  for (std::size_t i = 0; i + 1 < curve.x.size(); ++i) {
    if (std::isnan(curve.x[i]) || std::isnan(curve.x[i + 1])) continue;
    use(pixels.across(curve.x[i]), pixels.up(curve.y[i]), pixels.across(curve.x[i + 1]), pixels.up(curve.y[i + 1]));
  }
}

void explain(FoundCurve& curve, const Pixels& pixels, std::vector<Edge>& edges) {
  for (Edge& edge : edges) {
    if (edge.explained) continue;
    const double x = 0.5 * (pixels.across(pixels.x(edge.a)) + pixels.across(pixels.x(edge.b)));
    const double y = 0.5 * (pixels.up(pixels.y(edge.a)) + pixels.up(pixels.y(edge.b)));
    for_each_segment(curve, pixels, [&](double ax, double ay, double bx, double by) {
      edge.explained = edge.explained || distance(x, y, ax, ay, bx, by) <= 1.0;
    });
    curve.edges += edge.explained ? 1 : 0;
  }
}

/// Looks at the pixels on both sides, a pixel apart along the curve and one off it.
void compare_sides(FoundCurve& curve, const Pixels& pixels) {
  double since = 1.0;
  for_each_segment(curve, pixels, [&](double ax, double ay, double bx, double by) {
    const double length = std::hypot(bx - ax, by - ay);
    if (length == 0.0) return;
    const double nx = -(by - ay) / length, ny = (bx - ax) / length;
    double at = 1.0 - since;
    for (; at < length; at += 1.0) {
      const double x = ax + (bx - ax) * at / length, y = ay + (by - ay) * at / length;
      const int one = pixels.at(x + nx, y + ny), other = pixels.at(x - nx, y - ny);
      if (one >= 0 && other >= 0) ++(pixels.label(one) != pixels.label(other) ? curve.differ : curve.alike);
    }
    since = 1.0 - (at - length);
  });
}

using Pair = std::pair<std::string, std::string>;

/// The unexplained edges of the pair of classes that has most of them. Pairs in `given_up` are left out.
std::vector<std::size_t> largest_boundary(const Pixels& pixels, const std::vector<Edge>& edges,
                                          const std::set<Pair>& given_up, Pair& pair) {
  constexpr std::size_t least = 4;  // edges: shorter boundaries are left
  std::map<Pair, std::vector<std::size_t>> all;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (!edges[i].explained) all[std::minmax(pixels.label(edges[i].a), pixels.label(edges[i].b))].push_back(i);
  std::vector<std::size_t> largest;
  for (auto& [classes, places] : all) {
    if (given_up.contains(classes) || places.size() < std::max(least, largest.size() + 1)) continue;
    largest = places;
    pair = classes;
  }
  return largest;
}

}  // namespace

Curves find_curves(const Chart& chart, const sweep::Map& map, int most, const std::atomic<bool>* stop) {
  if (chart.problem.start != sweep::MapStart::reset) throw InputError("curves: start = reset is needed");
  const auto stopped = [&] { return stop != nullptr && stop->load(); };
  const Pixels pixels(map);
  std::vector<Edge> edges = pixels.edges();
  Curves found;
  found.edges = static_cast<long>(edges.size());
  std::set<Pair> given_up;
  while (static_cast<int>(found.curves.size()) < most && !stopped()) {
    Pair pair;
    const std::vector<std::size_t> places = largest_boundary(pixels, edges, given_up, pair);
    if (places.empty()) break;
    std::optional<FoundCurve> curve;
    for (const double share : {0.5, 0.25, 0.75}) {
      curve = curve_at(chart, pixels,
                       edges[places[static_cast<std::size_t>(share * static_cast<double>(places.size()))]], stop);
      if (curve) compare_sides(*curve, pixels);
      if (curve && curve->differ > curve->alike) break;  // else it is hidden where it runs, or is not this boundary
      ++found.without;
      curve.reset();
    }
    if (!curve) {
      given_up.insert(pair);
      continue;
    }
    explain(*curve, pixels, edges);
    if (curve->edges == 0) given_up.insert(pair);
    found.curves.push_back(std::move(*curve));
  }
  found.explained = ranges::count_if(edges, [](const Edge& edge) { return edge.explained; });
  found.stopped = stopped();
  return found;
}

}  // namespace slapstick::chart
