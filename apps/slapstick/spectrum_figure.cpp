/// Draws spectra.
#include "spectrum_figure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "axis_text.hpp"
#include "axis_units.hpp"

namespace slapstick::app {
namespace {

constexpr double shown_decibels = 100.0;  ///< below the largest level

figure::Panel panel(const SpectrumLabels& labels, const std::string& what, const std::string& unit) {
  figure::Panel made;
  made.x_label = labels.forced ? "order" : "order of the cycle";
  const std::string name = axis_text(labels.name);
  made.y_label = labels.decibels ? what + " of " + name + " [dB]" : with_unit(what + " of " + name, unit);
  made.legend = figure::Legend::none;
  return made;
}

figure::Figure alone(figure::Panel panel) {
  figure::Figure figure;
  figure.width_cm = 17.5;
  figure.height_cm = 7.0;
  figure.panels.push_back(std::move(panel));
  return figure;
}

/// Marks at the multiples of the forcing, if these are few enough to be told apart.
void mark_orders(double highest, figure::Panel& panel) {
  constexpr double most = 40.0;
  for (double order = 1.0; order <= highest && highest <= most; ++order) {
    figure::Mark mark;
    mark.x = order;
    mark.colour = figure::colours::light_grey;
    panel.marks.push_back(mark);
  }
}

}  // namespace

double level(const Band& band, double reference, bool weighted) {
  return 10.0 * std::log10((weighted ? band.weighted : band.mean_square) / (reference * reference));
}

/// A stem for each line, from the lower end of the axis.
figure::Figure lines_figure(const LineSpectrum& found, const SpectrumLabels& labels) {
  figure::Panel made = panel(labels, "amplitude", labels.unit);
  std::vector<double> heights;
  for (const SpectralLine& line : found.lines)
    heights.push_back(labels.decibels ? 20.0 * std::log10(line.amplitude() / labels.reference) : line.amplitude());
  const double top = heights.empty() ? 0.0 : *std::max_element(heights.begin(), heights.end());
  const double floor = labels.decibels ? top - shown_decibels : 0.0;
  figure::Line stems;
  stems.colour = figure::colours::dark_blue;
  figure::Points heads{};
  heads.colour = figure::colours::dark_blue;
  heads.diameter_mm = 0.9;
  heads.drawing = figure::Drawing::discs;
  const double gap = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < heights.size(); ++k) {
    if (!(heights[k] > floor)) continue;
    const double order = found.lines[k].order;
    stems.x.insert(stems.x.end(), {order, order, order});
    stems.y.insert(stems.y.end(), {floor, heights[k], gap});
    heads.x.push_back(order);
    heads.y.push_back(heights[k]);
  }
  if (!stems.x.empty()) {
    const double highest = found.lines.back().order, margin = labels.decibels ? 0.04 * shown_decibels : 0.05 * top;
    made.x_range = figure::Range{-0.02 * highest, 1.02 * highest};
    made.y_range = figure::Range{floor, top + margin};
    mark_orders(highest, made);
    made.lines.push_back(std::move(stems));
    made.points.push_back(std::move(heads));
  }
  return alone(std::move(made));
}

figure::Figure density_figure(const DensitySpectrum& found, const SpectrumLabels& labels) {
  figure::Panel made =
      panel(labels, "power density", labels.unit.empty() ? "" : "(" + labels.unit + ")^2 per unit of frequency");
  figure::Line line;
  line.colour = figure::colours::dark_blue;
  line.x = found.order;
  for (const double one : found.density)
    line.y.push_back(labels.decibels ? 10.0 * std::log10(one / (labels.reference * labels.reference)) : one);
  if (!line.x.empty()) {
    mark_orders(found.order.back(), made);
    made.lines.push_back(std::move(line));
  }
  return alone(std::move(made));
}

figure::Figure bands_figure(const std::vector<Band>& bands, const SpectrumLabels& labels, bool weighted) {
  figure::Panel made = panel(labels, "level", "");
  made.y_label = "level of " + axis_text(labels.name) + (weighted ? " [dB(A)]" : " [dB]");
  made.x_label = "frequency [Hz]";
  made.log_x = true;
  figure::Line line;
  line.colour = figure::colours::dark_blue;
  for (const Band& band : bands) {
    if (!(band.mean_square > 0.0)) {
      line.x.push_back(band.centre);
      line.y.push_back(std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    const double height = level(band, labels.reference, weighted);
    line.x.insert(line.x.end(), {band.from, band.to});
    line.y.insert(line.y.end(), {height, height});
  }
  if (!line.x.empty()) made.lines.push_back(std::move(line));
  return alone(std::move(made));
}

}  // namespace slapstick::app
