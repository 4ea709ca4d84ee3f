/// Random oscillators: one to three masses with stops and friction, and the built-in models.
#include <array>
#include <string>

#include "scene.hpp"
#include "slapstick/io/model_file.hpp"

namespace campaign {
namespace {

using slapstick::ground;
using slapstick::Model;

/// Damping of mass 1 on a spring k: none, light, or near the critical one, down to a distance of 2^-52.
double damping(Random& random, double k) {
  const double critical = 2.0 * std::sqrt(k);
  switch (random.below(4)) {
    case 0:
      return 0.0;
    case 1:
      return critical * (1.0 + random.sign() * std::ldexp(1.0, -1 - random.below(52)));
    default:
      return critical * random.decades(-3.0, -0.3);
  }
}

/// A frequency: any, or near resonance, down to a distance of 2^-52.
double frequency(Random& random, double k) {
  if (k > 0.0 && random.one_in(4)) return std::sqrt(k) * (1.0 + random.sign() * std::ldexp(1.0, -1 - random.below(52)));
  return random.decades(-0.6, 0.6);
}

void force(Random& random, Model& model) {
  const int last = model.size() - 1;
  model.forces = {{random.below(last + 1), 1, random.decades(-1.0, 0.5), random.uniform(-3.0, 3.0)}};
  if (random.one_in(3)) model.forces.push_back({last, 3, random.decades(-1.0, 0.0), random.uniform(-3.0, 3.0)});
  if (random.one_in(3)) model.forces.push_back({0, 0, random.uniform(-1.0, 1.0), 0.0});
}

/// A chain of masses; a stop between each and the one before, or the wall.
Model chain(Random& random, int masses) {
  Model model;
  model.name = "chain of " + std::to_string(masses);
  const double k = random.one_in(10) ? 0.0 : random.decades(-0.5, 0.7);
  for (int i = 0; i < masses; ++i) {
    const std::string name = "x" + std::to_string(i + 1);
    model.coordinates.push_back({name, masses == 1 ? 1.0 : random.decades(-0.5, 0.7)});
    model.springs.push_back({i, i - 1, i == 0 ? k : random.decades(-0.5, 0.7)});
    model.dampers.push_back({i, i - 1, damping(random, k)});
    if (i == 0 || random.one_in(2))
      model.stops.push_back(
          {"stop" + std::to_string(i + 1), i, i - 1, random.uniform(-1.0, 1.5), random.uniform(0.3, 1.0)});
  }
  model.omega = frequency(random, k);
  force(random, model);
  if (random.one_in(4)) {
    const double limit = random.decades(-1.5, -0.3);
    model.frictions = {{"friction", 0, ground, random.one_in(3) ? 0.2 : 0.0, limit * random.uniform(1.0, 1.5), limit}};
  }
  return model;
}

}  // namespace

Model random_model(Random& random) {
  constexpr std::array built_in = {"vibro-impact", "impact-oscillator", "two-sided-rattle", "impact-pair"};
  const int choice = random.below(10);
  if (choice < 4) return chain(random, 1);
  if (choice < 7) return chain(random, 2);
  if (choice < 8) return chain(random, 3);
  return slapstick::load_model(built_in[random.below(built_in.size())]).build({{"omega", random.uniform(0.3, 5.0)}});
}

}  // namespace campaign
