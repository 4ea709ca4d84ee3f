#pragma once
/// The insets of a panel in gnuplot's commands.
#include <string>

#include "layout.hpp"
#include "table.hpp"

namespace slapstick::figure {

/// A panel as its script has it.
struct DrawnPanel {
  const Panel& panel;
  const PanelLayout& at;
  const Layout& whole;
  const PanelSeries& series;
  const std::string& name;  ///< of the script
  std::size_t index;
};

/// The frames of what insets show; they belong to the panel's own plot.
std::string source_commands(const Panel& panel, const PanelLayout& at, const Layout& whole);

/// The plot of an inset and the lines to what it shows, after the plot of the panel.
std::string inset_commands(const DrawnPanel& drawn, std::size_t inset, double font_pt, bool latex);

}  // namespace slapstick::figure
