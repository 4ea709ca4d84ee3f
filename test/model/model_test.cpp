/// Every meaningless model is refused, and the message names the part and the value.
#include "slapstick/model/model.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numbers>

#include "base/nearest.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const double nan = std::numeric_limits<double>::quiet_NaN();

Model two_blocks() {
  Model model;
  model.name = "blocks";
  model.coordinates = {{"x1", 1.0}, {"x2", 10.0}};
  model.springs = {{0, 1, 1.0}, {1, ground, 5.0}};
  model.dampers = {{0, 1, 0.2}, {1, ground, 1.0}};
  model.forces = {{0, 1, 1.0, 0.0}};
  model.frictions = {{"friction", 0, 1, 0.0, 0.15, 0.1}};
  model.stops = {{"stop", 0, 1, 0.0, 0.8}};
  model.compliant_stops = {{"bumper", 1, ground, 2.0, 50.0, 0.5, false}};
  model.omega = 2.0;
  return model;
}

std::string refusal(const std::function<void(Model&)>& spoil) {
  Model model = two_blocks();
  spoil(model);
  try {
    validate(model);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::string refusal(const State& state) {
  try {
    validate(two_blocks(), state);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Model, sound_model_is_accepted) {
  EXPECT_NO_THROW(validate(two_blocks()));
  EXPECT_EQ(refusal([](Model& m) { m.springs[0].stiffness = -3.0; }), "accepted");  // a falling characteristic
  EXPECT_EQ(refusal([](Model& m) { m.stops[0].restitution = 0.0; }), "accepted");
  EXPECT_EQ(refusal([](Model& m) { m.stops[0].restitution = 1.0; }), "accepted");
  EXPECT_EQ(refusal([](Model& m) { m.frictions[0].kinetic_friction = 0.15; }), "accepted");
  EXPECT_EQ(refusal([](Model& m) { m.stops[0].a = ground; }), "accepted");
}

TEST(Model, matrices_add_to_the_elements) {
  EXPECT_EQ(refusal([](Model& m) { m.damping = {-1, 0, 0, 0}; }), "accepted");     // a source of energy
  EXPECT_EQ(refusal([](Model& m) { m.stiffness = {0, -9, -9, 0}; }), "accepted");  // buckled
  EXPECT_EQ(refusal([](Model& m) { m.mass = {0, 3, 3, 0}; }), "accepted");         // 3^2 < 1 * 10
  EXPECT_EQ(refusal([](Model& m) {
              m.coordinates[0].mass = 0.0;
              m.mass = {1, 0, 0, 0};
            }),
            "accepted");
  EXPECT_NE(refusal([](Model& m) { m.mass = {1e60, 0, 0, 0}; }).find("too large"), std::string::npos);
}

TEST(Model, period_and_names) {
  Model model = two_blocks();
  EXPECT_TRUE(model.forced());
  EXPECT_DOUBLE_EQ(model.forcing_period(), std::numbers::pi);
  EXPECT_EQ(state_names(model), (std::vector<std::string>{"x1", "v1", "x2", "v2"}));
  model.coordinates[1].name = "base";
  EXPECT_EQ(state_names(model).back(), "v_base");
  model.forces[0].harmonic = 0;
  model.omega = 0.0;
  EXPECT_FALSE(model.forced());
  EXPECT_EQ(model.forcing_period(), 1.0);
  EXPECT_NO_THROW(validate(model));
}

TEST(Model, every_refusal_names_part_and_value) {
  const std::vector<std::pair<std::function<void(Model&)>, std::string>> cases = {
      {[](Model& m) { m.coordinates.clear(); }, "model: the model has no coordinates"},
      {[](Model& m) { m.coordinates[0].mass = 0.0; }, "coordinate 'x1': mass = 0 is not positive"},
      {[](Model& m) { m.coordinates[1].mass = -1.5; }, "coordinate 'x2': mass = -1.5 is not positive"},
      {[](Model& m) { m.coordinates[1].mass = 5e-324; },
       "coordinate 'x2': mass = 4.94065645841247e-324 is too small: below 1e-50 the arithmetic would overflow"},
      {[](Model& m) { m.coordinates[1].name = "x1"; }, "coordinate 'x1': name 'x1' is used twice"},
      {[](Model& m) { m.coordinates[1].name = "v1"; }, "coordinate 'v1': name 'v1' is used twice"},
      {[](Model& m) { m.coordinates[1].name = "ground"; }, "coordinate 'ground': name 'ground' is reserved"},
      {[](Model& m) { m.coordinates[1].name = ""; }, "coordinate 2: the name is empty"},
      {[](Model& m) { m.coordinates[1].name = "a\nb"; },
       "coordinate 'a\\x0ab': name 'a\\x0ab' is not 1 to 64 letters, digits and '_', beginning with a letter"},
      {[](Model& m) { m.springs[1].a = 2; }, "spring 2: coordinate index 2 is outside [0, 1]"},
      {[](Model& m) { m.springs[1].b = -2; }, "spring 2: coordinate index -2 is outside [0, 1]"},
      {[](Model& m) { m.springs[0].b = 0; }, "spring 1: both ends are 'x1'"},
      {[](Model& m) { m.dampers[1].a = ground; }, "damper 2: both ends are the ground"},
      {[](Model& m) { m.dampers[1].coefficient = -0.1; },
       "damper 2: coefficient = -0.1 is negative; a damper that may feed energy says feeds = true"},
      {[](Model& m) { m.forces[0].coordinate = ground; }, "force 1: a force acts on a coordinate, not on the ground"},
      {[](Model& m) { m.forces[0].coordinate = 9; }, "force 1: coordinate index 9 is outside [0, 1]"},
      {[](Model& m) { m.forces[0].harmonic = -1; }, "force 1: harmonic = -1 is negative"},
      {[](Model& m) { m.frictions[0].name = ""; }, "friction 1: the name is empty"},
      {[](Model& m) { m.frictions[0].b = 0; }, "friction 'friction': both ends are 'x1'"},
      {[](Model& m) { m.frictions[0].kinetic_friction = 0.2; },
       "friction 'friction': kinetic = 0.2 exceeds static = 0.15"},
      {[](Model& m) { m.frictions[0].static_friction = -0.2; }, "friction 'friction': static = -0.2 is negative"},
      {[](Model& m) { m.frictions[0].kinetic_friction = -0.2; }, "friction 'friction': kinetic = -0.2 is negative"},
      {[](Model& m) { m.stops[0].name = "friction"; }, "stop 'friction': name 'friction' is used twice"},
      {[](Model& m) { m.stops[0].a = 1; }, "stop 'stop': both ends are 'x2'"},
      {[](Model& m) { m.stops[0].restitution = 1.2; }, "stop 'stop': restitution = 1.2 is outside [0, 1]"},
      {[](Model& m) { m.stops[0].restitution = -0.1; }, "stop 'stop': restitution = -0.1 is outside [0, 1]"},
      {[](Model& m) { m.omega = 0.0; }, "model: omega = 0 is not positive"},
      {[](Model& m) { m.omega = -1.0; }, "model: omega = -1 is negative"},
      {[](Model& m) { m.omega = 5e-324; },
       "model: omega = 4.94065645841247e-324 is too small: below 1e-50 the arithmetic would overflow"},
      {[](Model& m) {
         m.forces[0].harmonic = 1000;
         m.omega = 1e308;
       },
       "model: omega = 1e+308 is too large: beyond 1e50 the arithmetic would overflow"},
      {[](Model& m) {
         m.forces.clear();
         m.omega = -1.0;
       },
       "model: omega = -1 is negative"},
  };
  for (const auto& [spoil, message] : cases) EXPECT_EQ(refusal(spoil), message);
}

TEST(Model, refusals_of_compliant_stops_and_matrices) {
  const std::vector<std::pair<std::function<void(Model&)>, std::string>> cases = {
      {[](Model& m) {
         m.stops.push_back({"back", 1, 0, 0.0, 0.8});
       },
       "stop 'back': clearance = 0 leaves no room opposite stop 'stop' with clearance = 0: their sum must be positive"},
      {[](Model& m) { m.compliant_stops[0].name = "stop"; }, "compliant_stop 'stop': name 'stop' is used twice"},
      {[](Model& m) { m.compliant_stops[0].stiffness = 0.0; },
       "compliant_stop 'bumper': stiffness = 0 is not positive; a damper alone beyond a gap is a damper that acts "
       "within an interval"},
      {[](Model& m) { m.compliant_stops[0].damping = -1.0; }, "compliant_stop 'bumper': damping = -1 is negative"},
      {[](Model& m) { m.compliant_stops[0].b = 1; }, "compliant_stop 'bumper': both ends are 'x2'"},
      {[](Model& m) {
         m.damping = {1, 2, 3};
       },
       "matrix: damping: has 3 entries, 4 needed"},
      {[](Model& m) {
         m.stiffness = {1, 2, 3, 4};
       },
       "matrix: stiffness: the matrix is not symmetric: [x2, x1] = 3 differs from [x1, x2] = 2"},
      {[](Model& m) {
         m.mass = {0, 0, 0, -10};
       },
       "coordinate 'x2': the coordinate has no mass: its own and its entry of [matrix] mass add up to 0"},
      {[](Model& m) {
         m.mass = {9, 10, 10, 0};
       },
       "matrix: mass: with the coordinates' masses it is not positive definite: some motion of the coordinates up to "
       "'x2' has no positive mass"},
  };
  for (const auto& [spoil, message] : cases) EXPECT_EQ(refusal(spoil), message);
}

TEST(Model, not_a_number_and_infinity_are_refused_in_every_field) {
  const std::vector<std::pair<std::string, std::function<double&(Model&)>>> fields = {
      {"mass", [](Model& m) -> double& { return m.coordinates[0].mass; }},
      {"stiffness", [](Model& m) -> double& { return m.springs[0].stiffness; }},
      {"coefficient", [](Model& m) -> double& { return m.dampers[0].coefficient; }},
      {"amplitude", [](Model& m) -> double& { return m.forces[0].amplitude; }},
      {"phase", [](Model& m) -> double& { return m.forces[0].phase; }},
      {"belt_speed", [](Model& m) -> double& { return m.frictions[0].belt_speed; }},
      {"static", [](Model& m) -> double& { return m.frictions[0].static_friction; }},
      {"kinetic", [](Model& m) -> double& { return m.frictions[0].kinetic_friction; }},
      {"clearance", [](Model& m) -> double& { return m.stops[0].clearance; }},
      {"restitution", [](Model& m) -> double& { return m.stops[0].restitution; }},
      {"clearance", [](Model& m) -> double& { return m.compliant_stops[0].clearance; }},
      {"stiffness", [](Model& m) -> double& { return m.compliant_stops[0].stiffness; }},
      {"damping", [](Model& m) -> double& { return m.compliant_stops[0].damping; }},
      {"omega", [](Model& m) -> double& { return m.omega; }},
  };
  for (const auto& [field, at] : fields)
    for (const double bad : {nan, infinity, -infinity}) {
      const auto message = refusal([&at = at, bad](Model& m) { at(m) = bad; });
      EXPECT_NE(message.find(": " + field + " = "), std::string::npos) << message;
      EXPECT_NE(message.find("is not a finite number"), std::string::npos) << message;
    }
}

TEST(Model, start_beyond_the_stop_is_refused) {
  EXPECT_EQ(refusal(State{-0.5, 0, 0, 0}), "accepted");
  EXPECT_EQ(refusal(State{0, 1, 0, 0}), "accepted");  // touching, even closing in: the first event is at once
  EXPECT_EQ(refusal(State{0.25, 0, 0, 0}), "state: stop 'stop' is violated: x1 - x2 = 0.25 > clearance = 0");
  EXPECT_EQ(refusal(State{0, 0, 0}), "state: 3 numbers given, 4 needed");
  EXPECT_EQ(refusal(State{0, nan, 0, 0}), "state: v1 = nan is not a finite number");
  EXPECT_EQ(refusal(State{-infinity, 0, 0, 0}), "state: x1 = -inf is not a finite number");
}

TEST(Nearest, slips_of_the_finger_find_the_name) {
  const std::vector<std::string> names = {"omega", "clearance", "static_friction", "kinetic_friction", "x1", "x2"};
  EXPECT_EQ(nearest("omgea", names), "omega");
  EXPECT_EQ(nearest("clearence", names), "clearance");
  EXPECT_EQ(nearest("static_frction", names), "static_friction");
  EXPECT_EQ(nearest("kinetic", names), "kinetic_friction");
  EXPECT_EQ(nearest("temperature", names), "");
  EXPECT_EQ(nearest("", names), "");
  EXPECT_EQ(nearest(std::string(100000, 'x'), names), "");
  EXPECT_EQ(nearest("vp", {"p", "v_p"}), "v_p") << "an underscore left out is nearer than a letter";
  EXPECT_EQ(nearest("Omega", names), "omega");
  EXPECT_EQ(suggestion("omgea", names), "; did you mean 'omega'?");
  EXPECT_EQ(suggestion("temperature", {"a_b", "c_d"}), "; known: a_b, c_d");
}

TEST(Model, numbers_whose_products_overflow_are_refused) {
  for (const double huge : {1.1e50, 1e160, 1e307}) {
    const std::string end = " is too large: beyond 1e50 the arithmetic would overflow";
    EXPECT_TRUE(refusal([&](Model& m) { m.coordinates[0].mass = huge; }).ends_with(end));
    EXPECT_TRUE(refusal([&](Model& m) { m.springs[0].stiffness = -huge; }).ends_with(end));
    EXPECT_TRUE(refusal([&](Model& m) { m.dampers[0].coefficient = huge; }).ends_with(end));
    EXPECT_TRUE(refusal([&](Model& m) { m.forces[0].amplitude = -huge; }).ends_with(end));
    EXPECT_TRUE(refusal([&](Model& m) { m.frictions[0].static_friction = huge; }).ends_with(end));
    EXPECT_TRUE(refusal([&](Model& m) { m.frictions[0].belt_speed = huge; }).ends_with(end));
    EXPECT_TRUE(refusal([&](Model& m) { m.stops[0].clearance = huge; }).ends_with(end));
    EXPECT_TRUE(refusal([&](Model& m) { m.omega = huge; }).ends_with(end));
    EXPECT_TRUE(refusal(State{-huge, 0, 0, 0}).ends_with(end));
  }
  EXPECT_EQ(refusal([](Model& m) { m.forces[0].amplitude = 1e49; }), "accepted");
  EXPECT_EQ(refusal([](Model& m) { m.forces[0].phase = 1e307; }), "accepted");  // an angle: only its sine is used
}

TEST(Model, a_stop_so_far_away_that_the_motion_rounds_to_nothing_is_refused) {
  Model model = two_blocks();
  model.stops[0].clearance = 1e9;
  EXPECT_NO_THROW(validate(model, {-0.5, 0, 0, 0}));
  model.stops[0].clearance = 1e16;
  EXPECT_THROW(validate(model, {-0.5, 0, 0, 0}), InputError);
}

}  // namespace
}  // namespace slapstick
