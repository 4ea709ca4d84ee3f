/// Puts units on the axes of pictures, where the model's file states them.
#include "axis_units.hpp"

#include "axis_text.hpp"

namespace slapstick::app {

std::string with_unit(const std::string& text, const std::string& unit) {
  return unit.empty() ? text : text + " [" + axis_text(unit) + "]";
}

std::string AxisUnits::displacement(int a, int b) const {
  const auto of = [&](int coordinate) { return stated_.coordinates.at(static_cast<std::size_t>(coordinate)); };
  if (a == ground || b == ground) return of(a == ground ? b : a);
  return of(a) == of(b) ? of(a) : "";
}

std::string AxisUnits::over_time(const std::string& displacement) const {
  return displacement.empty() || stated_.time.empty() ? "" : displacement + "/" + stated_.time;
}

std::string AxisUnits::speed(const std::vector<int>& contacts) const {
  std::string common;
  for (const int contact : contacts) {
    const std::string unit = velocity(sides_of(model_, contact));
    if (unit.empty() || (!common.empty() && common != unit)) return "";
    common = unit;
  }
  return common;
}

}  // namespace slapstick::app
