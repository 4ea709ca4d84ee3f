/// Sums the powers of a cycle.
#include "slapstick/quantity/cycle_energy.hpp"

#include "orbit/equations.hpp"
#include "slapstick/quantity/measure.hpp"

namespace slapstick {

double CycleEnergy::balance() const {
  double rest = input - damping;
  for (double lost : friction) rest -= lost;
  for (double lost : impacts) rest -= lost;
  return rest;
}

std::vector<std::string> friction_names(const Model& model) {
  std::vector<std::string> names;
  for (const FrictionContact& contact : model.frictions) names.push_back(contact.name);
  for (const Characteristic& one_of : model.characteristics)
    if (one_of.inner >= 0) names.push_back(one_of.name);
  return names;
}

CycleEnergy cycle_energy(const orbit::Problem& problem, const orbit::Orbit& orbit) {
  const Model& model = problem.base().model();
  const std::size_t stops = model.stops.size(), frictions = model.frictions.size(),
                    contacts = stops + frictions + model.compliant_stops.size() + model.characteristics.size();
  std::vector<Quantity> powers(2 + contacts);
  powers[0].kind = Quantity::Kind::input;
  powers[1].kind = Quantity::Kind::damping;
  for (std::size_t i = 0; i < contacts; ++i) {
    powers[2 + i].kind = Quantity::Kind::power;
    powers[2 + i].index = static_cast<int>(i);
  }
  const Measured found = measure(problem, orbit, powers);
  const auto integral = [&](std::size_t k) { return found.of[k].mean * found.duration; };
  CycleEnergy total{integral(0), integral(1), {}, {}};
  const std::size_t first_bend = contacts - model.characteristics.size();
  const auto slides = [&](std::size_t i) {
    return i >= first_bend && model.characteristics[i - first_bend].inner >= 0;
  };
  for (std::size_t i = 0; i < contacts; ++i) {
    const double lost = integral(2 + i);
    if (i < stops)
      total.impacts.push_back(lost);
    else if (i < stops + frictions || slides(i))
      total.friction.push_back(lost);
    else
      total.damping += lost;
  }
  return total;
}

}  // namespace slapstick
