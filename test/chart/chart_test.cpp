/// Charts in stores and their curves, by the library alone: a store is the run itself, and nothing is mixed.
#include "slapstick/chart/chart.hpp"

#include <gtest/gtest.h>

#include <unistd.h>
#include <cmath>

#include <filesystem>

#include "slapstick/base/error.hpp"
#include "slapstick/chart/curves.hpp"

namespace slapstick::chart {
namespace {

class InAFolder : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directory(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("slapstick_chart_" + std::to_string(::getpid()));
};
using ChartStore = InAFolder;

Chart paper() { return over(load_model("vibro-impact"), {}, "omega", {1.2, 5.2, 12}, "friction", {0.1, 0.3, 7}); }

void expect_same(const sweep::Map& a, const sweep::Map& b) {
  ASSERT_EQ(a.findings.size(), b.findings.size());
  for (std::size_t i = 0; i < a.findings.size(); ++i) {
    EXPECT_EQ(a.findings[i].pixel, b.findings[i].pixel);
    EXPECT_EQ(a.findings[i].label(), b.findings[i].label());
    const double x = a.findings[i].exponent, y = b.findings[i].exponent;
    EXPECT_TRUE(x == y || (std::isnan(x) && std::isnan(y)));
  }
}

TEST_F(ChartStore, HoldsWhatTheMapIsAndGoesOnWhereItWasLeft) {
  const Chart chart = paper();
  const sweep::Map whole = sweep::run_map(chart.problem);
  Chart interrupted = paper();
  std::atomic<bool> cancel{false};
  interrupted.problem.cancel = &cancel;
  interrupted.problem.threads = 1;
  interrupted.problem.progress = [&](long, long) { cancel = true; };
  const sweep::Map part = stored_map(interrupted, file("a.db"), false);
  EXPECT_FALSE(part.complete);
  EXPECT_LT(part.findings.size(), whole.findings.size());
  expect_same(stored_map(chart, file("a.db"), true), whole);
  expect_same(read_map(store::Store::to_read(file("a.db")), chart.problem), whole);
}

TEST_F(ChartStore, RefusesAnotherChart) {
  static_cast<void>(stored_map(paper(), file("a.db"), false));
  EXPECT_THROW(static_cast<void>(stored_map(paper(), file("a.db"), false)), InputError);
  for (const auto& change :
       {+[](Chart& chart) { chart.problem.periods = 299; }, +[](Chart& chart) { chart.values["clearance"] = 0.3; },
        +[](Chart& chart) { chart.problem.refine = 4; }, +[](Chart& chart) { chart.state = "x1=0"; }}) {
    Chart other = paper();
    change(other);
    EXPECT_THROW(static_cast<void>(stored_map(other, file("a.db"), true)), InputError);
  }
}

/// Without impacts the amplitude is 1 / sqrt((1 - omega^2)^2 + (2 zeta omega)^2): there the stop is touched. A refined
/// map has all edges of the whole one.
TEST(ChartCurves, OfARefinedMapAreThoseOfTheWhole) {
  Chart chart = over(load_model("impact-oscillator"), {{"damping_ratio", 0.8}}, "omega", {0.5, 1.5, 33}, "clearance",
                     {0.3, 1.0, 33});
  const Curves whole = find_curves(chart, sweep::run_map(chart.problem), 1);
  chart.problem.refine = 8;
  const sweep::Map map = sweep::run_map(chart.problem);
  const Curves found = find_curves(chart, map, 1);
  EXPECT_LT(map.findings.size(), map.rows() / 2);
  EXPECT_EQ(found.edges, whole.edges);
  EXPECT_EQ(found.explained, whole.explained);
  ASSERT_EQ(found.curves.size(), 1U);
  EXPECT_EQ(found.curves[0].type, orbit::SpecialType::GR);
  for (std::size_t i = 0; i < found.curves[0].x.size(); ++i) {
    const double omega = found.curves[0].x[i], clearance = found.curves[0].y[i];
    if (std::isnan(omega)) continue;
    const double amplitude = 1.0 / std::hypot(1.0 - omega * omega, 1.6 * omega);
    EXPECT_NEAR(clearance, amplitude, 1e-9 * amplitude);
  }
}

TEST(ChartCurves, AreRefusedForCarriedStarts) {
  Chart chart = paper();
  chart.problem.start = sweep::MapStart::carry;
  EXPECT_THROW(static_cast<void>(find_curves(chart, sweep::Map{}, 1)), InputError);
}

}  // namespace
}  // namespace slapstick::chart
