/// Draws the picture of `simulate`: phase portrait and time series.
#include "motion_plot.hpp"

namespace slapstick::app {

figure::Figure MotionPlot::figure() const {
  const auto curve = [](const std::string& x_label, const std::string& y_label, const std::vector<double>& x,
                        const std::vector<double>& y) {
    figure::Panel panel{.x_label = x_label, .y_label = y_label};
    panel.lines.push_back({.x = x, .y = y, .colour = figure::colours::dark_blue, .width_pt = 0.6});
    return panel;
  };
  figure::Figure figure{.width_cm = 12};
  figure.panels.push_back(curve(displacement_, velocity_, y_, w_));
  figure.panels.push_back(curve(time_, displacement_, t_, y_));
  figure.panels.push_back(curve(time_, velocity_, t_, w_));
  figure.panels.front().height_share = 2;
  for (const double limit : relative_.limits) {
    figure.panels[0].marks.push_back({.x = limit});
    figure.panels[1].marks.push_back({.y = limit});
  }
  return figure;
}

}  // namespace slapstick::app
