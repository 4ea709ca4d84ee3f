/// Computes cosine and sine of a phase by fixed operations.
#include "base/phase.hpp"

#include <cmath>

#include "base/double_double.hpp"

namespace slapstick {
namespace {

constexpr DoubleDouble two_pi = {0x1.921fb54442d18p+2, 0x1.1a62633145c07p-52}, halves_of_two_pi = split(two_pi.hi);

constexpr double s1 = -1.66666666666666324348e-01, s2 = 8.33333333332248946124e-03, s3 = -1.98412698298579493134e-04,
                 s4 = 2.75573137070700676789e-06, s5 = -2.50507602534068634195e-08, s6 = 1.58969099521155010221e-10;
constexpr double c1 = 4.16666666666666019037e-02, c2 = -1.38888888888741095749e-03, c3 = 2.48015872894767294178e-05,
                 c4 = -2.75573143513906633035e-07, c5 = 2.08757232129817482790e-09, c6 = -1.13596475577881948265e-11;

/// For |t| <= 1/8.
CosineSine of_eighth(double t) {
  const DoubleDouble product = two_product(two_pi.hi, halves_of_two_pi, t, split(t));
  const double y = product.hi, y1 = product.lo + two_pi.lo * t;
  const DoubleDouble half = split(y), square = two_product(y, half, y, half);
  const double z = square.hi, z1 = square.lo, w = z * z;
  const double S = s1 + z * ((s2 + z * (s3 + z * s4)) + z * w * (s5 + z * s6));
  const double C = (c1 + z * (c2 + z * c3)) + z * w * (c4 + z * (c5 + z * c6));
  const double sine = y + (y * (z * S) + (y1 * (1.0 - 0.5 * z) + y * (z1 * s1)));
  const double half_z = 0.5 * z, most = 1.0 - half_z;
  return {most + (w * C + (((1.0 - most) - half_z) - (y * y1 + 0.5 * z1))), sine};
}

}  // namespace

CosineSine of_turns(double turns) {
  turns -= std::nearbyint(turns);
  const double quarters = std::nearbyint(4.0 * turns);
  const auto [c, s] = of_eighth(turns - 0.25 * quarters);
  switch (static_cast<int>(quarters) & 3) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

}  // namespace slapstick
