/// The steps by which a machine that breaks a law is made as small as it can be and still break it.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "property/machine.hpp"

namespace slapstick::test {
namespace {

/// Digits that a number needs to be written down, 0 for zero: rounder is less.
int digits(double x) {
  if (x == 0.0) return 0;
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, std::abs(x), std::chars_format::scientific);
  return static_cast<int>(std::count_if(text, std::find(text, end, 'e'), [](char c) { return c != '.'; }));
}

double rounded(double x, int to_digits) {
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(x))) + 1 - to_digits);
  return unit >= 1.0 ? std::round(x / unit) * unit : std::round(x / unit) / std::round(1.0 / unit);
}

/// All numbers of a machine but its indices.
std::vector<double*> numbers(Machine& machine) {
  Model& m = machine.model;
  std::vector<double*> all{&m.omega};
  for (double& x : machine.start) all.push_back(&x);
  for (Coordinate& c : m.coordinates) all.push_back(&c.mass);
  for (Spring& s : m.springs) all.push_back(&s.stiffness);
  for (Damper& d : m.dampers) all.push_back(&d.coefficient);
  for (Force& f : m.forces) all.insert(all.end(), {&f.amplitude, &f.phase});
  for (Stop& s : m.stops) all.insert(all.end(), {&s.clearance, &s.restitution});
  for (FrictionContact& f : m.frictions)
    all.insert(all.end(), {&f.belt_speed, &f.static_friction, &f.kinetic_friction});
  for (CompliantStop& c : m.compliant_stops) all.insert(all.end(), {&c.clearance, &c.stiffness, &c.damping});
  for (Characteristic& c : m.characteristics) {
    all.insert(all.end(), {&c.slope_below, &c.slope_above});
    for (Characteristic::Corner& corner : c.corners) all.insert(all.end(), {&corner.at, &corner.force});
  }
  for (FrictionContact& f : m.frictions) {
    if (!f.normal) continue;
    all.push_back(&f.normal->constant);
    for (NormalForce::Term& term : f.normal->terms) all.insert(all.end(), {&term.stiffness, &term.damping});
  }
  return all;
}

/// After one number of several that the shape wants equal has changed.
void agree(Machine& machine, const Shape& shape) {
  for (FrictionContact& f : machine.model.frictions)
    f.kinetic_friction = shape.one_friction ? f.static_friction : std::min(f.kinetic_friction, f.static_friction);
  for (Stop& s : machine.model.stops)
    if (!s.corners.empty()) s.restitution = s.corners.front().restitution;
  if (!shape.one_restitution) return;
  for (Stop& s : machine.model.stops) s.restitution = machine.model.stops[0].restitution;
}

/// Springs, dampers and contacts between one thing and itself are gone, the others keep their names.
template <class Part>
void without_coordinate(std::vector<Part>& parts, int gone) {
  const auto moved = [gone](int i) { return i == gone ? ground : i > gone ? i - 1 : i; };
  for (Part& p : parts) p.a = moved(p.a), p.b = moved(p.b);
  std::erase_if(parts, [](const Part& p) { return p.a == p.b; });
}

Machine without_coordinate(Machine machine, int gone) {
  Model& m = machine.model;
  m.coordinates.erase(m.coordinates.begin() + gone);
  machine.start.erase(machine.start.begin() + 2 * gone, machine.start.begin() + 2 * gone + 2);
  without_coordinate(m.springs, gone);
  without_coordinate(m.dampers, gone);
  without_coordinate(m.stops, gone);
  without_coordinate(m.frictions, gone);
  without_coordinate(m.compliant_stops, gone);
  without_coordinate(m.characteristics, gone);
  for (FrictionContact& f : m.frictions) {
    if (!f.normal) continue;
    std::erase_if(f.normal->terms, [gone](const NormalForce::Term& term) { return term.coordinate == gone; });
    for (NormalForce::Term& term : f.normal->terms) term.coordinate -= term.coordinate > gone ? 1 : 0;
  }
  for (Force& f : m.forces) f.coordinate = std::max(0, f.coordinate - (f.coordinate >= gone ? 1 : 0));
  return machine;
}

class Simpler {
 public:
  Simpler(const Machine& machine, const Shape& shape) : machine_(machine), shape_(shape) {}

  std::vector<Machine> all() {
    const Model& m = machine_.model;
    for (int i = m.size() - 1; i >= 0 && m.size() > 1; --i) offer(without_coordinate(machine_, i));
    without_each(&Model::stops);
    without_each(&Model::frictions);
    if (std::ranges::none_of(m.frictions,
                             [](const FrictionContact& f) { return f.normal && f.normal->compliant_stop >= 0; }))
      without_each(&Model::compliant_stops);
    without_each(&Model::characteristics);
    without_laws();
    without_each(&Model::dampers);
    without_each(&Model::forces);
    without_each(&Model::springs);
    rounder();
    return std::move(out_);
  }

 private:
  void offer(Machine candidate) {
    agree(candidate, shape_);
    if (is_of(shape_, candidate)) out_.push_back(std::move(candidate));
  }

  /// One contact with a simpler law.
  void without_laws() {
    for (std::size_t i = 0; i < machine_.model.frictions.size(); ++i)
      if (machine_.model.frictions[i].normal) offer_changed([i](Model& m) { m.frictions[i].normal.reset(); });
    for (std::size_t i = 0; i < machine_.model.compliant_stops.size(); ++i)
      if (machine_.model.compliant_stops[i].bounded)
        offer_changed([i](Model& m) { m.compliant_stops[i].bounded = false; });
    for (std::size_t i = 0; i < machine_.model.stops.size(); ++i)
      if (!machine_.model.stops[i].corners.empty()) offer_changed([i](Model& m) { m.stops[i].corners.clear(); });
    for (std::size_t i = 0; i < machine_.model.characteristics.size(); ++i)
      if (machine_.model.characteristics[i].corners.size() > 1)
        offer_changed([i](Model& m) { m.characteristics[i].corners.pop_back(); });
  }

  template <class Change>
  void offer_changed(Change change) {
    Machine candidate = machine_;
    change(candidate.model);
    offer(std::move(candidate));
  }

  template <class Parts>
  void without_each(Parts Model::*parts) {
    for (std::size_t i = 0; i < (machine_.model.*parts).size(); ++i) {
      Machine candidate = machine_;
      (candidate.model.*parts).erase((candidate.model.*parts).begin() + static_cast<long>(i));
      offer(std::move(candidate));
    }
  }

  void rounder() {
    Machine copy = machine_;
    const std::size_t count = numbers(copy).size();
    for (std::size_t i = 0; i < count; ++i) {
      const double x = *numbers(copy)[i];
      if (x == 0.0) continue;
      for (const double candidate : {0.0, 1.0, rounded(x, 1), rounded(x, 2), rounded(x, 4)}) {
        if (digits(candidate) >= digits(x)) continue;
        Machine simple = machine_;
        *numbers(simple)[i] = candidate;
        offer(std::move(simple));
      }
    }
  }

  const Machine& machine_;
  const Shape& shape_;
  std::vector<Machine> out_;
};

}  // namespace

std::vector<Machine> simpler(const Machine& machine, const Shape& shape) { return Simpler(machine, shape).all(); }

}  // namespace slapstick::test
