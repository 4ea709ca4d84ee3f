/// Validates models and states, and names the numbers of a state.
#include "slapstick/model/model.hpp"

#include <algorithm>
#include <numbers>

#include "model/fault.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {

bool Model::repeats_with_forcing(const Force& force) const {
  if (force.signal >= 0) return signals[static_cast<std::size_t>(force.signal)].in_periods;
  return force.harmonic > 0;
}

bool Model::is_pressed(int friction) const {
  return std::any_of(forces.begin(), forces.end(), [&](const Force& force) { return force.presses == friction; });
}

bool Model::is_inner(int coordinate) const {
  const auto has = [&](const auto& part) { return coordinate != ground && part.inner == coordinate; };
  return std::any_of(springs.begin(), springs.end(), has) ||
         std::any_of(characteristics.begin(), characteristics.end(), has);
}

bool Model::forced() const {
  return std::any_of(forces.begin(), forces.end(), [&](const Force& force) { return repeats_with_forcing(force); });
}

bool Model::periodic() const {
  return std::all_of(forces.begin(), forces.end(), [&](const Force& force) {
    return repeats_with_forcing(force) || (force.frequency == 0.0 && force.signal < 0);
  });
}

double Model::forcing_period() const { return forced() ? 2.0 * std::numbers::pi / omega : 1.0; }

std::string velocity_name(const std::string& coordinate) {
  const bool numbered = !coordinate.empty() && coordinate.front() == 'x';
  std::string name = numbered ? "v" : "v_";
  return name.append(coordinate, numbered ? 1 : 0, std::string::npos);
}

std::vector<std::string> state_names(const Model& model) {
  std::vector<std::string> names;
  for (const auto& coordinate : model.coordinates) {
    names.push_back(coordinate.name);
    names.push_back(velocity_name(coordinate.name));
  }
  return names;
}

namespace {

/// How many corners lie at or below this speed.
std::size_t corners_below(const Stop& stop, double speed) {
  std::size_t count = 0;
  while (count < stop.corners.size() && speed >= stop.corners[count].speed) ++count;
  return count;
}

}  // namespace

double rebound_rate(const Stop& stop, const Stop& rate, double speed) {
  const std::size_t above = corners_below(stop, speed);
  if (above == 0) return rate.restitution;
  const Stop::Corner &from = stop.corners[above - 1], &change = rate.corners[above - 1];
  if (above == stop.corners.size()) return change.restitution;
  const Stop::Corner &to = stop.corners[above], &to_change = rate.corners[above];
  const double width = to.speed - from.speed, part = (speed - from.speed) / width;
  const double slope = (to.restitution - from.restitution) / width;
  return (1.0 - part) * (change.restitution - slope * change.speed) +
         part * (to_change.restitution - slope * to_change.speed);
}

Rebound rebound(const Stop& stop, double speed) {
  const auto& corners = stop.corners;
  const std::size_t above = corners_below(stop, speed);
  if (above == 0) return {stop.restitution, stop.restitution};
  const Stop::Corner& from = corners[above - 1];
  if (above == corners.size()) return {from.restitution, from.restitution};
  const Stop::Corner& to = corners[above];
  const double slope = (to.restitution - from.restitution) / (to.speed - from.speed);
  const double r = from.restitution + slope * (speed - from.speed);
  return {r, r + slope * speed};
}

void demand_period(const Model& model) {
  if (model.periodic()) return;
  const auto other = std::find_if(model.forces.begin(), model.forces.end(), [&](const Force& force) {
    return force.signal >= 0 && !model.repeats_with_forcing(force);
  });
  std::string has = "a frequency beside its forcing: its motion never repeats";
  if (other != model.forces.end()) {
    const Signal& signal = model.signals[static_cast<std::size_t>(other->signal)];
    has = "a signal, '" + signal.name + "'" +
          (signal.repeats && pulses(signal) ? ", that repeats by a period of its own: give the impulse a phase, or all "
                                              "impulses periods of which the longest is a multiple of each other one; "
                                              "else its motion never repeats"
           : signal.repeats ? ", that repeats by a period of its own: give its points in forcing periods (in_periods = "
                              "true), or its motion never repeats"
                            : ": its motion never repeats");
  }
  throw InputError("model '" + model.name + "' has " + has +
                   ", so it has no cycles and no classes; simulate, poincare, diagram, lyapunov, measure and spectrum "
                   "with --periods are for such models");
}

void validate(const Model& model) {
  if (const auto fault = first_fault(model)) throw InputError(fault->place(model) + ": " + fault->what);
}

void validate(const Model& model, const State& state) {
  if (const auto fault = first_fault(model, state)) throw InputError("state: " + fault->what);
}

}  // namespace slapstick
