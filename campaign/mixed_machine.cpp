/// Makes random machines of all features.
#include "mixed_machine.hpp"

#include "slapstick/base/error.hpp"

namespace campaign {
namespace {

using namespace slapstick;

struct Pair {
  int a, b;
};

/// Two bodies, or one and the ground on either side.
Pair any_pair(Random& random, int n) {
  const int a = random.below(n + 1) - 1;
  int b = random.below(n + 1) - 1;
  while (b == a) b = random.below(n + 1) - 1;
  return {a, b};
}

std::string name(const char* what, std::size_t k) { return what + std::to_string(k + 1); }

void add_springs(Model& model, Random& random) {
  for (int i = 0; i < model.size(); ++i) {
    model.springs.push_back({i, i - 1, random.decades(-0.5, 1.0)});
    if (random.one_in(2)) model.dampers.push_back({i, i - 1, random.decades(-2.0, 0.0)});
  }
}

void add_forces(Model& model, Random& random) {
  for (const int harmonic : {0, 1, 1 + random.below(3)})
    model.forces.push_back({random.below(model.size()), harmonic, random.uniform(-1.5, 1.5), random.uniform(0.0, 6.0)});
  if (random.one_in(3))
    model.forces.push_back({random.below(model.size()), 0, random.uniform(-0.7, 0.7), random.uniform(0.0, 6.0),
                            random.decades(-0.5, 0.8)});
}

void add_stops(Model& model, Random& random) {
  for (int k = random.below(4); k > 0; --k) {
    const auto [a, b] = any_pair(random, model.size());
    const double gap = random.one_in(3) ? 0.0 : random.uniform(0.0, 0.5),
                 r = random.one_in(4) ? 0.0 : random.uniform(0.2, 0.9);
    model.stops.push_back({name("stop", model.stops.size()), a, b, gap, r});
    if (random.one_in(4))
      model.stops.back().corners = {{random.uniform(0.05, 0.3), r},
                                    {random.uniform(0.4, 1.5), r * random.uniform(0.4, 1.0)}};
    if (k == 3) model.stops.push_back({name("stop", model.stops.size()), b, a, random.uniform(0.1, 0.5), r});
  }
  model.impact_law = random.one_in(3) ? ImpactLaw::sequence : ImpactLaw::moreau;
}

/// Of a state's numbers, and of a compliant stop where there is one.
NormalForce normal_force(const Model& model, Random& random) {
  NormalForce normal;
  normal.constant = random.uniform(-0.2, 1.0);
  for (int k = random.below(3); k > 0; --k)
    normal.terms.push_back({random.below(model.size()), random.uniform(-0.5, 0.5), random.uniform(-0.1, 0.1)});
  const int springs = static_cast<int>(model.compliant_stops.size());
  if (springs > 0 && random.one_in(2)) normal.compliant_stop = random.below(springs);
  return normal;
}

void add_frictions(Model& model, Random& random) {
  for (int k = random.below(4); k > 0; --k) {
    Pair pair = any_pair(random, model.size());
    if (!model.stops.empty() && random.one_in(2)) pair = {model.stops.front().a, model.stops.front().b};
    const double kinetic = random.uniform(0.0, 0.6), more = random.one_in(2) ? 1.0 : random.uniform(1.0, 1.6);
    const double belt = random.one_in(4) ? random.uniform(-0.4, 0.4) : 0.0;
    model.frictions.push_back(
        {name("friction", model.frictions.size()), pair.a, pair.b, belt, kinetic * more, kinetic});
    if (random.one_in(4)) model.frictions.back().normal = normal_force(model, random);
  }
}

void add_compliant(Model& model, Random& random) {
  for (int k = random.below(3); k > 0; --k) {
    const auto [a, b] = any_pair(random, model.size());
    const double damping = random.one_in(3) ? 0.0 : random.uniform(0.0, 1.0);
    const bool pulls = random.one_in(3), bounded = !pulls && random.one_in(2);
    model.compliant_stops.push_back({name("compliant", model.compliant_stops.size()), a, b, random.uniform(0.0, 0.5),
                                     random.decades(0.0, 1.5), damping, pulls, bounded});
  }
}

void add_polylines(Model& model, Random& random) {
  for (int k = random.below(3); k > 0; --k) {
    const auto [a, b] = any_pair(random, model.size());
    const auto over = random.one_in(3)   ? Characteristic::Over::zones
                      : random.one_in(2) ? Characteristic::Over::displacement
                                         : Characteristic::Over::velocity;
    Characteristic bent{name("polyline", model.characteristics.size()),
                        a,
                        b,
                        over,
                        {},
                        random.uniform(-0.3, 2.0),
                        random.uniform(-0.3, 2.0)};
    double at = random.uniform(-0.5, 0.0);
    for (int corners = 1 + random.below(3); corners > 0; --corners, at += random.uniform(0.1, 0.5))
      bent.corners.push_back(
          {at, over == Characteristic::Over::zones ? random.uniform(0.0, 0.5) : random.uniform(-0.3, 0.3)});
    if (over == Characteristic::Over::zones) bent.slope_below = bent.slope_above = random.uniform(0.0, 0.5);
    model.characteristics.push_back(bent);
  }
}

/// Symmetric and positive definite: diagonal entries outweigh the others.
SymmetricMatrix matrix(int n, Random& random) {
  const auto size = static_cast<std::size_t>(n);
  SymmetricMatrix entries(size * size);
  for (std::size_t i = 0; i < size; ++i) {
    entries[i * size + i] = random.uniform(0.5, 1.0);
    for (std::size_t j = 0; j < i; ++j) entries[i * size + j] = entries[j * size + i] = random.uniform(-0.1, 0.1);
  }
  return entries;
}

MixedMachine draw(Random& random) {
  MixedMachine machine;
  Model& model = machine.model;
  model.name = "mixed";
  model.omega = random.decades(-0.4, 0.6);
  for (int n = 1 + random.below(4); n > 0; --n)
    model.coordinates.push_back({name("x", model.coordinates.size()), random.decades(-0.5, 0.7)});
  add_springs(model, random);
  add_forces(model, random);
  add_stops(model, random);
  add_compliant(model, random);
  add_frictions(model, random);
  add_polylines(model, random);
  if (random.one_in(4)) {
    model.mass = matrix(model.size(), random);
    model.damping = matrix(model.size(), random);
    model.stiffness = matrix(model.size(), random);
  }
  const bool at_rest = random.one_in(4);
  for (int i = 0; i < 2 * model.size(); ++i) machine.start.push_back(at_rest ? 0.0 : random.uniform(-0.5, 0.5));
  return machine;
}

}  // namespace

MixedMachine mixed_machine(Random& random) {
  for (;;) {
    MixedMachine machine = draw(random);
    try {
      validate(machine.model);
      validate(machine.model, machine.start);
      return machine;
    } catch (const InputError&) {  // a start beyond a stop, stops without room: drawn again
    }
  }
}

}  // namespace campaign
