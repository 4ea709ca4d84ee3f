/// Continued branches over the brute-force diagram; the bounds of windows over friction.
#include <cmath>

#include "io/table.hpp"
#include "reproduce/branches.hpp"
#include "reproduce/diagrams.hpp"
#include "reproduce/figures.hpp"

namespace slapstick::paper {
namespace {

/// Pieces of equal stability and number of impacts, a line for each impact.
void add_lines(figure::Panel& panel, const NBranch& of, figure::Colour colour) {
  const auto& points = of.branch.points;
  for (std::size_t begin = 0; begin < points.size();) {
    const std::size_t impacts = of.speeds[begin].size();
    std::size_t end = begin + 1;
    while (end < points.size() && of.speeds[end].size() == impacts && points[end].stable() == points[begin].stable())
      ++end;
    for (std::size_t k = 0; k < impacts; ++k) {
      figure::Line line{.colour = colour,
                        .dash = points[begin].stable() ? figure::Dash::solid : figure::Dash::dashed,
                        .width_pt = points[begin].stable() ? 1.2 : 0.6};
      const std::size_t last = end < points.size() && of.speeds[end].size() == impacts ? end : end - 1;
      for (std::size_t i = begin; i <= last; ++i) {
        line.x.push_back(points[i].orbit.parameter());
        line.y.push_back(of.speeds[i][k]);
      }
      if (line.x.size() > 1) panel.lines.push_back(std::move(line));
    }
    begin = end;
  }
}

void write_branches(Study& study, const Branches& branches) {
  CsvWriter table(study.file("branches.csv"), {"n", "omega", "class", "stable", "largest_multiplier", "impact", "w"});
  for (const NBranch& of : branches.all) {
    for (std::size_t i = 0; i < of.branch.points.size(); ++i) {
      const orbit::Solution& point = of.branch.points[i];
      for (std::size_t k = 0; k < of.speeds[i].size(); ++k)
        table.number(of.n)
            .number(point.orbit.parameter())
            .word(point.label)
            .word(point.stable() ? "yes" : "no")
            .number(point.multipliers.empty() ? 0.0 : std::abs(point.multipliers.front()))
            .number(static_cast<double>(k + 1))
            .number(of.speeds[i][k])
            .end_row();
    }
  }
  table.commit();
}

constexpr figure::Colour palette[] = {figure::colours::dark_blue, figure::colours::vermillion, figure::colours::green,
                                      figure::colours::purple, figure::colours::orange};

struct Sign {
  orbit::SpecialType type;
  figure::Marker marker;
};
constexpr Sign signs[] = {{orbit::SpecialType::LP, figure::Marker::square},
                          {orbit::SpecialType::PD, figure::Marker::disc},
                          {orbit::SpecialType::NS, figure::Marker::diamond},
                          {orbit::SpecialType::GR, figure::Marker::delta}};

/// The special points of a type at their fastest impact; in the legend if there are any.
void add_special_points(figure::Panel& panel, const Branches& branches, const Sign& sign) {
  constexpr double diameter_mm = 1.3;
  figure::Points points{
      .drawing = figure::Drawing::discs, .diameter_mm = diameter_mm, .marker = sign.marker, .over_lines = true};
  points.colour = figure::colours::black;
  for (const NBranch& of : branches.all)
    for (const orbit::SpecialPoint& point : of.branch.special) {
      if (point.type != sign.type || point.after >= of.speeds.size() || of.speeds[point.after].empty()) continue;
      points.x.push_back(point.value);
      points.y.push_back(of.speeds[point.after].front());
    }
  if (points.x.empty()) return;
  panel.keys.push_back({.label = std::string(name(sign.type)), .marker = sign.marker, .size = diameter_mm, .group = 2});
  panel.points.push_back(std::move(points));
}

/// Where a curve ends inside of the picture, because the orbit is no motion beyond.
void add_ends(figure::Points& ends, const orbit::Curve& curve, const figure::Range& y_range) {
  const auto& points = curve.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].solution.is_motion) continue;
    const bool before = i > 0 && !points[i - 1].solution.is_motion;
    const bool behind = i + 1 < points.size() && !points[i + 1].solution.is_motion;
    const double y = points[i].values[1];
    if (!(before || behind) || y <= y_range.min || y >= y_range.max) continue;
    ends.x.push_back(points[i].values[0]);
    ends.y.push_back(y);
  }
}

}  // namespace

void fig_branches(Study& study, const Branches& branches) {
  write_branches(study, branches);
  const bool quick = study.options().quick;
  const sweep::Diagram brute = diagram(study, {}, {0.9, 10.0, quick ? 120 : 1200, quick ? 20 : 60});
  figure::Panel panel{.x_label = omega_label, .y_label = "impact speed {/:Italic w}"};
  figure::Points cloud{.colour = figure::colours::light_grey, .diameter_mm = 0.3};
  for (const sweep::DiagramPoint& point : brute.points) {
    for (std::size_t i = 0; i < point.impacts.size(); ++i) {
      cloud.x.push_back(point.parameter);
      cloud.y.push_back(point.impacts[i].w);
    }
  }
  panel.points.push_back(std::move(cloud));
  for (std::size_t b = 0; b < branches.all.size(); ++b) {
    add_lines(panel, branches.all[b], palette[b]);
    panel.keys.push_back(
        {.label = std::to_string(branches.all[b].n) + "-1", .colour = palette[b], .size = 1.4, .group = 1});
  }
  for (const Sign& sign : signs) add_special_points(panel, branches, sign);
  panel.keys.push_back({.label = "stable", .size = 1.2});
  panel.keys.push_back({.label = "unstable", .size = 0.6, .dash = figure::Dash::dashed});
  panel.keys.push_back(
      {.label = "attractors", .colour = figure::colours::light_grey, .marker = figure::Marker::disc, .size = 0.9});
  panel.legend = figure::Legend::below;
  panel.y_range = figure::Range{0.0, 2.0};
  figure::Figure picture;
  picture.width_cm = 17.5;
  picture.height_cm = 10.0;
  picture.caption =
      "Branches of n-1 orbits over the attractors: stable solid, unstable dashed; special points by name.";
  picture.panels.push_back(std::move(panel));
  study.add({"branches", picture});
}

void fig_bounds(Study& study, const Branches& branches) {
  figure::Panel panel{.x_label = omega_label, .y_label = "friction {/:Italic f}_s = {/:Italic f}_k"};
  panel.y_range = figure::Range{0.0, 0.5};
  figure::Points ends{.label = "beyond: another sequence of events",
                      .colour = figure::colours::black,
                      .drawing = figure::Drawing::discs,
                      .diameter_mm = 1.1,
                      .marker = figure::Marker::circle,
                      .over_lines = true};
  CsvWriter table(study.file("bounds.csv"), {"curve", "omega", "friction"});
  for (std::size_t b = 0; b < branches.bounds.size(); ++b) {
    figure::Line line{.label = branches.bounds[b].label,
                      .colour = palette[b / 2],
                      .dash = b % 2 == 0 ? figure::Dash::dash_dotted : figure::Dash::solid,
                      .width_pt = 1.2};
    for (const orbit::CurvePoint& point : branches.bounds[b].curve.points) {
      line.x.push_back(point.solution.is_motion ? point.values[0]
                                                : std::nan(""));  // a gap where the orbit is no motion
      line.y.push_back(point.values[1]);
      table.word("\"" + branches.bounds[b].label + "\"").number(point.values[0]).number(point.values[1]).end_row();
    }
    panel.lines.push_back(std::move(line));
    add_ends(ends, branches.bounds[b].curve, *panel.y_range);
  }
  table.commit();
  if (!ends.x.empty()) panel.points.push_back(std::move(ends));
  panel.legend = figure::Legend::below;
  figure::Figure picture;
  picture.width_cm = 12.0;
  picture.height_cm = 8.0;
  picture.caption =
      "Bounds of the 1-1 and 2-1 windows over friction: where the next impact appears (GR) and where the orbit doubles "
      "(PD).";
  picture.panels.push_back(std::move(panel));
  study.add({"bounds", picture});
}

}  // namespace slapstick::paper
