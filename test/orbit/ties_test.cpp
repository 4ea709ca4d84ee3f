/// Several events at one instant. Two equal machines side by side, begun alike, meet all their events in pairs: every
/// answer about the pair is that about one machine, twice.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <ostream>

#include "followed.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/quantity/cycle_energy.hpp"
#include "slapstick/quantity/measure.hpp"

namespace slapstick::test {
namespace {

int moved(int body, int by) { return body == ground ? ground : body + by; }

/// The parts of a list again, behind it, on the second machine.
template <class Part>
void twice(std::vector<Part>& parts, int by) {
  const std::size_t count = parts.size();
  for (std::size_t i = 0; i < count; ++i) {
    Part copy = parts[i];
    if (!copy.name.empty()) copy.name += "_2";
    copy.a = moved(copy.a, by);
    copy.b = moved(copy.b, by);
    parts.push_back(std::move(copy));
  }
}

/// A machine and its copy beside it, which do not touch. Of a derivative of a model too.
Model twins(Model model) {
  const auto n = static_cast<int>(model.coordinates.size());
  const auto compliant = static_cast<int>(model.compliant_stops.size());
  const std::size_t frictions = model.frictions.size(), forces = model.forces.size();
  for (int i = 0; i < n; ++i) {
    model.coordinates.push_back(model.coordinates[static_cast<std::size_t>(i)]);
    model.coordinates.back().name += "_2";
  }
  twice(model.springs, n);
  twice(model.dampers, n);
  twice(model.frictions, n);
  twice(model.stops, n);
  twice(model.compliant_stops, n);
  twice(model.characteristics, n);
  for (std::size_t i = 0; i < forces; ++i) {
    model.forces.push_back(model.forces[i]);
    model.forces.back().coordinate += n;
  }
  for (std::size_t i = frictions; i < model.frictions.size(); ++i) {
    if (!model.frictions[i].normal) continue;
    NormalForce& normal = *model.frictions[i].normal;
    for (auto& term : normal.terms) term.coordinate += n;
    if (normal.compliant_stop >= 0) normal.compliant_stop += compliant;
  }
  return model;
}

Family twins(const Family& one) {
  return {one.names, [one](const std::vector<double>& values) { return twins(one.model(values)); },
          [one](const std::vector<double>& values, std::size_t which) { return twins(one.rate(values, which)); }};
}

State twins(const State& one) {
  State both = one;
  both.insert(both.end(), one.begin(), one.end());
  return both;
}

struct Machine {
  std::string file;
  Overrides at;
  std::string parameter;
};

void PrintTo(const Machine& machine, std::ostream* out) { *out << machine.file; }

class Ties : public ::testing::TestWithParam<Machine> {
 protected:
  Ties()
      : one_(GetParam().file, GetParam().at, {GetParam().parameter}, {present()}),
        family_(twins(one_.family)),
        system_(twins(one_.system.model())),
        problem_(orbit::pose(family_, one_.values)),
        single_(one_.settled()),
        both_(orbit::settle(*problem_, system_, twins(one_.start()), {.transient = 500}).orbit) {}

  static double present() {
    const ModelDefinition definition = load_model(GetParam().file);
    for (const auto& [name, value] : definition.values(GetParam().at))
      if (name == GetParam().parameter) return value;
    throw std::logic_error("no such parameter");
  }
  [[nodiscard]] Measured measured(const orbit::Problem& problem, const Model& model, const orbit::Orbit& orbit,
                                  const std::vector<std::string>& names, bool rates) const {
    std::vector<Quantity> of;
    for (const std::string& name : names) of.push_back(find_quantity(quantities(model), name));
    return rates ? measure_rates(problem, orbit, of).at(0) : measure(problem, orbit, of);
  }

  Posed one_;
  Family family_;
  System system_;
  std::shared_ptr<const orbit::Problem> problem_;
  std::optional<orbit::Solution> single_, both_;
};

TEST_P(Ties, MultipliersAreThoseOfOneMachineTwice) {
  ASSERT_TRUE(single_);
  ASSERT_TRUE(both_);
  ASSERT_EQ(both_->multipliers.size(), 2 * single_->multipliers.size());
  std::vector<std::complex<double>> left = both_->multipliers;
  for (int copy = 0; copy < 2; ++copy)
    for (const std::complex<double> mu : single_->multipliers) {
      const auto nearest = std::min_element(left.begin(), left.end(),
                                            [&](auto a, auto b) { return std::abs(a - mu) < std::abs(b - mu); });
      EXPECT_LT(std::abs(*nearest - mu), 1e-7) << mu;  // a double multiplier is known to half the digits
      left.erase(nearest);
    }
  EXPECT_EQ(both_->stable(), single_->stable());
}

TEST_P(Ties, RowsImpactsAndEnergiesAreDoubled) {
  ASSERT_TRUE(single_);
  ASSERT_TRUE(both_);
  EXPECT_TRUE(both_->is_motion) << both_->why;
  EXPECT_EQ(both_->impacts, 2 * single_->impacts);
  EXPECT_EQ(both_->sticks, 2 * single_->sticks);
  EXPECT_EQ(both_->reversals, 2 * single_->reversals);
  const auto rows = orbit::events(*one_.problem, single_->orbit), pairs = orbit::events(*problem_, both_->orbit);
  ASSERT_EQ(pairs.size(), 2 * rows.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(pairs[i].kind, rows[i / 2].kind);
    EXPECT_NEAR(pairs[i].t, pairs[i - i % 2].t, 1e-13);  // each leg has its own equation
    EXPECT_TRUE(i % 2 == 0 || pairs[i].contact != pairs[i - 1].contact) << i;
    EXPECT_NEAR(pairs[i].w, rows[i / 2].w, 1e-9);
  }
  const CycleEnergy single = cycle_energy(*one_.problem, single_->orbit), both = cycle_energy(*problem_, both_->orbit);
  const double size = 1e-11 * std::abs(single.input);
  EXPECT_NEAR(both.input, 2.0 * single.input, size);
  EXPECT_NEAR(both.damping, 2.0 * single.damping, size);
  EXPECT_NEAR(both.balance(), 0.0, size);
  for (std::size_t i = 0; i < both.impacts.size(); ++i)
    EXPECT_NEAR(both.impacts[i], single.impacts[i % single.impacts.size()], size);
  for (std::size_t i = 0; i < both.friction.size(); ++i)
    EXPECT_NEAR(both.friction[i], single.friction[i % single.friction.size()], size);
}

TEST_P(Ties, SensitivitiesAreThoseOfOneMachine) {
  ASSERT_TRUE(single_);
  ASSERT_TRUE(both_);
  const std::string x = one_.system.model().coordinates[0].name;
  const std::string v = find_quantity(quantities(one_.system.model()), x == "x" ? "v" : "v" + x.substr(1)).name;
  const Measured single = measured(*one_.problem, one_.system.model(), single_->orbit, {x, v, "kinetic_energy"}, true);
  const Measured both = measured(*problem_, system_.model(), both_->orbit, {x, v, "kinetic_energy"}, true);
  for (std::size_t k = 0; k < 3; ++k) {
    const double times = k == 2 ? 2.0 : 1.0, size = std::abs(single.of[k].mean) + std::abs(single.of[k].rms) + 1e-9;
    EXPECT_NEAR(both.of[k].mean, times * single.of[k].mean, 1e-7 * size) << k;
    if (k < 2) {
      EXPECT_NEAR(both.of[k].rms, single.of[k].rms, 1e-7 * size) << k;
    }
  }
}

TEST_P(Ties, ClassifyAgrees) {
  ASSERT_TRUE(single_);
  ASSERT_TRUE(both_);
  const Classification seen = classify(system_, twins(one_.start()));
  EXPECT_EQ(seen.label, both_->label);
  ASSERT_FALSE(seen.multipliers.empty());
  EXPECT_NEAR(std::abs(seen.multipliers.front()), std::abs(both_->multipliers.front()), 1e-6);
}

std::string models(const std::string& file) { return SLAPSTICK_ORBIT_MODELS + file; }

INSTANTIATE_TEST_SUITE_P(Machines, Ties,
                         ::testing::Values(Machine{"impact-oscillator", {{"omega", 2.2}}, "omega"},  // impacts
                                           Machine{"vibro-impact", {{"omega", 2.2}}, "omega"},       // and reversals
                                           Machine{"vibro-impact", {{"omega", 1.5}}, "omega"},       // stick, releases
                                           Machine{"vibro-impact", {{"omega", 0.552}}, "omega"},     // complete chatter
                                           Machine{"bilinear-oscillator", {}, "omega"},              // compliant stops
                                           Machine{"coulomb-oscillator", {}, "omega"},               // stick
                                           Machine{"two-sided-rattle", {}, "omega"},                 // both sides
                                           Machine{models("pressed-pair.toml"), {}, "omega"},        // loads
                                           Machine{models("every-stop.toml"), {}, "omega"}),         // zones, bounds
                         [](const auto& info) {
                           std::string name = info.param.file.substr(info.param.file.rfind('/') + 1);
                           std::erase_if(name, [](char c) { return c == '-' || c == '.'; });
                           for (const auto& [key, value] : info.param.at)
                             name += std::to_string(static_cast<int>(10 * value));
                           return name;
                         });

/// Two balls hit one table at once, and the table moves: which comes first matters, so that no derivative exists.
TEST(TiesOfCoupledContacts, HaveNoDerivative) {
  Model model;
  model.coordinates = {{"table", 5.0}, {"x", 1.0}, {"y", 1.0}};
  model.springs = {{0, ground, 40.0}};
  model.dampers = {{0, ground, 4.0}};
  model.forces = {{0, 1, 60.0, 0.0}, {1, 0, -9.81, 0.0}, {2, 0, -9.81, 0.0}};
  model.stops = {{"a", 0, 1, 0.0, 0.2}, {"b", 0, 2, 0.0, 0.2}};
  model.omega = 5.0;
  const System system(model);
  const auto problem = orbit::pose(constant_family(model), {});
  const orbit::Settled found = orbit::settle(*problem, system, {0.0, 0.0, 0.5, 0.0, 0.5, 0.0}, {.transient = 500});
  ASSERT_TRUE(found.orbit);
  ASSERT_GT(found.orbit->impacts, 0);
  EXPECT_FALSE(orbit::differentiable(found.orbit->orbit.shape));
  EXPECT_TRUE(found.orbit->multipliers.empty());
  EXPECT_FALSE(found.orbit->stable());
}

/// The same parts for each of some bodies.
ModelDefinition copies(int bodies, const std::string& head, const std::string& parts) {
  std::string text = "name = 'm'\n" + head + "\n";
  for (int i = 1; i <= bodies; ++i)
    for (const char c : parts) text += c == '#' ? std::to_string(i) : std::string(1, c);
  return ModelDefinition::parse(text, "m.toml");
}

const std::string belt =
    "[[coordinate]]\nname = 'x#'\nmass = 1\n[[force]]\non = 'x#'\namplitude = 1\n"
    "[[force]]\non = 'x#'\namplitude = 0.7297\nharmonic = 0\n"
    "[[stop]]\nname = 'wall#'\nbetween = ['x#', 'ground']\nclearance = 0\nrestitution = 0.226\n"
    "[[friction]]\nname = 'pad#'\nbetween = ['x#', 'ground']\nstatic = 0.06\nbelt_speed = 3\n";
const std::string over_speed =
    "[[coordinate]]\nname = 'x#'\nmass = 1.432\n[[force]]\non = 'x#'\namplitude = 1.223\n"
    "[[spring]]\nbetween = ['x#', 'ground']\nstiffness = 0.093\n"
    "[[stop]]\nname = 'wall#'\nbetween = ['x#', 'ground']\nclearance = 0.371\nrestitution = 0.4\n"
    "[[friction]]\nname = 'pad#'\nbetween = ['x#', 'ground']\nstatic = 0.285\n"
    "characteristic = [[0, 0.2565], [0.5, 0.1425], [2, 0.1995]]\n";

/// Slow impacts make much of the rounding of a belt's speed, and an impact turns the piece of its own pad's friction.
TEST(TiesOfUncoupledContacts, HaveTheMultipliersOfOne) {
  for (const auto& [head, parts] : {std::pair{"omega = 2.654", belt}, {"omega = 1.623", over_speed}}) {
    const auto seen = [&](int bodies) {
      const auto definition = copies(bodies, head, parts);
      return classify(System(definition.build()), definition.start(), {.transient_periods = 60});
    };
    const Classification one = seen(1), two = seen(2);
    ASSERT_FALSE(one.multipliers.empty()) << head;
    ASSERT_EQ(two.multipliers.size(), 2 * one.multipliers.size()) << head;
    EXPECT_NEAR(std::abs(two.multipliers.front()), std::abs(one.multipliers.front()), 1e-9) << head;
  }
}

/// How many impacts come before the sum of a chatter is rounding, and so is which of two comes to rest first.
TEST(TiesOfUncoupledContacts, OrbitOfALongChatterIsFound) {
  const auto found = [](int bodies) {
    const auto definition =
        copies(bodies, "omega = 2.004",
               "[[coordinate]]\nname = 'x#'\nmass = 1.653\n[[force]]\non = 'x#'\namplitude = 0.956\n"
               "[[force]]\non = 'x#'\namplitude = 0.60228\nharmonic = 0\n"
               "[[stop]]\nname = 'wall#'\nbetween = ['x#', 'ground']\nclearance = 0.366\nrestitution = 0.6\n");
    return settled(definition, {});
  };
  const auto one = found(1), two = found(2);
  ASSERT_TRUE(one);
  ASSERT_TRUE(two);
  EXPECT_EQ(one->label, "4-inf-II");
  EXPECT_EQ(two->label, one->label);
  EXPECT_TRUE(two->is_motion) << two->why;
}

}  // namespace
}  // namespace slapstick::test
