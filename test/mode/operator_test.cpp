/// The window operators of a mode against 50-digit exponentials of the same matrix, on the families where closed forms
/// with eigenvectors lose their digits. Case numbers K are those of test/catalogue/catalogue.json.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "event/first_root.hpp"
#include "mode/exact_flow.hpp"
#include "oracle/models.hpp"

namespace slapstick::mode {
namespace {

using event::Lane8;
using testing::Exact;
using testing::Real;

/// One mode, a state, and the largest errors of its operators in units of what is allowed.
class Check {
 public:
  Check(const Model& model, const ContactStates& states, std::uint64_t seed)
      : frame_(model), mode_(model, frame_, states), random_(seed) {}

  /// Starts of random sizes, 1e-3 .. 1 per component.
  void random_starts(int count) {
    for (int k = 0; k < count; ++k) {
      X_.assign((mode_.size() + 7) / 8 * 8, 0.0);
      for (int i = 0; i < 2 * frame_.d; ++i) X_[i] = std::pow(10.0, uniform(-3, 0)) * (uniform(-1, 1) < 0 ? -1 : 1);
      frame_.set_clock(Instant{}.plus(uniform(0, 1)), X_.data());
      exact_.assign(X_.begin(), X_.begin() + mode_.size());
      magnitude_ = X_;
      for (double& x : magnitude_) x = std::abs(x);
      step();
      inside();
      guards();
    }
  }

  double state_error = 0.0;   ///< |computed - exact| of one window's step, over 2^-53 times sum |E_ij X_j|
  double inside_error = 0.0;  ///< the same at points inside the window, over the terms of the series
  double guard_error = 0.0;   ///< |computed - exact| of the guards over their noise bound
  double coefficient_error = 0.0;
  double hull_error = 0.0;
  double mean_guard_error = 0.0;
  long guard_count = 0;
  long excluded = 0, excluded_at_once = 0;  ///< guards, by their hulls and by the quick look

  [[nodiscard]] const Mode& mode() const { return mode_; }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  void step() {
    event::Lanes out(mode_.state_blocks());
    mode_.step(X_.data(), out.data());
    compare(out, mode_.window(), false, state_error);
  }

  void inside() {
    event::Lanes out(mode_.state_blocks());
    const double x = uniform(0, 1);
    mode_.state_at(x, X_.data(), reinterpret_cast<double*>(out.data()));
    compare(out, x * mode_.window(), true, inside_error);
  }

  void compare(const event::Lanes& out, double s, bool terms, double& worst) const {
    const Exact exact = testing::flow(mode_.system(), exact_, Real(s));
    std::vector<double> size = testing::sizes(mode_.system(), X_, s, terms);
    for (int i = 0; i < frame_.d; ++i) size[frame_.u(i)] += std::abs(frame_.drift[i]);  // u = p' - drift
    for (int i = 0; i < 2 * frame_.d; ++i) {
      const double error = abs(Real(out[i / 8][i % 8]) - exact[i]).convert_to<double>();
      if (error > 0.0) worst = std::max(worst, error / (event::unit_roundoff * size[i]));
    }
  }

  void guards() {
    const auto terms = testing::series(mode_.system(), exact_, Real(mode_.window()), event::most_terms);
    for (int g = 0; g < mode_.guard_count(); ++g) {
      std::vector<Real> exact;
      for (const Exact& term : terms) exact.push_back(testing::dot(mode_.guards()[g].row, term));
      coefficients(g, exact);
      for (const int order : {0, 1, 2, 3, 5}) {
        hull(g, order, exact);
        values(g, order, exact);
      }
    }
  }

  void coefficients(int g, const std::vector<Real>& exact) {
    Lane8 a, noise;
    mode_.leading(g, X_.data(), magnitude_.data(), a, noise);
    for (int n = 0; n < 8; ++n) {
      const double error = abs(Real(a[n]) - exact[n]).convert_to<double>();
      if (error > 0.0) coefficient_error = std::max(coefficient_error, error / noise[n]);
    }
  }

  /// The guard with its first `order` terms left out and x^order divided out, the whole series.
  static Real quotient(const std::vector<Real>& a, int order, const Real& x) {
    Real sum = 0;
    for (int n = static_cast<int>(a.size()) - 1; n >= order; --n) sum = sum * x + a[n];
    return sum;
  }

  /// The hull polynomial at a point, by de Casteljau's scheme.
  static Real on_hull(const Lane8& bernstein, const Real& x) {
    std::array<Real, 8> b;
    for (int j = 0; j < 8; ++j) b[j] = bernstein[j];
    for (int left = 7; left > 0; --left)
      for (int j = 0; j < left; ++j) b[j] += x * (b[j + 1] - b[j]);
    return b[0];
  }

  void hull(int g, int order, const std::vector<Real>& exact) {
    event::Hull hull;
    mode_.enclose(g, order, X_.data(), magnitude_.data(), hull);
    for (const double x : {0.0, uniform(0, 1), 1.0}) {
      const double error = abs(on_hull(hull.bernstein, x) - quotient(exact, order, x)).convert_to<double>();
      if (error > 0.0) hull_error = std::max(hull_error, error / hull.bounds[event::hull_error]);
    }
    quick_look(g, order, hull);
  }

  /// The quick look must claim nothing that the hull cannot prove, with what more noise ever.
  void quick_look(int g, int order, const event::Hull& hull) {
    double size = 0.0;
    for (const double x : magnitude_) size += x;
    const double room = event::least(hull.bernstein) - hull.bounds[event::hull_error];
    EXPECT_FALSE(mode_.excludes(g, order, X_.data(), size, room)) << "guard " << g << " order " << order;
    excluded += order < 3 && event::excluded(hull);
    excluded_at_once += mode_.excludes(g, order, X_.data(), size, 0.0);
  }

  /// Computed values of the guard polynomial, remainder of the series included, against the guard of the exact flow.
  void values(int g, int order, const std::vector<Real>& series) {
    event::GuardWindow window;
    mode_.enclose(g, order, X_.data(), magnitude_.data(), window.hull);
    mode_.taylor(g, order, X_.data(), window.taylor);
    for (const double x : {uniform(0, 1), 1.0}) {
      const Real exact = quotient(series, order, x);
      const double error = abs(Real(event::value(window.taylor, event::Powers(x))) - exact).convert_to<double>();
      const Lane8& b = window.hull.bounds;
      const double bound = b[event::noise_0] + x * (b[event::noise_1] + x * b[event::noise_2]);
      if (error == 0.0 && bound == 0.0) continue;
      guard_error = std::max(guard_error, error / bound);
      mean_guard_error =
          (mean_guard_error * static_cast<double>(guard_count) + error / bound) / static_cast<double>(guard_count + 1);
      ++guard_count;
    }
  }

  Frame frame_;
  Mode mode_;
  std::mt19937_64 random_;
  std::vector<double> X_, magnitude_;
  Exact exact_;
};

ContactStates free_states(const Model& model, FrictionState friction = FrictionState::slip_plus) {
  return {std::vector<StopState>(model.stops.size(), StopState::open),
          std::vector<FrictionState>(model.frictions.size(), friction),
          {}};
}

void expect_bounded(const Check& check, const std::string& what) {
  EXPECT_LE(check.guard_error, 1.0) << what;
  EXPECT_LE(check.coefficient_error, 1.0) << what;
  EXPECT_LE(check.hull_error, 1.0) << what;
  EXPECT_LE(check.state_error, 16.0) << what;
  EXPECT_LE(check.inside_error, 16.0) << what;
}

Model random_model(std::mt19937_64& random, int n) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Model m;
  m.name = "random";
  m.omega = uniform(0.2, 5);
  for (int i = 0; i < n; ++i) {
    m.coordinates.push_back({"x" + std::to_string(i + 1), std::pow(10.0, uniform(-1, 1))});
    m.springs.push_back({i, i == 0 ? ground : i - 1, std::pow(10.0, uniform(-1, 1))});
    m.dampers.push_back({i, i == 0 ? ground : i - 1, std::pow(10.0, uniform(-2, 0.5))});
  }
  m.forces = {{0, 1, 1.0, uniform(0, 6)}, {n - 1, 2, 0.5, 0.0}, {0, 0, uniform(-1, 1), 0.0}};
  m.stops = {{"stop", 0, n > 1 ? 1 : ground, uniform(-0.5, 0.5), 0.5}};
  m.frictions = {{"friction", n - 1, ground, n % 2 == 0 ? 0.25 : 0.0, 0.5, 0.25}};
  return m;
}

TEST(WindowOperators, OfRandomSystemsStayWithinTheirNoiseInEveryMode) {
  std::mt19937_64 random(11);
  double mean = 0.0, state = 0.0, guard = 0.0;
  long count = 0;
  for (int k = 0; k < 24; ++k) {
    const Model model = random_model(random, 1 + k % 3);
    for (const StopState stop : {StopState::open, StopState::closed}) {
      for (const FrictionState friction : {FrictionState::slip_minus, FrictionState::stick, FrictionState::slip_plus}) {
        Check check(model, {{stop}, {friction}, {}}, static_cast<std::uint64_t>(k));
        check.random_starts(2);
        expect_bounded(check, "model " + std::to_string(k));
        mean += check.mean_guard_error * static_cast<double>(check.guard_count);
        count += check.guard_count;
        state = std::max(state, check.state_error);
        guard = std::max(guard, check.guard_error);
      }
    }
  }
  mean /= static_cast<double>(count);
  std::printf("random systems: state error %.2f u, guards: mean error / noise %.4f, largest %.3f\n", state, mean,
              guard);
  EXPECT_GE(mean, 0.01) << "the noise bound is empty";
}

/// Polylines over displacement and velocity, a normal force of the state and of a bounded stop: every guard that laws
/// of force have.
TEST(WindowOperators, OfEveryLawOfForceStayWithinTheirNoise) {
  using Over = Characteristic::Over;
  std::mt19937_64 random(13);
  double guard = 0.0;
  for (int k = 0; k < 6; ++k) {
    Model model = random_model(random, 2);
    model.compliant_stops = {{"bumper", 1, ground, 0.1, 20.0, 1.5, false, true}};
    model.characteristics = {{"bent", 0, ground, Over::displacement, {{-0.3, -0.1}, {0.2, 0.4}}, 0.5, 3.0},
                             {"valve", 1, 0, Over::velocity, {{0.0, 0.1}, {0.7, -0.2}}, 0.1, 0.6},
                             {"grease", 0, ground, Over::zones, {{-0.1, 0.8}, {0.3, 0.2}}, 0.1, 0.0}};
    model.frictions[0].normal = NormalForce{0.4, {{0, 0.7, -0.1}}, 0};
    for (const FrictionState friction : {FrictionState::slip_minus, FrictionState::stick, FrictionState::unloaded})
      for (const CompliantState bumper :
           {CompliantState::off, CompliantState::on, CompliantState::detached, CompliantState::bounded})
        for (int piece = 0; piece < 3; ++piece) {
          Check check(model, {{StopState::open}, {friction}, {bumper}, {piece, (piece + k) % 3, 2 - piece}},
                      static_cast<std::uint64_t>(k));
          check.random_starts(2);
          expect_bounded(check, "model " + std::to_string(k) + ", piece " + std::to_string(piece));
          guard = std::max(guard, check.guard_error);
        }
  }
  std::printf("laws of force: guards %.3f of their noise\n", guard);
  EXPECT_GE(guard, 0.05) << "the noise bound is empty";
}

/// One family k = 1 .. 52; the error must not grow along it.
TEST(WindowOperators, OfLargeSystemsWhichSumTermsInsteadOfStoringRows) {
  std::mt19937_64 random(12);
  long excluded = 0, at_once = 0;
  for (int k = 0; k < 3; ++k) {
    const Model model = random_model(random, 11 + 4 * k);
    for (const StopState stop : {StopState::open, StopState::closed}) {
      for (const FrictionState friction : {FrictionState::stick, FrictionState::slip_plus}) {
        Check check(model, {{stop}, {friction}, {}}, static_cast<std::uint64_t>(k));
        check.random_starts(2);
        expect_bounded(check, "model " + std::to_string(k));
        std::printf("%d coordinates: state error %.2f u, inside %.2f u\n", 11 + 4 * k, check.state_error,
                    check.inside_error);
        excluded += check.excluded;
        at_once += check.excluded_at_once;
      }
    }
  }
  std::printf("guards excluded: %ld, by the quick look: %ld\n", excluded, at_once);
  EXPECT_GE(at_once, excluded * 9 / 10) << "the quick look sees nothing";
}

template <class Family>
void expect_flat(const char* name, Family&& model_of) {
  double worst = 0.0, inside = 0.0, guard = 0.0;
  for (int k = 1; k <= 52; k += 3) {
    const Model model = model_of(std::ldexp(1.0, -k));
    Check check(model, free_states(model), static_cast<std::uint64_t>(k));
    check.random_starts(2);
    expect_bounded(check, std::string(name) + " k = " + std::to_string(k));
    worst = std::max(worst, check.state_error);
    inside = std::max(inside, check.inside_error);
    guard = std::max(guard, check.guard_error);
  }
  std::printf("%s: step error %.2f u, inside %.2f u, guards %.3f of their noise\n", name, worst, inside, guard);
}

TEST(WindowOperators, NearResonanceIsAsSharpAsAnythingElse) {  // K28
  expect_flat("near resonance", [](double d) { return oracle::oscillator_with_stop(1.0, 0.5, 1.0, 1.0 + d); });
}

TEST(WindowOperators, NearCriticalDampingIsAsSharpAsAnythingElse) {  // K30; d = 0: K29
  for (const double sign : {1.0, -1.0})
    expect_flat("near critical",
                [&](double d) { return oracle::oscillator_with_stop(1.0, 0.5, 0.0, 1.0, 2 * (1 + sign * d)); });
  expect_flat("critical", [](double) { return oracle::oscillator_with_stop(1.0, 0.5, 0.0, 1.0, 2.0); });
}

TEST(WindowOperators, EqualEigenvaluesOfTwoCoordinates) {  // K29
  expect_flat("equal eigenvalues", [](double d) {
    Model m = oracle::vibro_impact(1.5);
    m.springs = {{0, ground, 1.0}, {1, ground, 10.0 * (1 + d)}, {0, 1, d}};
    m.dampers.clear();
    return m;
  });
}

TEST(WindowOperators, RigidBodyNeedsNoSpecialCase) {  // K29, k = 0
  expect_flat("rigid body", [](double d) {
    Model m = oracle::ball(0.5);
    m.springs = {{0, ground, d}};
    return m;
  });
  const Model ball = oracle::ball(0.5);
  Check check(ball, free_states(ball), 1);
  check.random_starts(20);
  expect_bounded(check, "ball");
  EXPECT_LE(check.state_error, 8.0);
}

TEST(WindowOperators, StiffSystemsHaveShortWindowsAndTheSameError) {  // K31
  expect_flat("stiff spring", [](double d) {
    Model m = oracle::vibro_impact(1.5);
    m.springs[0].stiffness = std::pow(1 / d, 0.75);  // up to 5e11
    return m;
  });
  expect_flat("light mass", [](double d) {
    Model m = oracle::vibro_impact(1.5);
    m.coordinates[1].mass = std::pow(d, 0.75);
    return m;
  });
  expect_flat("overdamped", [](double d) {
    Model m = oracle::vibro_impact(1.5);
    m.dampers[0].coefficient = std::pow(1 / d, 0.4);  // up to 2e6
    return m;
  });
}

TEST(WindowOperators, ConstrainedCoordinateDoesNotMoveAtAll) {
  const Model model = oracle::vibro_impact(1.5);
  const Frame frame(model);
  const Mode stick(model, frame, {{StopState::open}, {FrictionState::stick}, {}});
  std::vector<double> X(16, 0.0);
  X[0] = -0.3, X[1] = 0.7, X[3] = -1.1;
  frame.set_clock(Instant{}.plus(0.3), X.data());
  event::Lanes out(2);
  stick.step(X.data(), out.data());
  EXPECT_EQ(out[0][0], -0.3);  // gap
  EXPECT_EQ(out[0][2], 0.0);   // relative velocity
  double at[16];
  stick.state_at(0.7, X.data(), at);
  EXPECT_EQ(at[0], -0.3);
  EXPECT_EQ(at[2], 0.0);
}

TEST(Frame, PhaseIsExactAtTheQuarterPeriodsAndLosesNothingAtLargeHarmonics) {
  Model model = oracle::cosine_ball(0.5);
  model.forces.push_back({0, 7, 1.0, 0.0});
  const Frame frame(model);
  double X[16] = {};
  const double cosine[] = {1, 0, -1, 0}, sine[] = {0, 1, 0, -1};
  for (int q = 0; q < 4; ++q) {
    frame.set_clock(Instant{}.plus(0.25 * q), X);
    EXPECT_EQ(X[2], cosine[q]);
    EXPECT_EQ(X[3], sine[q]);
    EXPECT_EQ(X[4], cosine[7 * q % 4]);
    EXPECT_EQ(X[5], sine[7 * q % 4]);
  }
  std::mt19937_64 random(3);
  for (int i = 0; i < 500; ++i) {
    const double fraction = std::uniform_real_distribution<double>(0, 1)(random);
    frame.set_clock(Instant{}.plus(fraction), X);
    const Real angle = 2 * oracle::pi() * Real(fraction);
    EXPECT_LE(abs(Real(X[2]) - cos(angle)), Real(3e-16));
    EXPECT_LE(abs(Real(X[3]) - sin(angle)), Real(3e-16));
    EXPECT_LE(abs(Real(X[5]) - sin(7 * angle)), Real(7 * 8e-16));
  }
}

}  // namespace
}  // namespace slapstick::mode
