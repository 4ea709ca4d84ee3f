/// Figures 3, 4 and 5: time series of the relative displacement and velocity, and the phase portrait.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/ranges.hpp"
#include "io/table.hpp"
#include "reproduce/figures.hpp"

namespace slapstick::paper {
namespace {

constexpr double gap = std::numeric_limits<double>::quiet_NaN();

/// A curve in (t, y, w); NaN between its pieces. t in forcing periods.
struct Curve {
  std::vector<double> t, y, w;
  void add(double time, double displacement, double velocity) {
    t.push_back(time);
    y.push_back(displacement);
    w.push_back(velocity);
  }
  void lift() { add(gap, gap, gap); }
};

struct Impact {
  double t, w;
};

/// Some periods of a settled motion, taken apart by what happens.
struct Record {
  Curve slip, stick, jump;                        ///< jump: from w to -r w at an impact
  std::vector<std::pair<double, double>> sticks;  ///< begin and end
  std::vector<Impact> impacts;
  std::vector<std::pair<double, double>> chatters;  ///< limit time, bound on its error, both in periods
};

bool at_rest(const System& system, ModeId mode) {
  const mode::ContactStates states = system.states(mode);
  return ranges::find(states.frictions, mode::FrictionState::stick) != states.frictions.end() ||
         ranges::find(states.stops, mode::StopState::closed) != states.stops.end();
}

class Recorder {
 public:
  Recorder(const System& system, std::int64_t settle, const std::filesystem::path& table)
      : system_(system), begin_{settle, 0.0}, table_(table, {"time", "x1", "v1", "x2", "v2", "mode"}) {}

  Record operator()(Motion motion, int periods) {
    while (motion.advance(begin_) == Outcome::event) {
    }
    Outcome outcome = Outcome::event;
    while (outcome == Outcome::event) {
      const long before = motion.counters().segments;
      outcome = motion.advance(Instant{begin_.period + periods, 0.0});
      if (motion.counters().segments != before) sample(motion);
      if (outcome == Outcome::event) note(motion);
    }
    table_.commit();
    return std::move(record_);
  }

 private:
  void sample(const Motion& motion) {
    const Motion::Segment segment = motion.segment();
    const bool rests = at_rest(system_, segment.mode);
    Curve& curve = rests ? record_.stick : record_.slip;
    const double start = segment.start.since(begin_), length = segment.duration / system_.period();
    const int steps = std::max(24, static_cast<int>(std::ceil(length * 800.0)));
    const std::string mode = system_.mode_name(segment.mode);
    std::vector<double> x(4);
    for (int k = 0; k <= steps; ++k) {
      motion.sample(segment.duration * k / steps, x);
      const double t = start + length * k / steps;
      curve.add(t, x[0] - x[2], rests ? 0.0 : x[1] - x[3]);
      table_.number(t * system_.period()).numbers(x).word(mode).end_row();
    }
    curve.lift();
    if (rests) record_.sticks.emplace_back(start, start + length);
  }

  void note(const Motion& motion) {
    const Event& event = motion.event();
    const double t = event.time.since(begin_);
    if (event.kind == EventKind::impact) {
      const auto before = motion.before();
      const double y = before[0] - before[2];
      record_.impacts.push_back({t, event.w});
      const double r = system_.model().stops[0].restitution;
      constexpr int parts = 50;  // so that a magnified panel cuts it well
      for (int k = 0; k <= parts; ++k) record_.jump.add(t, y, event.w - (1.0 + r) * event.w * k / parts);
      record_.jump.lift();
    }
    if (event.kind == EventKind::chatter) record_.chatters.emplace_back(t, event.error / system_.period());
  }

  const System& system_;
  Instant begin_;
  CsvWriter table_;
  Record record_;
};

using Column = std::vector<double> Curve::*;

figure::Line line(const Curve& curve, Column x, Column y) {
  return {curve.*x, curve.*y, "", figure::colours::black, figure::Dash::solid, 0.8};
}

/// Slip, stick and jumps in one pair of axes.
figure::Panel draw(const Record& record, Column x, Column y) {
  figure::Panel panel;
  figure::Line jump = line(record.jump, x, y), slip = line(record.slip, x, y), stick = line(record.stick, x, y);
  slip.colour = figure::colours::dark_blue;
  stick.colour = figure::colours::vermillion;
  stick.width_pt = 2.0;
  jump.colour = figure::colours::grey;
  jump.dash = figure::Dash::dashed;
  if (y != &Curve::y) panel.lines.push_back(jump);
  panel.lines.push_back(slip);
  if (x == &Curve::y) {  // in the phase plane a stick is a point
    figure::Points rests{record.stick.y, record.stick.w, "", figure::colours::vermillion, figure::Drawing::discs, 1.2};
    if (!record.sticks.empty()) panel.points.push_back(std::move(rests));
  } else if (!record.sticks.empty()) {
    panel.lines.push_back(stick);
  }
  panel.legend = figure::Legend::none;
  return panel;
}

const std::string time_label = "forcing periods {/:Italic ωt} / 2π";
const std::string y_label = "{/:Italic x}_1 – {/:Italic x}_2";
const std::string w_label = "{/:Italic v}_1 – {/:Italic v}_2";

/// y(t), w(t), w(y).
std::vector<figure::Panel> triple(const Record& record, const std::string& tags) {
  figure::Panel y = draw(record, &Curve::t, &Curve::y), w = draw(record, &Curve::t, &Curve::w);
  figure::Panel phase = draw(record, &Curve::y, &Curve::w);
  y.x_label = w.x_label = time_label;
  y.y_label = phase.x_label = y_label;
  w.y_label = phase.y_label = w_label;
  figure::Panel* panels[] = {&y, &w, &phase};
  for (int i = 0; i < 3; ++i) panels[i]->tag = std::string("(") + tags[static_cast<std::size_t>(i)] + ")";
  for (figure::Panel* panel : {&y, &w}) {
    for (const auto& [from, to] : record.sticks) {
      figure::Mark span;
      span.x = from;
      span.x_end = to;
      panel->marks.push_back(span);
    }
  }
  return {y, w, phase};
}

/// The same over all recorded periods, with the keys above.
std::vector<figure::Panel> overview(const Record& record, const std::string& tags, int periods) {
  std::vector<figure::Panel> panels = triple(record, tags);
  panels[0].lines[0].label = "slip";
  if (!record.sticks.empty()) panels[0].lines[1].label = "stick";
  panels[1].lines[0].label = "impact";
  for (std::size_t i : {0U, 1U}) {
    panels[i].legend = figure::Legend::above;
    panels[i].x_range = figure::Range{0.0, static_cast<double>(periods)};
  }
  return panels;
}

/// The surroundings of the first stick phase.
std::vector<figure::Panel> stick_panels(const Record& record, const std::string& tags) {
  if (record.sticks.empty()) return {};
  std::vector<figure::Panel> panels = triple(record, tags);
  const auto [from, to] = record.sticks.front();
  const double y = record.stick.y.front();
  panels[0].x_range = panels[1].x_range = figure::Range{from - 0.1, to + 0.06};
  panels[0].y_range = panels[2].x_range = figure::Range{y - 0.006, y + 0.002};
  panels[1].y_range = panels[2].y_range = figure::Range{-0.03, 0.03};
  return panels;
}

/// The chatter of one period, magnified: y(t), w(t), and the speeds of the impacts.
std::vector<figure::Panel> chatter_panels(const Record& record, const std::string& tags) {
  if (record.chatters.empty()) return {};
  const double limit = record.chatters.front().first;
  std::vector<figure::Panel> panels = triple(record, tags);
  panels[0].x_range = panels[1].x_range = figure::Range{limit - 0.12, limit + 0.05};
  panels[0].y_range = figure::Range{-0.004, 0.0004};
  panels[1].y_range = figure::Range{-0.08, 0.08};
  figure::Panel speeds;
  speeds.tag = panels[2].tag;
  speeds.x_label = "impact of the burst";
  speeds.y_label = "impact speed {/:Italic w}";
  speeds.log_y = true;
  figure::Points points;
  for (const Impact& impact : record.impacts) {
    if (impact.t > limit) break;
    points.x.push_back(static_cast<double>(points.x.size() + 1));
    points.y.push_back(impact.w);
  }
  speeds.x_range = figure::Range{0.0, static_cast<double>(points.x.size() + 1)};
  points.diameter_mm = 0.9;
  speeds.points = {points};
  panels[2] = speeds;
  return panels;
}

Record record(Study& study, double omega, int periods, const std::string& stem) {
  constexpr std::int64_t settle = 500;
  const System system = study.system({}, omega);
  return Recorder(system, settle, study.file(stem + "-trajectory.csv"))(Motion(system, study.rest()), periods);
}

std::vector<figure::Panel> joined(std::vector<figure::Panel> first, const std::vector<figure::Panel>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

figure::Figure in_rows(std::vector<figure::Panel> panels, const std::string& caption) {
  figure::Figure picture;
  picture.columns = 3;
  picture.width_cm = 17.5;
  const std::size_t rows = (panels.size() + 2) / 3;
  picture.height_cm = 5.8 * static_cast<double>(rows);
  picture.panels = std::move(panels);
  picture.caption = caption;
  return picture;
}

}  // namespace

void fig3_to_5(Study& study) {
  const Record stick = record(study, 1.5, 2, "fig3");
  study.add({"fig3", in_rows(joined(overview(stick, "abc", 2), stick_panels(stick, "def")),
                             "1-1-II motion, omega = 1.5; (d)-(f): the stick phase magnified")});
  study.course().step(1, 4);

  const Record text = record(study, 2.2, 2, "fig4"), caption = record(study, 2.0, 2, "fig4-caption");
  study.add({"fig4", in_rows(joined(overview(text, "abc", 2), overview(caption, "def", 2)),
                             "1-1-I motion: (a)-(c) omega = 2.2 (text), (d)-(f) omega = 2 (caption)")});
  study.course().step(2, 4);

  const Record chatter = record(study, 0.552, 2, "fig5");
  study.add({"fig5", in_rows(joined(overview(chatter, "abc", 2), chatter_panels(chatter, "def")),
                             "Chatter, omega = 0.552; (d)-(f): the burst magnified")});
}

}  // namespace slapstick::paper
