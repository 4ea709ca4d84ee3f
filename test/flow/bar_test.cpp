/// A bar of finite elements, its matrices from files, oscillates with the frequencies of its closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "slapstick/flow/motion.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick {
namespace {

using std::numbers::pi;

/// Linear elements of a clamped bar: w_k^2 = 6 (E / rho h^2) (1 - cos t) / (2 + cos t), t = (2 k - 1) pi / 2 n.
TEST(Bar, of_thirty_elements_oscillates_with_its_closed_frequencies) {
  const auto definition = load_model(SLAPSTICK_BAR);
  const Model model = definition.build({{"loss", 0}, {"friction", 0}, {"force", 0}, {"gap", 10}});
  ASSERT_EQ(model.size(), 30);
  for (const int k : {1, 2, 7, 30}) {
    const double t = (2 * k - 1) * pi / 60, w = std::sqrt(5400 * (1 - std::cos(t)) / (2 + std::cos(t)));
    State start(60, 0.0);
    for (int i = 0; i < 30; ++i) start[static_cast<std::size_t>(2 * i)] = 0.01 * std::sin((i + 1) * t);
    Motion motion(System(model), start);
    const Instant end = Instant{}.plus(8 * pi / w / model.forcing_period());  // four periods
    while (motion.advance(end) == Outcome::event) {
    }
    // rounding of displacements, times the fastest frequency, 104, where it is a velocity's
    const State back = motion.state();
    for (std::size_t i = 0; i < start.size(); ++i) EXPECT_NEAR(back[i], start[i], 5e-12) << k;
  }
}

}  // namespace
}  // namespace slapstick
