/// Chooses the range and the ticks of an axis.
#include "axis.hpp"

#include <algorithm>
#include <cmath>

#include "text.hpp"

namespace slapstick::figure {
namespace {

constexpr double least_span =
    1e-6;  // of an automatic range to its largest number: the ticks' numbers then have at most 8 digits

/// The step 1, 2 or 5 times a power of ten that gives at most `most` intervals.
void choose_step(Axis& axis, int most) {
  const double least = (axis.range.max - axis.range.min) / std::max(most, 1);
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  struct Choice {
    double factor;
    int minor;
  };
  for (const Choice choice : {Choice{1, 2}, Choice{2, 2}, Choice{5, 5}, Choice{10, 2}}) {
    axis.step = choice.factor * power;
    axis.minor = choice.minor;
    if (axis.step >= least * (1 - 1e-9)) return;
  }
}

/// Fixed decimals for everyday magnitudes, powers of ten for the rest.
void choose_format(Axis& axis) {
  const double largest = std::max(std::fabs(axis.range.min), std::fabs(axis.range.max));
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(axis.step) + 1e-9)));
  if (largest < 1e5 && (largest >= 1e-3 || axis.step >= 1e-4)) {
    axis.format = "%." + std::to_string(decimals) + "f";
    axis.label_em = width_em(fixed(largest, decimals)) + (axis.range.min < 0 ? 0.8 : 0.0);
    return;
  }
  const int digits = std::clamp(static_cast<int>(std::ceil(std::log10(largest / axis.step))) + 1, 2, 15);
  axis.format = "%." + std::to_string(digits) + "h";  // like %g, as 2×10^{-6}
  const double mantissa = 0.64 * (std::ceil(std::log10(largest / axis.step)) + 1) + 0.4;
  axis.label_em = mantissa + 3.2 + (axis.range.min < 0 ? 0.8 : 0.0);
}

/// Up to two decades: 1, 2 and 5 times powers of ten; less than half a decade: even steps.
void number_short_log(Axis& axis, double decades) {
  if (decades < 0.5) {
    for (double k = std::ceil(axis.range.min / axis.step); k * axis.step <= axis.range.max; ++k)
      axis.ticks.push_back(k * axis.step);
    return;
  }
  for (double power = std::pow(10.0, std::floor(std::log10(axis.range.min))); power <= axis.range.max; power *= 10)
    for (const double factor : {1.0, 2.0, 5.0})
      if (axis.shows(factor * power)) axis.ticks.push_back(factor * power);
  axis.format = "%h";
  axis.label_em = 2.6;
}

}  // namespace

double Axis::place(double value) const {
  if (log) return std::log(value / range.min) / std::log(range.max / range.min);
  return (value - range.min) / (range.max - range.min);
}

bool drawable(double value, bool log) {
  return std::fabs(value) <= largest_coordinate && (!log || value > 1 / largest_coordinate);
}

void Extent::add(const std::vector<double>& column, bool log) {
  bool rises = true, falls = true;
  double last = std::numeric_limits<double>::quiet_NaN();
  for (const double value : column) {
    if (!drawable(value, log)) continue;
    min = std::min(min, value);
    max = std::max(max, value);
    if (value < last) rises = false;
    if (value > last) falls = false;
    last = value;
  }
  if (!rises && !falls) one_way = false;
}

Range padded(const Extent& extent, double padding, bool log) {
  if (extent.empty()) return log ? Range{1, 10} : Range{0, 1};
  if (log) {
    const double low = std::log10(extent.min), high = std::log10(extent.max);
    const double pad = high - low < 1e-9 ? 0.5 : padding * (high - low);
    return {std::pow(10.0, low - pad), std::pow(10.0, high + pad)};
  }
  const double span = extent.max - extent.min;
  const double largest = std::max(std::fabs(extent.min), std::fabs(extent.max));
  if (resolvable({extent.min, extent.max}) && span > least_span * largest)
    return {extent.min - padding * span, extent.max + padding * span};
  const double around = largest > 1e-280 ? 0.1 * largest : 1.0;  // a constant, or as good as one in print
  return {extent.min - around, extent.max + around};
}

bool resolvable(Range range) {
  const double span = range.max - range.min, largest = std::max(std::fabs(range.min), std::fabs(range.max));
  return largest <= largest_coordinate && span > 1e-9 * largest && span > 1e-290;
}

int most_labels(double length_cm, double label_cm) { return std::clamp(static_cast<int>(length_cm / label_cm), 1, 8); }

Axis with_ticks(Range range, bool log, int most) {
  Axis axis{.range = range, .log = log};
  const double decades = log ? std::log10(range.max / range.min) : 0;
  if (decades > 2) {
    axis.step = decades > most ? std::pow(10.0, std::ceil(decades / most)) : 0;
    axis.format = "10^{%T}";
    axis.label_em = 2.7;
    return axis;
  }
  choose_step(axis, most);
  choose_format(axis);
  if (log) number_short_log(axis, decades);
  return axis;
}

}  // namespace slapstick::figure
