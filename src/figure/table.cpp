/// Gathers the columns that a script plots, and writes them as CSV.
#include "table.hpp"

#include <algorithm>

#include "text.hpp"

namespace slapstick::figure {
namespace {

bool has_something(const std::vector<double>& x, const std::vector<double>& y, const Panel& panel) {
  for (std::size_t i = 0; i < x.size(); ++i)
    if (drawable(x[i], panel.log_x) && drawable(y[i], panel.log_y)) return true;
  return false;
}

std::string series_name(const Panel& panel, std::size_t panel_index, const std::string& label, const char* kind,
                        std::size_t index) {
  const std::string where = panel.tag.empty() ? "panel " + std::to_string(panel_index + 1) : panel.tag;
  return where + " " + (label.empty() ? kind + (" " + std::to_string(index + 1)) : label);
}

std::string cell(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + "\"";
}

}  // namespace

Table tabulate(const Figure& figure, const Layout& layout) {
  Table table;
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    const Panel& panel = figure.panels[p];
    PanelSeries chosen{.first_column = 2 * table.series.size() + 1};
    const auto take = [&](const auto& series, const char* kind, std::size_t index, std::vector<std::size_t>& into) {
      if (!has_something(series.x, series.y, panel)) return;
      into.push_back(index);
      table.series.push_back(
          {series_name(panel, p, series.label, kind, index), &series.x, &series.y, panel.log_x, panel.log_y});
    };
    for (std::size_t i = 0; i < panel.points.size(); ++i)
      if (!layout.panels[p].raster || !in_raster(panel.points[i])) take(panel.points[i], "points", i, chosen.points);
    for (std::size_t i = 0; i < panel.lines.size(); ++i) take(panel.lines[i], "line", i, chosen.lines);
    table.panels.push_back(std::move(chosen));
  }
  return table;
}

std::string to_csv(const Table& table) {
  std::string out;
  std::size_t rows = 0;
  for (const Series& series : table.series) {
    out += (out.empty() ? "" : ",") + cell(series.name + " x") + "," + cell(series.name + " y");
    rows = std::max(rows, series.x->size());
  }
  out += "\n";
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t s = 0; s < table.series.size(); ++s) {
      const Series& series = table.series[s];
      if (s > 0) out += ',';
      if (row >= series.x->size()) {
        out += ',';
        continue;
      }
      const double x = (*series.x)[row], y = (*series.y)[row];
      out += drawable(x, series.log_x) && drawable(y, series.log_y) ? number(x) + "," + number(y) : "NaN,NaN";
    }
    out += '\n';
  }
  return out;
}

}  // namespace slapstick::figure
