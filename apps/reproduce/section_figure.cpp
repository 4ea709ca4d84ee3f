/// Figure 7: points of the impact section at 4.801 (two fixed points) and 4.805 (two closed invariant curves).
#include "base/text.hpp"
#include "io/table.hpp"
#include "reproduce/figures.hpp"
#include "slapstick/section/impact_section.hpp"

namespace slapstick::paper {
namespace {

constexpr int transient_periods = 10'000;  // the circle at 4.805 attracts weakly

/// Every second impact belongs to the same fixed point or curve: even and odd ones, as phase (in degrees) and -w.
struct Halves {
  std::vector<double> phase[2], velocity[2];
};

Halves impacts(Study& study, double omega, int count, const std::string& table_name) {
  const System system = study.system({}, omega);
  Motion motion(system, study.rest());
  while (motion.advance({transient_periods, 0.0}) == Outcome::event) {
  }
  ImpactSection section(std::move(motion));
  CsvWriter table(study.file(table_name), {"time", "phase", "w", "x1", "v1", "x2", "v2"});
  Halves out;
  SectionPoint point;
  for (int k = 0; k < count && section.next({transient_periods + 100LL * count, 0.0}, point); ++k) {
    if (k % 1000 == 0) study.course().check();
    out.phase[k % 2].push_back(360.0 * point.phase);
    out.velocity[k % 2].push_back(-point.w);
    table.number(point.time.seconds(system.period()))
        .number(point.phase)
        .number(point.w)
        .numbers(point.state)
        .end_row();
  }
  table.commit();
  return out;
}

figure::Points cloud(const Halves& all, int half, double diameter_mm) {
  figure::Points points;
  points.x = all.phase[half];
  points.y = all.velocity[half];
  points.colour = half == 0 ? figure::colours::dark_blue : figure::colours::vermillion;
  points.drawing = figure::Drawing::discs;
  points.diameter_mm = diameter_mm;
  return points;
}

figure::Panel axes(const std::string& tag) {
  figure::Panel panel;
  panel.tag = tag;
  panel.x_label = "phase at impact [degrees]";
  panel.y_label = velocity_label;
  panel.legend = figure::Legend::none;
  return panel;
}

}  // namespace

void fig7(Study& study) {
  const Halves fixed = impacts(study, 4.801, 200, "fig7-4.801.csv");
  const Halves curves = impacts(study, 4.805, study.sizes().fig7_impacts, "fig7-4.805.csv");
  figure::Figure picture;
  picture.columns = 2;
  picture.width_cm = 17.5;
  picture.height_cm = 13.0;
  picture.caption =
      "Impact section: (a) omega = 4.801, two fixed points; (b) omega = 4.805, two invariant curves; (c), (d) each of "
      "them.";
  picture.panels = {axes("(a)"), axes("(b)"), axes("(c)"), axes("(d)")};
  for (int half = 0; half < 2; ++half) {
    picture.panels[0].points.push_back(cloud(fixed, half, 1.0));
    picture.panels[1].points.push_back(cloud(curves, half, 0.3));
    picture.panels[static_cast<std::size_t>(2 + half)].points.push_back(cloud(curves, half, 0.3));
  }
  picture.panels[0].title = "{/:Italic ω} = 4.801";
  for (int i = 1; i < 4; ++i) picture.panels[static_cast<std::size_t>(i)].title = "{/:Italic ω} = 4.805";
  study.add({"fig7", picture});
}

}  // namespace slapstick::paper
