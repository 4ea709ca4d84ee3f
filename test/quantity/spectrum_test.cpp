/// Spectra: against closed forms, Parseval's identity, and sums over samples.
#include "slapstick/quantity/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "settled.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/quantity/measure.hpp"
#include "slapstick/section/sampled_motion.hpp"

namespace slapstick::test {
namespace {

using Complex = std::complex<double>;

/// A ball that hits a shaken table once a period: x'' = -g + A g sin(omega t + phase) + J sum delta(t - t_k), J = g T.
/// The lines of the impulses have one amplitude, 2 g, and the phase of the instant of impact.
TEST(Spectrum, LinesOfAnImpulseTrainDoNotDecay) {
  const SettledCycle cycle(load_model("shaken-table"));
  ASSERT_EQ(cycle.solution.label, "1-1-I");
  const LineSpectrum found = spectrum(*cycle.problem, cycle.solution.orbit, cycle.named("a"), 200.0);
  const Measured impact = measure(*cycle.problem, cycle.solution.orbit, {cycle.named("w")});
  ASSERT_EQ(found.lines.size(), 201U);
  EXPECT_EQ(found.impulses, 1);
  EXPECT_NEAR(found.lines[0].c.real(), 0.0, 1e-12);
  for (std::size_t k = 2; k < found.lines.size(); ++k) {
    EXPECT_NEAR(found.lines[k].amplitude(), 2.0, 1e-11) << k;
    const double turn = static_cast<double>(k) * impact.of[0].greatest_at / found.duration;
    EXPECT_NEAR(std::abs(found.lines[k].c - std::polar(1.0, -2.0 * std::numbers::pi * turn)), 0.0, 1e-10) << k;
  }
}

/// Friction that slips all the time, half a period each way, is a square wave: 4 f / (pi k) of odd orders.
TEST(Spectrum, OfFrictionIsASquareWave) {
  const SettledCycle cycle(load_model("coulomb-oscillator"), {{"omega", 0.8}, {"friction", 0.2}});
  ASSERT_FALSE(cycle.solution.sticking);
  const LineSpectrum found = spectrum(*cycle.problem, cycle.solution.orbit, cycle.named("F_friction"), 101.0);
  for (std::size_t k = 0; k < found.lines.size(); ++k) {
    const double expected = k % 2 == 1 ? 4.0 * 0.2 / (std::numbers::pi * static_cast<double>(k)) : 0.0;
    EXPECT_NEAR(found.lines[k].amplitude(), expected, 1e-12) << k;
  }
  EXPECT_NEAR(found.mean_square, 0.04, 1e-14);
}

/// Harmonics of statistics are the lines, also of what sticks for long, of impulses and of a cycle of three periods.
TEST(Spectrum, HasTheHarmonicsOfTheStatistics) {
  const auto compare = [](const SettledCycle& cycle, const char* name) {
    const Quantity of = cycle.named(name);
    const LineSpectrum lines = spectrum(*cycle.problem, cycle.solution.orbit, of, 16.0);
    const Statistics found = measure(*cycle.problem, cycle.solution.orbit, {of}).of.front();
    const std::size_t n = lines.lines.size() / 16;
    ASSERT_EQ(found.harmonics.size(), 16U);
    for (std::size_t k = 1; k <= 16; ++k) {
      const SpectralLine& line = lines.lines[k * n];
      EXPECT_NEAR(line.order, static_cast<double>(k), 1e-12) << name;
      EXPECT_NEAR(std::abs(found.harmonics[k - 1] - 2.0 * line.c), 0.0, 1e-12 * (found.rms + line.amplitude()))
          << name << k;
    }
  };
  compare(SettledCycle(load_model("vibro-impact"), {{"omega", 2.9}}), "x1");
  compare(SettledCycle(load_model("vibro-impact"), {{"omega", 0.552}}), "a1");
  compare(SettledCycle(load_model("vibro-impact"), {{"omega", 0.552}}), "F_stop");
  compare(SettledCycle(load_model("coulomb-oscillator"), {{"omega", 0.8}}), "F_friction");
  compare(SettledCycle(load_model("belt"), {{"damping_ratio", 0.05}}), "v");
}

TEST(Spectrum, HasNoHarmonicsOfWhatIsNoCycle) {
  const SettledCycle cycle(load_model("shaken-table"));
  EXPECT_NO_THROW(check_statistic(cycle.named("a"), "h3:phase"));
  EXPECT_THROW(check_statistic(cycle.named("w"), "h1"), InputError);
  EXPECT_THROW(check_statistic(cycle.named("a"), "h17"), InputError);
  EXPECT_THROW(check_statistic_of_stretch(cycle.named("a"), "h1"), InputError);
  EXPECT_THROW((void)statistic(Statistics{}, "h1"), InputError);
}

/// The sum of the squares of all lines is the mean square. Of a velocity that jumps the rest falls like 1 / order.
TEST(Spectrum, ObeysParseval) {
  const SettledCycle cycle(load_model("vibro-impact"), {{"omega", 2.9}});
  const LineSpectrum x = spectrum(*cycle.problem, cycle.solution.orbit, cycle.named("x1"), 400.0);
  EXPECT_NEAR(x.mean_square_of_lines, x.mean_square, 1e-7 * x.mean_square);
  const auto rest = [&](double orders) {
    const LineSpectrum v = spectrum(*cycle.problem, cycle.solution.orbit, cycle.named("v1"), orders);
    return (v.mean_square - v.mean_square_of_lines) / v.mean_square;
  };
  const double hundred = rest(100.0), four_hundred = rest(400.0);
  EXPECT_GT(hundred, 0.0);
  EXPECT_NEAR(hundred / four_hundred, 4.0, 0.4);
}

/// Sums over N samples converge to the integrals.
TEST(Spectrum, SumsOverSamplesConvergeToIt) {
  const SettledCycle cycle(load_model("vibro-impact"), {{"omega", 2.9}});
  const LineSpectrum exact = spectrum(*cycle.problem, cycle.solution.orbit, cycle.named("x1"), 12.0);
  const auto error = [&](int samples) {
    std::vector<Complex> sums(exact.lines.size());
    SampledMotion sampled(cycle.motion(), samples);
    long count = 0;
    for (auto item = sampled.next(cycle.end()); item != SampledMotion::Item::end; item = sampled.next(cycle.end())) {
      if (item != SampledMotion::Item::sample || !(sampled.sample().time < cycle.end())) continue;
      const double turns = sampled.sample().time.since({}) * cycle.system.period() / exact.duration;
      for (std::size_t k = 0; k < sums.size(); ++k)
        sums[k] +=
            sampled.sample().state[0] * std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(k) * turns);
      ++count;
    }
    double worst = 0.0;
    for (std::size_t k = 0; k < sums.size(); ++k)
      worst = std::max(worst, std::abs(sums[k] / static_cast<double>(count) - exact.lines[k].c));
    return worst;
  };
  const double coarse = error(512), fine = error(8192);
  EXPECT_LT(fine, 1e-7);
  EXPECT_LT(fine, coarse / 60.0);  // at least with the 1.5th power of the distance
}

/// The density of a sine of amplitude A, summed over the frequencies around it, is A^2 / 2; beside it there is nothing.
TEST(Spectrum, TheDensityOfASineHasItsMeanSquare) {
  const SettledCycle cycle(load_model("impact-oscillator"), {{"clearance", 100.0}, {"omega", 1.3}});
  const DensitySpectrum found = density(cycle.motion(), cycle.named("x"), {16.0, 7, 4.0});
  const double A = 1.0 / std::hypot(1.0 - 1.69, 0.2 * 1.3), width = found.frequency[1] - found.frequency[0];
  double all = 0.0, beside = 0.0;
  for (std::size_t k = 0; k < found.density.size(); ++k) {
    all += width * found.density[k];
    if (std::abs(found.order[k] - 1.0) > 1.5 / 16.0) beside += width * found.density[k];
  }
  EXPECT_NEAR(all, 0.5 * A * A, 1e-11 * A * A);
  EXPECT_LT(beside, 1e-20 * A * A);
}

/// Of a chaotic motion the density adds up to the variance, apart from what the stretches' ends weigh less.
TEST(Spectrum, TheDensityOfChaosAddsUpToItsVariance) {
  const ModelDefinition definition = load_model("vibro-impact");
  const Overrides values = {{"omega", 6.69}};
  const System system(definition.build(values));
  const Quantity x = find_quantity(quantities(definition, values), "x1");
  const Motion motion(system, definition.start(values));
  const DensitySpectrum found = density(motion, x, {128.0, 21, 12.0});
  const Measured whole = measure(motion, Instant{128 * 11, 0.0}, {x});
  double sum = 0.0;
  for (const double one : found.density) sum += one * (found.frequency[1] - found.frequency[0]);
  const double variance = whole.of[0].rms * whole.of[0].rms - whole.of[0].mean * whole.of[0].mean;
  EXPECT_NEAR(sum, variance, 0.1 * variance);
  EXPECT_LT(found.low, 1.0);
  EXPECT_GT(found.high, 1.0);
}

/// Thirds add up to octaves, and both to the mean square; IEC 61672-1 gives A at the centres.
TEST(Octaves, LoseNoPower) {
  const SettledCycle cycle(load_model("shaken-table"));
  const LineSpectrum found = spectrum(*cycle.problem, cycle.solution.orbit, cycle.named("v"), 300.0);
  const double all = found.mean_square_of_lines - std::norm(found.lines[0].c);
  for (const int parts : {1, 3}) {
    double sum = 0.0;
    for (const Band& band : octaves(found, parts)) sum += band.mean_square;
    EXPECT_NEAR(sum, all, 1e-12 * all) << parts;
  }
  EXPECT_THROW(static_cast<void>(octaves(found, 2)), InputError);
  EXPECT_NEAR(a_weighting(1000.0), 0.0, 5e-4);
  EXPECT_NEAR(a_weighting(31.622776601683793), -39.4, 0.06);
  EXPECT_NEAR(a_weighting(100.0), -19.1, 0.06);
  EXPECT_NEAR(a_weighting(10000.0), -2.5, 0.06);
}

/// A cosine of amplitude 1 has the mean square 1/2, and the weight of its frequency, wherever it lies in its band.
TEST(Octaves, OfOneLineHaveItsPowerAndItsWeight) {
  for (const double hertz : {45.0, 63.0, 70.0, 400.0}) {
    const LineSpectrum found{1.0 / hertz, {{0.0, 0.0, 0.0}, {1.0, hertz, 0.5}}, 0.5, 0.5, 0};
    for (const int parts : {1, 3}) {
      const auto bands = octaves(found, parts);
      ASSERT_EQ(bands.size(), 1U) << hertz;
      EXPECT_LE(bands[0].from, hertz);
      EXPECT_GT(bands[0].to, hertz);
      EXPECT_NEAR(bands[0].mean_square, 0.5, 1e-15) << hertz;
      EXPECT_NEAR(10.0 * std::log10(bands[0].weighted / bands[0].mean_square), a_weighting(hertz), 1e-12) << hertz;
    }
  }
}

/// A band is whole if more lines leave it as it is; the one that the highest order cuts grows.
TEST(Octaves, TellWhichBandsAreCut) {
  const SettledCycle cycle(load_model("shaken-table"));
  const Quantity v = cycle.named("v");
  const auto many = octaves(spectrum(*cycle.problem, cycle.solution.orbit, v, 300.0), 3);
  int cut = 0, whole = 0;
  for (const double highest : {50.0, 55.0, 60.0, 65.0, 70.0, 75.0}) {
    const auto few = octaves(spectrum(*cycle.problem, cycle.solution.orbit, v, highest), 3);
    for (std::size_t k = 0; k < few.size(); ++k) {
      if (few[k].whole) {
        ++whole;
        EXPECT_NEAR(few[k].mean_square, many[k].mean_square, 1e-12 * many[k].mean_square) << few[k].centre;
        continue;
      }
      ++cut;
      EXPECT_EQ(k + 1, few.size());
      EXPECT_LT(few[k].mean_square, (1.0 - 1e-9) * many[k].mean_square) << few[k].centre;
    }
  }
  EXPECT_GE(cut, 3);
  EXPECT_GT(whole, 60);
}

TEST(Spectrum, RefusesQuantitiesAtImpacts) {
  const SettledCycle cycle(load_model("shaken-table"));
  EXPECT_THROW(static_cast<void>(spectrum(*cycle.problem, cycle.solution.orbit, cycle.named("w"), 5.0)), InputError);
}

}  // namespace
}  // namespace slapstick::test
