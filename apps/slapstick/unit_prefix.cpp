/// Puts axes into units of a handy size.
#include "unit_prefix.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>

#include "base/ranges.hpp"

namespace slapstick::app {
namespace {

/// Units that take a prefix; kilo and mega only where people use them.
struct PrefixedUnit {
  std::string_view name;
  bool large;
};
constexpr std::array prefixed_units{PrefixedUnit{"m", false}, PrefixedUnit{"m/s", false}, PrefixedUnit{"s", false},
                                    PrefixedUnit{"N", true},  PrefixedUnit{"Pa", true},   PrefixedUnit{"J", true},
                                    PrefixedUnit{"W", true},  PrefixedUnit{"Hz", true},   PrefixedUnit{"N/m", true}};

struct Prefix {
  double factor = 1.0;
  const char* sign = "";
};

Prefix prefix_for(double largest, bool large) {
  if (!(largest > 0.0) || (largest >= 0.1 && largest < 1e4)) return {};
  if (largest >= 1e7 && large) return {1e-6, "M"};
  if (largest >= 1e4) return large ? Prefix{1e-3, "k"} : Prefix{};
  if (largest >= 1e-4) return {1e3, "m"};
  return largest >= 1e-7 ? Prefix{1e6, "\u00b5"} : Prefix{1e9, "n"};
}

/// The unit at the end of a name, if it is one of those above.
const PrefixedUnit* unit_of(const std::string& label) {
  const std::size_t bracket = label.rfind('[');
  if (bracket == std::string::npos || label.back() != ']') return nullptr;
  const std::string unit = label.substr(bracket + 1, label.size() - bracket - 2);
  const auto found = ranges::find(prefixed_units, unit, &PrefixedUnit::name);
  return found == prefixed_units.end() ? nullptr : &*found;
}

/// One axis of a panel: x or y.
struct AxisOf {
  figure::Panel& panel;
  bool is_x;
  [[nodiscard]] std::string& label() const { return is_x ? panel.x_label : panel.y_label; }
  [[nodiscard]] bool log() const { return is_x ? panel.log_x : panel.log_y; }
  [[nodiscard]] std::optional<figure::Range>& range() const { return is_x ? panel.x_range : panel.y_range; }

  /// Calls `change` with every number on the axis.
  template <class Change>
  void each(const Change& change) const {
    const auto columns = [&](auto& series) {
      for (double& value : is_x ? series.x : series.y) change(value);
    };
    for (figure::Points& points : panel.points) columns(points);
    for (figure::Line& line : panel.lines) columns(line);
    if (panel.cells) {
      figure::Range& covered = is_x ? panel.cells->x : panel.cells->y;
      change(covered.min);
      change(covered.max);
    }
    for (figure::Inset& inset : panel.insets) {
      figure::Range& shown = is_x ? inset.x : inset.y;
      change(shown.min);
      change(shown.max);
    }
    for (figure::Mark& mark : panel.marks) {
      if (is_x && mark.x) change(*mark.x);
      if (is_x && mark.x_end) change(*mark.x_end);
      if (!is_x && mark.y) change(*mark.y);
    }
  }

  [[nodiscard]] double largest() const {
    if (range()) return std::max(std::abs(range()->min), std::abs(range()->max));
    double most = 0.0;
    each([&](double value) {
      if (std::isfinite(value)) most = std::max(most, std::abs(value));
    });
    return most;
  }
  void scale(const Prefix& prefix) const {
    label().insert(label().rfind('[') + 1, prefix.sign);
    each([&](double& value) { value *= prefix.factor; });
    if (range()) range() = figure::Range{range()->min * prefix.factor, range()->max * prefix.factor};
  }
};

}  // namespace

void use_prefixes(figure::Figure& figure) {
  std::vector<AxisOf> axes;
  std::map<std::string, double> largest;  // of the axes of one name
  for (figure::Panel& panel : figure.panels)
    for (const bool is_x : {true, false}) {
      const AxisOf axis{panel, is_x};
      if (unit_of(axis.label()) == nullptr || axis.log()) continue;
      axes.push_back(axis);
      double& most = largest[axis.label()];
      most = std::max(most, axis.largest());
    }
  for (const AxisOf& axis : axes) {
    const std::string name = axis.label();
    const Prefix prefix = prefix_for(largest[name], unit_of(name)->large);
    if (prefix.factor != 1.0) axis.scale(prefix);
  }
}

}  // namespace slapstick::app
