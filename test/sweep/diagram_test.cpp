/// Diagrams: the same bits on any number of threads, two attractors where there are two, failures that stay where they
/// are.
#include "slapstick/sweep/diagram.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "slapstick/base/error.hpp"
#include "slapstick/flow/motion.hpp"
#include "sweep/diagram_point.hpp"

namespace slapstick::sweep {
namespace {

Model paper(double omega, double clearance = 0.0) {
  Model model;
  model.name = "paper";
  model.coordinates = {{"x1", 1.0}, {"x2", 10.0}};
  model.springs = {{0, 1, 1.0}, {1, ground, 5.0}};
  model.dampers = {{0, 1, 0.2}, {1, ground, 1.0}};
  model.forces = {{0, 1, 1.0, 0.0}};
  model.frictions = {{"friction", 0, 1, 0.0, 0.15, 0.15}};
  model.stops = {{"stop", 0, 1, clearance, 0.8}};
  model.omega = omega;
  return model;
}

DiagramProblem over_omega(double from, double to, int count) {
  DiagramProblem problem;
  problem.model_at = [](double omega) { return paper(omega); };
  problem.start_at = [](double) { return State{-0.5, 0.0, 0.0, 0.0}; };
  problem.from = from;
  problem.to = to;
  problem.count = count;
  problem.transient_periods = 60;
  problem.impacts = 30;
  problem.most_periods = 300;
  return problem;
}

TEST(Diagram, SameBitsForAnyNumberOfThreads) {
  DiagramProblem carry = over_omega(0.6, 7.0, 40);  // chatter, periodic and chaotic values
  carry.direction = Direction::both;
  DiagramProblem reset = over_omega(0.6, 7.0, 40);
  reset.start = StartRule::reset;
  for (DiagramProblem* problem : {&carry, &reset}) {
    problem->threads = 1;
    const Diagram one = run_diagram(*problem);
    EXPECT_TRUE(one.complete);
    for (const int threads : {2, 3, 7}) {
      problem->threads = threads;
      EXPECT_TRUE(run_diagram(*problem) == one) << threads << " threads";
    }
  }
}

/// Lanes round otherwise than a Motion: what a store does not know yet must not come from the other of the two.
TEST(Diagram, ResetThatKnowsEverySecondValueHasTheBitsOfTheWhole) {
  DiagramProblem problem = over_omega(0.6, 7.0, 130);
  problem.start = StartRule::reset;
  const Diagram whole = run_diagram(problem);
  problem.known = [&](std::size_t i) { return i % 2 == 0 ? &whole.points[i] : nullptr; };
  EXPECT_TRUE(run_diagram(problem) == whole);
}

TEST(Diagram, ResetIsTheSerialLoopOfOneValueEach) {
  DiagramProblem problem = over_omega(1.2, 4.0, 7);
  problem.start = StartRule::reset;
  const Diagram all = run_diagram(problem);
  for (int i = 0; i < 7; ++i) {
    problem.from = problem.to = sweep_value(1.2, 4.0, 7, i);
    problem.count = 1;
    EXPECT_TRUE(run_diagram(problem).points.at(0) == all.points.at(i)) << i;
  }
}

/// Two routes to one answer: `carry` runs the transient of its first value by a Motion, `reset` in lanes.
TEST(Diagram, TransientsInLanesEndOnTheOrbitOfAMotion) {
  for (const double omega : {1.3, 1.5, 2.2}) {
    DiagramProblem problem = over_omega(omega, omega, 1);
    problem.transient_periods = 300;
    const Diagram by_motion = run_diagram(problem);
    problem.start = StartRule::reset;
    const Diagram in_lanes = run_diagram(problem);
    const ImpactTable &a = by_motion.points[0].impacts, &b = in_lanes.points[0].impacts;
    ASSERT_EQ(a.size(), b.size());
    ASSERT_EQ(a.size(), 30U);
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_NEAR(a[i].w, b[i].w, 1e-10) << omega << " " << i;
      EXPECT_NEAR(a[i].flight, b[i].flight, 1e-10);
      EXPECT_NEAR(a[i].sliding, b[i].sliding, 1e-10);
      EXPECT_NEAR(a[i].phase, b[i].phase, 1e-10);
    }
  }
}

/// At omega = 4.9 a 5-2 orbit (200 impacts per 500 periods) coexists with a chaotic attractor (231 or so), which is
/// gone at 4.92. So the chain that begins at 4.9 on the chaotic one, and the one that comes back from 4.95, must differ
/// there.
TEST(Diagram, UpAndDownFindBothAttractorsOfOmega49) {
  DiagramProblem problem = over_omega(4.9, 4.95, 11);
  problem.start_at = [](double) { return State{-0.5, 0.5, 0.0, 0.0}; };
  problem.transient_periods = problem.most_periods = 500;
  problem.impacts = 1'000'000;
  problem.direction = Direction::both;
  const Diagram diagram = run_diagram(problem);
  const DiagramPoint &up = diagram.points.front(), &down = diagram.points.back();
  ASSERT_EQ(up.parameter, 4.9);
  ASSERT_EQ(down.parameter, 4.9);
  ASSERT_EQ(down.direction, Direction::down);
  EXPECT_NEAR(static_cast<double>(up.impacts.size()), 231.0, 4.0);
  EXPECT_EQ(down.impacts.size(), 200U);
}

TEST(Diagram, RowsOfAPeriodicMotionAreOneRow) {
  DiagramProblem problem = over_omega(2.2, 2.2, 1);
  problem.transient_periods = 300;
  const Diagram diagram = run_diagram(problem);
  const ImpactTable& impacts = diagram.points.at(0).impacts;
  ASSERT_EQ(impacts.size(), 30U);
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    EXPECT_NEAR(impacts[i].w, impacts[0].w, 1e-11);
    EXPECT_NEAR(impacts[i].flight, 1.0, 1e-11) << "the first row knows its flight too";
    EXPECT_NEAR(impacts[i].sliding, 1.0, 1e-11);
    ASSERT_EQ(impacts[i].state.size(), 4U);
    EXPECT_NEAR(impacts[i].state[0] - impacts[i].state[2], 0.0, 1e-15) << "at the stop";
  }
}

/// x = sin of the phase, watched by pads too soft to matter at 0.5 and -0.5: an engagement of each per period, half a
/// period apart.
TEST(Diagram, RowsOfChosenCompliantStopsAreTheirOwnEngagements) {
  DiagramProblem problem = over_omega(0.5, 0.8, 4);
  problem.model_at = [](double clearance) {
    Model model;
    model.name = "watched";
    model.coordinates = {{"x", 1.0}};
    model.springs = {{0, ground, 1.0}};
    model.dampers = {{0, ground, 0.25}};
    model.forces = {{0, 1, 0.25, 0.0}};
    model.compliant_stops = {{"up", 0, ground, clearance, 1e-9, 0.0, false},
                             {"down", ground, 0, clearance, 1e-9, 0.0, false}};
    model.omega = 1.0;
    return model;
  };
  problem.start_at = [](double) { return State{0.0, 0.0}; };
  for (const bool chosen : {false, true}) {
    if (chosen) problem.stops = {problem.model_at(0.5), {"down"}};
    for (const DiagramPoint& point : run_diagram(problem).points) {
      ASSERT_EQ(point.failure, "");
      ASSERT_EQ(point.impacts.size(), 30U) << point.parameter;
      for (std::size_t i = 0; i < 30; ++i) {
        EXPECT_NEAR(point.impacts[i].w, std::sqrt(1.0 - point.parameter * point.parameter), 1e-7);
        EXPECT_NEAR(point.impacts[i].flight, chosen ? 1.0 : 0.5, 1e-7);
        if (chosen) {
          EXPECT_EQ(point.impacts[i].contact, 1);
        }
      }
    }
  }
}

TEST(Diagram, AFailingValueDoesNotAbortTheSweep) {
  DiagramProblem problem = over_omega(2.0, 2.4, 5);
  problem.model_at = [](double omega) {
    if (omega == 2.0) throw InputError("no such model");
    if (omega == 2.4) throw NumericalError("gave up");
    return paper(omega);
  };
  const Diagram diagram = run_diagram(problem);
  EXPECT_TRUE(diagram.complete);
  EXPECT_EQ(diagram.points[0].failure, "no such model");
  EXPECT_EQ(diagram.points[0].impacts.size(), 0U);
  EXPECT_EQ(diagram.points[4].failure, "gave up");
  for (int i = 1; i < 4; ++i) {
    EXPECT_EQ(diagram.points[i].failure, "");
    EXPECT_EQ(diagram.points[i].impacts.size(), 30U);
  }
}

TEST(Diagram, CarriedStateBeyondTheNewStopStartsAnewAndSaysSo) {
  DiagramProblem problem = over_omega(0.0, 0.4, 5);
  problem.model_at = [](double clearance) { return paper(2.2, clearance); };
  problem.start_at = [](double) { return State{-2.0, 0.0, 0.0, 0.0}; };
  problem.direction = Direction::down;  // the room shrinks; at this phase the blocks are not far from the stop
  problem.from = -2.0;
  const Diagram diagram = run_diagram(problem);
  int anew = 0;
  for (const DiagramPoint& point : diagram.points) {
    EXPECT_EQ(point.failure, "");
    anew += !point.note.empty();
  }
  EXPECT_GT(anew, 0);
  EXPECT_TRUE(diagram.points[0].note.empty()) << "the first value has nothing to carry";
}

TEST(Diagram, RoundingOfAClosedStopIsUndoneAndAViolationIsNot) {
  const Model model = paper(2.2, 0.1);
  State outside{0.1 + 0.7, 0.0, 0.7, 0.0};
  while (outside[0] - outside[2] - 0.1 <= 0.0) outside[0] = std::nextafter(outside[0], 1.0);
  undo_rounding(model, outside);
  EXPECT_LE(outside[0] - outside[2] - 0.1, 0.0);
  EXPECT_NEAR(outside[0], 0.8, 1e-15);
  State violation{0.81, 0.0, 0.7, 0.0};
  undo_rounding(model, violation);
  EXPECT_EQ(violation[0], 0.81);
}

TEST(Diagram, CarriesThroughAClosedStopWithClearance) {
  DiagramProblem problem = over_omega(0.5, 0.6, 11);
  problem.model_at = [](double omega) { return paper(omega, 0.1); };
  for (const DiagramPoint& point : run_diagram(problem).points) {
    EXPECT_EQ(point.failure, "") << point.parameter;
    EXPECT_EQ(point.note, "") << point.parameter;
  }
}

TEST(Diagram, CancelledSweepReturnsOnlyWholePointsAndSaysSo) {
  DiagramProblem problem = over_omega(2.0, 2.4, 200);
  std::atomic<bool> cancel{false};
  problem.cancel = &cancel;
  problem.threads = 2;
  problem.progress = [&](int done, int total) {
    EXPECT_EQ(total, 200);
    if (done == 5) cancel = true;
  };
  const Diagram diagram = run_diagram(problem);
  EXPECT_FALSE(diagram.complete);
  int done = 0;
  for (const DiagramPoint& point : diagram.points) {
    done += point.done;
    EXPECT_EQ(point.impacts.size(), point.done ? 30U : 0U);
  }
  EXPECT_GE(done, 5);
  EXPECT_LT(done, 20);
}

TEST(Diagram, MeaninglessProblemsAreRefusedByField) {
  const auto message = [](auto&& change) -> std::string {
    DiagramProblem problem = over_omega(1.0, 2.0, 5);
    change(problem);
    try {
      (void)run_diagram(problem);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message([](auto& p) { p.count = 0; }).find("count"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.to = p.from; }).find("from"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.to = std::nan(""); }).find("finite"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.impacts = 0; }).find("impacts"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.transient_periods = -1; }).find("transient"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.threads = -1; }).find("threads"), std::string::npos);
  EXPECT_NE(message([](auto& p) {
              p.start = StartRule::reset;
              p.direction = Direction::both;
            }).find("reset"),
            std::string::npos);
}

}  // namespace
}  // namespace slapstick::sweep
