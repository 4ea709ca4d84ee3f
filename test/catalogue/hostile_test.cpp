/// Items of the catalogue that are about software: K34, meaningless numbers in every field; K35, a processor left in
/// flush-to-zero.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/floating_point.hpp"
#include "catalogue/run.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/sweep/parallel.hpp"
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace slapstick {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest = std::numeric_limits<double>::max();  // 1.8e308 itself reads as infinity
constexpr double smallest = std::numeric_limits<double>::denorm_min();

Model two_blocks() {
  Model model;
  model.coordinates = {{"x1", 1.0}, {"x2", 10.0}};
  model.springs = {{0, 1, 1.0}, {1, ground, 5.0}};
  model.dampers = {{0, 1, 0.2}, {1, ground, 1.0}};
  model.forces = {{0, 1, 1.0, 0.0}};
  model.frictions = {{"friction", 0, 1, 0.0, 0.15, 0.1}};
  model.stops = {{"stop", 0, 1, 0.25, 0.8}};
  model.compliant_stops = {{"bumper", 1, ground, 0.125, 50.0, 0.5, false}};
  model.omega = 2.0;
  return model;
}

/// A model and a start, and one number of them.
struct Case {
  Model model = two_blocks();
  State start = {-0.5, 0.125, 0.0625, 0.25};
};
using Field = double& (*)(Case&);

const std::pair<const char*, Field> fields[] = {
    {"mass", [](Case& c) -> double& { return c.model.coordinates[0].mass; }},
    {"stiffness", [](Case& c) -> double& { return c.model.springs[0].stiffness; }},
    {"coefficient", [](Case& c) -> double& { return c.model.dampers[0].coefficient; }},
    {"amplitude", [](Case& c) -> double& { return c.model.forces[0].amplitude; }},
    {"phase", [](Case& c) -> double& { return c.model.forces[0].phase; }},
    {"belt_speed", [](Case& c) -> double& { return c.model.frictions[0].belt_speed; }},
    {"static", [](Case& c) -> double& { return c.model.frictions[0].static_friction; }},
    {"kinetic", [](Case& c) -> double& { return c.model.frictions[0].kinetic_friction; }},
    {"clearance", [](Case& c) -> double& { return c.model.stops[0].clearance; }},
    {"restitution", [](Case& c) -> double& { return c.model.stops[0].restitution; }},
    {"clearance", [](Case& c) -> double& { return c.model.compliant_stops[0].clearance; }},
    {"stiffness", [](Case& c) -> double& { return c.model.compliant_stops[0].stiffness; }},
    {"damping", [](Case& c) -> double& { return c.model.compliant_stops[0].damping; }},
    {"omega", [](Case& c) -> double& { return c.model.omega; }},
    {"x1", [](Case& c) -> double& { return c.start[0]; }},
    {"v1", [](Case& c) -> double& { return c.start[1]; }},
    {"x2", [](Case& c) -> double& { return c.start[2]; }},
    {"v2", [](Case& c) -> double& { return c.start[3]; }}};

/// What comes of it: the refusal, or every event and state of three periods.
struct Outcomes {
  std::string refusal;
  std::vector<double> numbers;
  std::string kinds;
  State end;
};

Outcomes outcome(Field field, double value) {
  Case c;
  field(c) = value;
  Outcomes out;
  try {
    const System system(c.model);
    Motion motion(system, c.start);
    while (motion.advance({3, 0.0}) == Outcome::event) {
      out.kinds += std::string(name(motion.event().kind)) + " ";
      out.numbers.push_back(motion.event().time.since({}));
      for (const double x : motion.state()) out.numbers.push_back(x);
    }
    out.end = motion.state();
  } catch (const InputError& error) {
    out.refusal = error.what();
  }
  return out;
}

TEST(K34, not_a_number_and_infinity_are_refused_by_the_name_of_their_field) {
  for (const auto& [field, at] : fields) {
    for (const double bad : {std::nan(""), infinity, -infinity}) {
      const std::string refusal = outcome(at, bad).refusal;
      EXPECT_NE(refusal.find(field), std::string::npos) << field << " " << bad << ": " << refusal;
      EXPECT_EQ(refusal.find('\n'), std::string::npos);
    }
  }
}

TEST(K34, minus_zero_is_zero_to_the_last_bit) {
  for (const auto& [field, at] : fields) {
    const Outcomes plus = outcome(at, 0.0), minus = outcome(at, -0.0);
    EXPECT_EQ(plus.refusal.empty(), minus.refusal.empty()) << field;
    EXPECT_EQ(plus.kinds, minus.kinds) << field;
    EXPECT_EQ(plus.numbers, minus.numbers) << field;
    EXPECT_EQ(plus.end, minus.end) << field;
  }
}

TEST(K34, the_smallest_number_is_refused_or_as_good_as_zero) {
  for (const auto& [field, at] : fields) {
    const Outcomes zero = outcome(at, 0.0);
    for (const double tiny : {smallest, -smallest}) {
      const Outcomes found = outcome(at, tiny);
      if (!found.refusal.empty()) {
        EXPECT_NE(found.refusal.find(field), std::string::npos) << field << ": " << found.refusal;
        continue;
      }
      EXPECT_EQ(zero.refusal, "") << field << " is refused at 0 and not at " << tiny;
      for (int i = 0; i < 4; ++i) EXPECT_NEAR(found.end[i], zero.end[i], 1e-13) << field << " " << tiny;
    }
  }
}

TEST(K34, the_largest_number_is_refused_by_the_name_of_its_field) {
  for (const auto& [field, at] : fields) {
    for (const double huge : {largest, -largest}) {
      const Outcomes found = outcome(at, huge);
      if (std::string_view(field) == "phase") {  // an angle like any other
        EXPECT_EQ(found.refusal, "");
        for (const double x : found.end) EXPECT_LT(std::abs(x), 10.0);
        continue;
      }
      EXPECT_NE(found.refusal.find(field), std::string::npos) << field << " " << huge << ": " << found.refusal;
    }
  }
}

#if defined(__SSE2__)

/// Leaves the processor as a library that was built for speed does.
class Flushing {
 public:
  Flushing() : found_(_mm_getcsr()) { _mm_setcsr(found_ | flush_bits); }
  ~Flushing() { _mm_setcsr(found_); }
  Flushing(const Flushing&) = delete;
  Flushing& operator=(const Flushing&) = delete;
  [[nodiscard]] static bool on() { return (_mm_getcsr() & flush_bits) == flush_bits; }

 private:
  static constexpr unsigned flush_bits = 0x8040;  // FTZ | DAZ
  unsigned found_;
};

/// A free oscillation of 1e-310: all of it is subnormal.
State tiny_oscillation(const System& system) {
  Motion motion(system, {1e-310, 0.0});
  motion.advance(Instant{}.plus(1.0 / system.period()));
  return motion.state();
}

Model free_oscillator() {
  Model model;
  model.coordinates = {{"x", 1.0}};
  model.springs = {{0, ground, 1.0}};
  return model;
}

/// What `work` returns with the processor flushing. Compared outside: while it flushes, a subnormal number equals zero.
template <class Work>
auto while_flushing(const Work& work) {
  const Flushing flushing;
  auto result = work();
  EXPECT_TRUE(Flushing::on()) << "not given back";
  return result;
}

TEST(K35, flush_to_zero_would_change_the_result) {  // or the others could not fail
  const System system(free_oscillator());
  const State expected = tiny_oscillation(system);
  EXPECT_NEAR(expected[0] / 1e-310, std::cos(1.0), 1e-12);
  const volatile double tiny = 1e-310, half = 0.5;
  volatile double product = 1.0;  // stored before the processor flushes no more
  while_flushing([&] {
    product = tiny * half;
    return 0;
  });
  EXPECT_EQ(product, 0.0);
}

TEST(K35, is_seen_switched_off_and_given_back) {
  const System system(free_oscillator());
  const State expected = tiny_oscillation(system);
  const State found = while_flushing([&] {
    const IeeeArithmetic ieee;
    EXPECT_TRUE(ieee.was_flushing());
    EXPECT_FALSE(Flushing::on());
    return tiny_oscillation(system);
  });
  EXPECT_EQ(found, expected);
}

TEST(K35, does_not_reach_a_motion_of_its_own) {
  const System system(free_oscillator());
  const State expected = tiny_oscillation(system);
  EXPECT_EQ(while_flushing([&] { return tiny_oscillation(system); }), expected);
}

TEST(K35, does_not_reach_the_threads_of_a_sweep) {  // the caller is one of them
  const System system(free_oscillator());
  const State expected = tiny_oscillation(system);
  const auto found = while_flushing([&] {
    std::vector<State> all(64);
    sweep::for_each_index(64, 0, [&](int i) { all[i] = tiny_oscillation(system); });
    return all;
  });
  for (const State& state : found) EXPECT_EQ(state, expected);
}

#endif

}  // namespace
}  // namespace slapstick
