#pragma once
/// Units of measurement as text: "mm", "kg m/s^2", "N/m", "1".
#include <array>
#include <string>

namespace slapstick {

/// A product of powers of metre, second and kilogram, times a number. Angles and ratios have no powers.
struct Unit {
  double factor = 1.0;
  std::array<int, 3> powers{};  ///< of length, time and mass

  [[nodiscard]] bool same_dimension(const Unit& other) const { return powers == other.powers; }
};

/// factor (* | / | space factor)..., a factor being a known name with an optional whole power: "m^2". '/' is for the
/// next factor only; µ is u.
/// @throws InputError with the reason only: "unknown unit 'furlong'; ..."
[[nodiscard]] Unit parse_unit(const std::string& given);

}  // namespace slapstick
