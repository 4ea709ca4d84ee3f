/// Colours of charts: nobody takes one class for another, whatever their colour vision; scales grow lighter evenly.
#include "slapstick/chart_colours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace slapstick::app {
namespace {

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;

/// Machado, Oliveira and Fernandes (2009): what is seen instead of linear RGB, severity 1; first normal vision.
constexpr std::array<Matrix, 4> visions{
    {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
     {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}},
     {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}},
     {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}}}};

Triple times(const Matrix& matrix, const Triple& v) {
  Triple out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out[i] += matrix[i][j] * v[j];
  return out;
}

double linear(std::uint8_t value) {
  const double c = value / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// CIELAB of linear RGB under D65.
Triple lab(Triple rgb) {
  for (double& c : rgb) c = std::clamp(c, 0.0, 1.0);
  constexpr Matrix to_xyz{
      {{0.4124564, 0.3575761, 0.1804375}, {0.2126729, 0.7151522, 0.0721750}, {0.0193339, 0.1191920, 0.9503041}}};
  const Triple xyz = times(to_xyz, rgb);
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
  const double x = f(xyz[0] / 0.95047), y = f(xyz[1]), z = f(xyz[2] / 1.08883);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

Triple seen(const figure::Colour& colour, const Matrix& vision) {
  return lab(times(vision, {linear(colour.red), linear(colour.green), linear(colour.blue)}));
}

double apart(const Triple& a, const Triple& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

TEST(ChartColours, AnyTwoCanBeToldApartWithEveryColourVision) {
  std::vector<figure::Colour> all(class_colours.begin(), class_colours.end());
  all.insert(all.end(), {chaotic_colour, quasi_periodic_colour, other_classes_colour, undecided_colour});
  for (std::size_t v = 0; v < visions.size(); ++v)
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GT(apart(seen(all[i], visions[v]), seen(all[j], visions[v])), 19.0)
            << "vision " << v << ": " << j << ", " << i;
}

TEST(ChartColours, ScaleGrowsLighterEvenlyWithEveryColourVision) {
  constexpr int steps = 64;
  for (const Matrix& vision : visions) {
    const double whole = seen(scale_colour(1.0), vision)[0] - seen(scale_colour(0.0), vision)[0];
    EXPECT_GT(whole, 60.0);
    for (int i = 1; i <= steps; ++i) {
      const double gained = seen(scale_colour(static_cast<double>(i) / steps), vision)[0] -
                            seen(scale_colour(static_cast<double>(i - 1) / steps), vision)[0];
      EXPECT_GT(gained, 0.3 * whole / steps) << i;
      EXPECT_LT(gained, 2.0 * whole / steps) << i;
    }
  }
}

TEST(ChartColours, ScaleHasItsEnds) {
  EXPECT_EQ(scale_colour(0.0), scale_anchors.front());
  EXPECT_EQ(scale_colour(1.0), scale_anchors.back());
}

}  // namespace
}  // namespace slapstick::app
