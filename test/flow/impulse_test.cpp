/// Blows in no time: momentum, what closed stops bear and what friction does not, and short pulses that become blows.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "runs.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/run_up.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick::testing {
namespace {

const std::string mass = "[[coordinate]]\nname = 'x'\nmass = 2\n";
const std::string spring = "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 1\n";
const std::string damper = "[[damper]]\nbetween = ['x', 'ground']\ncoefficient = 0.2\n";
const std::string pad = "[[friction]]\nname = 'pad'\nbetween = ['x', 'ground']\nstatic = 0.5\nkinetic = 0.25\n";
const std::string wall = "[[stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nclearance = 0\nrestitution = 0.7\n";
const std::string pressed = "[[force]]\non = 'x'\nharmonic = 0\namplitude = 1\n";

Model built(const std::string& text) { return ModelDefinition::parse("name = 'm'\n" + text, "f.toml").build(); }

std::string blow(const std::string& momentum, const std::string& when = "time = 1", const std::string& on = "x") {
  return "[[impulse]]\nname = 'hammer'\non = '" + on + "'\nmomentum = " + momentum + "\n" + when + "\n";
}

/// m v = P from rest.
TEST(Impulse, GivesItsMomentum) {
  const System system(built(mass + spring + blow("3")));
  Motion motion(system, {0.0, 0.0});
  ASSERT_EQ(kinds(run(motion, 2.0)), "knot");
  const double w = std::sqrt(0.5);
  EXPECT_NEAR(motion.state()[0], 1.5 / w * std::sin(w), 1e-15);
  EXPECT_NEAR(motion.state()[1], 1.5 * std::cos(w), 1e-15);
}

/// Friction is bounded and takes nothing: the mass slips at P / m against f, and stops after m v / f.
TEST(Impulse, TearsADryContactLooseWhateverItsLimit) {
  for (const double sign : {1.0, -1.0}) {
    const System system(built(mass + pad + blow(std::to_string(3.0 * sign))));
    Motion motion(system, {0.0, 0.0});
    const std::vector<Event> events = run(motion, 20.0);
    ASSERT_EQ(kinds(events), "knot release stick");
    EXPECT_EQ(seconds(events[1], motion), 1.0);
    EXPECT_NEAR(seconds(events[2], motion), 1.0 + 2.0 * 1.5 / 0.25, 1e-13);
    EXPECT_NEAR(motion.state()[0], sign * 0.5 * 1.5 * 1.5 / 0.125, 1e-13);
  }
}

/// A stop that is closed bears what presses it, without an impact, and lets go of what pulls.
TEST(Impulse, IsBorneByAClosedStop) {
  const System into(built(mass + wall + pressed + blow("3")));
  Motion held(into, {0.0, 0.0});
  EXPECT_EQ(kinds(run(held, 5.0)), "knot");
  EXPECT_EQ(held.state(), (State{0.0, 0.0}));

  const System away(built(mass + wall + pressed + blow("-3")));  // back after 2 v m / F = 6
  Motion free(away, {0.0, 0.0});
  const std::vector<Event> events = run(free, 7.5);
  ASSERT_EQ(kinds(events), "knot release impact");
  EXPECT_NEAR(seconds(events[2], free), 7.0, 1e-13);
  EXPECT_NEAR(events[2].w, 1.5, 1e-13);
}

/// .. an open one is not: a body that has just bounced at 1 is blown back by 2, and hits at what is left.
TEST(Impulse, OnABodyThatTouchesAnOpenStopIsFollowedByAnImpact) {
  const System system(built(mass + wall + blow("4")));
  Motion motion(system, {-1.0, 1.0});
  const std::vector<Event> events = run(motion, 1.5);
  ASSERT_EQ(kinds(events), "impact knot impact");
  EXPECT_EQ(events[0].w, 1.0);
  EXPECT_NEAR(events[2].w, 1.3, 1e-15);
  EXPECT_NEAR(motion.state()[1], -0.7 * 1.3, 1e-15);
}

/// Two bodies, the first against the second: both go with the momentum, and nothing is lost to an impact.
TEST(Impulse, MovesWhatIsPushedTogether) {
  const std::string second = "[[coordinate]]\nname = 'y'\nmass = 1\n",
                    between = "[[stop]]\nname = 'gap'\nbetween = ['x', 'y']\nclearance = 0\nrestitution = 0.7\n",
                    squeezed = "[[force]]\non = 'y'\nharmonic = 0\namplitude = -1\n";
  const System system(built(mass + second + between + pressed + squeezed + blow("3")));
  Motion motion(system, {0.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(kinds(run(motion, 2.0)), "knot");
  EXPECT_NEAR(motion.state()[0], 1.0, 1e-15);
  EXPECT_NEAR(motion.state()[3], 1.0, 1e-15);
}

/// A pulse of length h and area P becomes the blow: the motions differ by O(h), in any state of the contacts.
TEST(Impulse, IsTheLimitOfAShortPulse) {
  const std::string second =
      "[[coordinate]]\nname = 'y'\nmass = 1\n[[spring]]\nbetween = ['x', 'y']\nstiffness = 3\n"
      "[[damper]]\nbetween = ['y', 'ground']\ncoefficient = 0.1\n";
  for (const std::string& contacts : {std::string(), pad, wall + pressed, pad + wall + pressed}) {
    for (const double momentum : {2.0, -2.0}) {
      const std::string machine = mass + second + spring + contacts;
      const System struck(built(machine + blow(std::to_string(momentum))));
      Motion exact(struck, {0.0, 0.0, 0.1, 0.0});
      run(exact, 3.0);
      std::vector<double> errors;
      for (const double h : {1e-3, 1e-4}) {
        const std::string at = std::to_string(1.0 + h), size = std::to_string(momentum / h);
        const System pushed(built(machine + "[[signal]]\nname = 's'\npoints = [[1, 0], [1, " + size + "], [" + at +
                                  ", " + size + "], [" + at +
                                  ", 0]]\n[[force]]\non = 'x'\nsignal = 's'\namplitude = 1\n"));
        Motion motion(pushed, {0.0, 0.0, 0.1, 0.0});
        run(motion, 3.0);
        double error = 0.0;
        for (std::size_t i = 0; i < 4; ++i) error = std::max(error, std::abs(motion.state()[i] - exact.state()[i]));
        errors.push_back(error);
      }
      EXPECT_LT(errors[0], 0.02) << contacts << momentum;
      EXPECT_NEAR(errors[1], 0.1 * errors[0], 0.03 * errors[0] + 1e-15) << contacts << momentum;
    }
  }
}

/// A period of its own, the forcing's phase and a clock without forcing say the same.
TEST(Impulse, ComesBackAsItIsSaid) {
  const std::string machine = mass + spring + damper + wall;
  const Model by_phase = built("omega = 2\n" + machine + blow("0.5", "phase = 1")),
              by_period = built(machine + blow("0.5", "time = 0.5\nperiod = 3.14159265358979312")),
              beside = built(machine + "[[force]]\non = 'x'\namplitude = 1e-300\nfrequency = 1\n" +
                             blow("0.5", "time = 0.5\nperiod = 3.14159265358979312"));
  EXPECT_TRUE(by_phase.periodic());
  EXPECT_TRUE(by_period.periodic());
  EXPECT_FALSE(beside.periodic());
  const System one(by_phase), two(by_period), three(beside);
  Motion a(one, {-0.1, 0.0}), b(two, {-0.1, 0.0}), c(three, {-0.1, 0.0});
  run(a, 40.0), run(b, 40.0), run(c, 40.0);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(a.state()[i], b.state()[i], 1e-11);
    EXPECT_NEAR(a.state()[i], c.state()[i], 1e-11);
  }
}

TEST(Impulse, ThatCannotBeIsRefusedInOneLine) {
  const auto refusal = [](const std::string& text) {
    try {
      built(text);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal(mass + blow("1", "phase = 1")).find("no 'omega'"), std::string::npos);
  EXPECT_NE(refusal(mass + blow("1", "time = 0")).find("not positive"), std::string::npos);
  EXPECT_NE(refusal(mass + blow("1", "time = 1\nperiod = -1")).find("not positive"), std::string::npos);
  EXPECT_NE(refusal("omega = 1\n" + mass + blow("1", "time = 1\nphase = 1")), "");
  EXPECT_NE(refusal(mass + blow("1", "time = 1", "y")), "");
  EXPECT_FALSE(built("omega = 1\n" + mass + blow("0", "phase = 1")).forced());
}

/// A ball of weight g on a table that goes up and down by straight lines.
std::string ball(double g, const std::string& table) {
  return "[[base]]\nname = 'table'\nsignal = 's'\n[[signal]]\nname = 's'\npoints = " + table +
         "\n[[coordinate]]\nname = 'x'\nmass = 2\nbase = 'table'\n[[force]]\non = 'x'\nharmonic = 0\namplitude = " +
         std::to_string(-2.0 * g) +
         "\n[[stop]]\nname = 'top'\nbetween = ['table', 'x']\nclearance = 0\nrestitution = 0.7\n";
}

/// In the room's frame the ball falls freely, and the table's corners are nothing to it.
TEST(WallOfASignal, MeetsABallThatKnowsNothingOfItsCorners) {
  const double g = 0.83, r = 0.7;
  const System system(built(ball(g, "[[0, 0], [1, 1.3], [2.5, 0]]\nrepeats = true")));
  Motion motion(system, {0.4, -1.3 + 0.2});  // seen from the table
  std::vector<double> expected;
  double y = 0.4, v = 0.2, t = 0.0, corner = 0.0, height = 0.0;  // table: height + slope (t - corner)
  for (int line = 0; t < 90.0; ++line) {
    const double slope = line % 2 == 0 ? 1.3 : -1.3 / 1.5, end = corner + (line % 2 == 0 ? 1.0 : 1.5);
    for (;;) {  // y + v s - g s^2 / 2 = height + slope (t + s - corner)
      const double gap = std::max(0.0, y - height - slope * (t - corner)), w = v - slope;
      const double s = (w + std::sqrt(w * w + 2.0 * g * gap)) / g;
      if (t + s >= end) break;
      t += s, y += v * s - 0.5 * g * s * s, v += -g * s;
      v = slope - r * (v - slope);
      expected.push_back(t);
    }
    const double s = end - t;
    y += v * s - 0.5 * g * s * s, v -= g * s, t = end;
    height += slope * (end - corner), corner = end;
  }
  std::vector<double> found;
  for (const Event& event : run(motion, 80.0))
    if (event.kind == EventKind::impact) found.push_back(seconds(event, motion));
  ASSERT_GT(found.size(), 10U);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-9) << i;
}

/// A ball that rests on the table is hit where the table turns upwards, at the jump of its speed, and is left behind
/// where the table turns downwards.
TEST(WallOfASignal, HitsWhatRestsOnIt) {
  const System up(built(ball(1.0, "[[0, 0], [1, -0.5], [9, 3.5]]")));
  Motion hit(up, {0.0, 0.0});
  const std::vector<Event> events = run(hit, 1.1);
  ASSERT_EQ(kinds(events), "knot knot impact");  // of the signal, and of its second derivative
  EXPECT_EQ(events[2].w, 1.0);
  EXPECT_NEAR(hit.state()[1], 0.7 - 0.1, 1e-14);

  const System down(built(ball(1.0, "[[0, 0], [1, 0.5], [9, -3.5]]")));
  Motion left(down, {0.0, 0.0});
  ASSERT_EQ(kinds(run(left, 1.1)), "knot knot release");
  EXPECT_NEAR(left.state()[1], 1.0 - 0.1, 1e-14);
}

TEST(WallOfASignal, MayNotStep) { EXPECT_THROW(built(ball(1.0, "[[0, 0], [1, -0.5], [1, 1], [2, 0]]")), InputError); }

}  // namespace
}  // namespace slapstick::testing
