/// Figures 2, 6, 8 and the comparison with the print: bifurcation diagrams along omega.
#include "base/decimal.hpp"
#include "base/text.hpp"
#include "io/table.hpp"
#include "reproduce/diagrams.hpp"
#include "reproduce/figures.hpp"

namespace slapstick::paper {

sweep::Diagram diagram(const Study& study, const Overrides& with, const Range& range, int share, int shares) {
  sweep::DiagramProblem problem;
  problem.model_at = [&study, with](double omega) {
    Overrides all = with;
    all["omega"] = omega;
    return study.definition().build(all);
  };
  problem.start_at = [&study](double) { return study.rest(); };
  problem.from = range.from;
  problem.to = range.to;
  problem.count = range.values;
  problem.impacts = range.impacts;
  problem.transient_periods = range.transient_periods;
  problem.direction = sweep::Direction::both;
  problem.threads = study.options().threads;
  problem.cancel = study.options().cancel;
  problem.progress = [&study, share, shares](int done, int total) {
    study.course().step(share * total + done, shares * total);
  };
  sweep::Diagram done = run_diagram(problem);
  if (!done.complete) throw Interrupted{};
  return done;
}

namespace {

using figure::Panel;
using figure::Points;

/// Nine digits: enough to redraw a figure, and half the bytes; `slapstick diagram` gives all seventeen.
std::string short_number(double value) {
  std::string text;
  append_digits(text, value, 9);
  return text;
}

/// Every impact: omega, direction, w, flight, sliding.
void write_impacts(const std::filesystem::path& path, const sweep::Diagram& diagram) {
  CsvWriter table(path, {"omega", "direction", "w", "flight", "sliding"});
  for (const sweep::DiagramPoint& point : diagram.points) {
    const std::string omega = shown(point.parameter);
    const char* direction = point.direction == sweep::Direction::up ? "up" : "down";
    for (std::size_t i = 0; i < point.impacts.size(); ++i) {
      const auto row = point.impacts[i];
      table.word(omega).word(direction).word(short_number(row.w));
      table.word(short_number(row.flight)).word(short_number(row.sliding)).end_row();
    }
  }
  table.commit();
}

using Quantity = double (*)(const sweep::ImpactTable::Row&);
double paper_velocity(const sweep::ImpactTable::Row& row) { return -row.w; }  // x2' - x1' just before the impact
double flight(const sweep::ImpactTable::Row& row) { return row.flight; }
double sliding(const sweep::ImpactTable::Row& row) { return row.sliding; }
double resting(const sweep::ImpactTable::Row& row) { return row.flight - row.sliding; }

/// One cloud per direction.
std::vector<Points> clouds(const sweep::Diagram& diagram, Quantity quantity, bool labels) {
  std::vector<Points> out(2);
  out[0].colour = figure::colours::dark_blue;
  out[1].colour = figure::colours::vermillion;
  if (labels) {
    out[0].label = "ω up";
    out[1].label = "ω down";
  }
  for (const sweep::DiagramPoint& point : diagram.points) {
    Points& cloud = out[point.direction == sweep::Direction::up ? 0 : 1];
    for (std::size_t i = 0; i < point.impacts.size(); ++i) {
      cloud.x.push_back(point.parameter);
      cloud.y.push_back(quantity(point.impacts[i]));
    }
  }
  for (Points& cloud : out) cloud.drawing = figure::Drawing::raster;
  return out;
}

Panel panel(const sweep::Diagram& diagram, Quantity quantity, const std::string& tag, const std::string& y_label,
            bool labels) {
  Panel out;
  out.tag = tag;
  out.x_label = omega_label;
  out.y_label = y_label;
  out.points = clouds(diagram, quantity, labels);
  if (!labels) out.legend = figure::Legend::none;
  return out;
}

/// The windows that the paper prints.
void mark_windows(Panel& panel, bool labels) {
  figure::Mark stick;
  stick.x = 1.47;
  stick.x_end = 1.60;
  if (labels) stick.label = "1.47–1.60";
  panel.marks.push_back(stick);
  for (const double edge : {0.55, 1.12, 2.84}) {
    figure::Mark line;
    line.x = edge;
    if (labels) line.label = shown(edge);
    panel.marks.push_back(line);
  }
}

}  // namespace

void fig2(Study& study) {
  const Range range{0.3, 10.0, study.sizes().fig2_values, study.sizes().fig2_impacts};
  const sweep::Diagram found = diagram(study, {}, range);
  write_impacts(study.file("fig2-impacts.csv"), found);

  figure::Figure picture;
  picture.width_cm = 17.5;
  picture.height_cm = 13.0;
  picture.share_x = true;
  picture.caption = "Bifurcation diagrams (f_s = 0.15); grey: the windows that the paper prints.";
  picture.panels = {panel(found, flight, "(a)", "{/:Italic ω t}_f / 2π", true),
                    panel(found, paper_velocity, "(b)", velocity_label, false)};
  picture.panels[0].legend = figure::Legend::bottom_right;
  mark_windows(picture.panels[0], true);
  mark_windows(picture.panels[1], false);
  study.add({"fig2", picture});

  picture.caption =
      "Both readings of t_f: time between impacts, the time of sliding in it, and what is left: the time in stick.";
  picture.height_cm = 17.0;
  picture.panels = {panel(found, flight, "(a)", "flight {/:Italic ω t}_f / 2π", true),
                    panel(found, sliding, "(b)", "part in slip", false),
                    panel(found, resting, "(c)", "part in stick", false)};
  picture.panels[0].legend = figure::Legend::bottom_right;
  study.add({"fig2-sliding", picture});
}

void fig6(Study& study) {
  const std::pair<double, double> ranges[] = {{2.80, 3.10}, {4.70, 4.90}, {6.60, 6.70}};
  const char* tags[] = {"(a)", "(b)", "(c)"};
  figure::Figure picture;
  picture.width_cm = 17.5;
  picture.height_cm = 7.0;
  picture.columns = 3;
  picture.caption = "Routes from n-1-I motions to chaos (f_s = 0.15).";
  for (int i = 0; i < 3; ++i) {
    const Range range{ranges[i].first, ranges[i].second, study.sizes().fig6_values, study.sizes().fig6_impacts,
                      study.sizes().fig6_transient};
    const sweep::Diagram found = diagram(study, {}, range, i, 3);
    write_impacts(study.file(std::string("fig6") + "abc"[i] + "-impacts.csv"), found);
    picture.panels.push_back(panel(found, paper_velocity, tags[i], i == 0 ? velocity_label : "", i == 0));
  }
  picture.panels.front().legend = figure::Legend::below;  // three entries are wider than a third of the page
  study.add({"fig6", picture});
}

void fig8(Study& study) {
  figure::Figure picture;
  picture.width_cm = 17.5;
  picture.height_cm = 20.0;
  picture.columns = 2;
  picture.share_x = true;
  picture.caption = "Bifurcation diagrams for different dry friction f_s = f_k.";
  int i = 0;
  for (const double friction : friction_values) {
    const Range range{0.56, 10.0, study.sizes().fig8_values, study.sizes().fig8_impacts};
    const sweep::Diagram found = diagram(study, {{"friction", friction}}, range, i, 6);
    write_impacts(study.file("fig8-friction-" + shown(friction) + ".csv"), found);
    Panel one =
        panel(found, paper_velocity, std::string("(") + "abcdef"[i] + ")", i % 2 == 0 ? velocity_label : "", i == 0);
    one.title = "{/:Italic f}_s = " + shown(friction);
    one.y_range = figure::Range{-2.6, 0.1};
    picture.panels.push_back(std::move(one));
    ++i;
  }
  study.add({"fig8", picture});
}

void fig_printed(Study& study) {
  const std::pair<const char*, Overrides> cases[] = {
      {"{/:Italic r} = 0.8, {/:Italic f}_k = {/:Italic f}_s = 0.15", {}},
      {"{/:Italic r} = 0.08 as printed", {{"restitution", 0.08}}},
      {"{/:Italic r} = 0.8, {/:Italic f}_k = 0.1 < {/:Italic f}_s = 0.15", {{"kinetic_friction", 0.1}}}};
  figure::Figure picture;
  picture.width_cm = 17.5;
  picture.height_cm = 16.0;
  picture.share_x = true;
  picture.caption =
      "The diagram of Fig. 2 with the values used here, with the printed restitution, and with f_k below f_s.";
  for (int i = 0; i < 3; ++i) {
    const Range range{0.3, 10.0, study.sizes().fig8_values, study.sizes().fig8_impacts};
    const sweep::Diagram found = diagram(study, cases[i].second, range, i, 3);
    write_impacts(study.file(std::string("print-") + "abc"[i] + "-impacts.csv"), found);
    Panel one = panel(found, flight, std::string("(") + "abc"[i] + ")", "{/:Italic ω t}_f / 2π", i == 0);
    one.title = cases[i].first;
    if (i == 0) one.legend = figure::Legend::bottom_right;
    mark_windows(one, false);
    picture.panels.push_back(std::move(one));
  }
  study.add({"print", picture});
}

}  // namespace slapstick::paper
