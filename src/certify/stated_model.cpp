/// Writes the head of a certificate.
///
/// Every part is taken apart into all of its members: a member that the model format gains does not compile here until
/// certificates say it, or refuse it.
#include "certify/stated_model.hpp"

#include <array>
#include <cstdio>

#include "base/text.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::certify {

std::string hex(double x) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), " %a", x);
  return text.data();
}

std::string number(long long k) { return " " + std::to_string(k); }

namespace {

std::string line(const std::string& text) { return text + "\n"; }

/// A name as the last words of a record: for people, and judged by nobody.
std::string called(std::string name) {
  for (char& c : name)
    if (!(c > ' ' && c <= '~')) c = '_';
  return " " + (name.empty() ? "_" : name);
}

std::string stated(const Spring& spring) {
  const auto& [a, b, stiffness] = spring;
  return line("spring" + number(a) + number(b) + hex(stiffness));
}

std::string stated(const Damper& damper) {
  const auto& [a, b, coefficient, feeds] = damper;
  return line("damper" + number(a) + number(b) + hex(coefficient));
}

std::string stated(const Force& force) {
  const auto& [coordinate, harmonic, amplitude, phase, frequency, signal, rate] = force;
  return line("force" + number(coordinate) + number(harmonic) + hex(amplitude) + hex(phase));
}

std::string stated(const Stop& stop) {
  const auto& [name, a, b, clearance, restitution, corners] = stop;
  return line("stop" + number(a) + number(b) + hex(clearance) + hex(restitution) + called(name));
}

std::string stated(const FrictionContact& friction) {
  const auto& [name, a, b, belt_speed, static_friction, kinetic_friction, normal] = friction;
  return line("friction" + number(a) + number(b) + hex(belt_speed) + hex(static_friction) + hex(kinetic_friction) +
              called(name));
}

std::string stated(const CompliantStop& stop) {
  const auto& [name, a, b, clearance, stiffness, damping, pulls, bounded] = stop;
  return line("compliant" + number(a) + number(b) + hex(clearance) + hex(stiffness) + hex(damping) +
              number(pulls ? 1 : 0) + called(name));
}

std::string stated(const Characteristic& bent) {
  const auto& [name, a, b, over, corners, slope_below, slope_above] = bent;
  std::string text = "polyline" + number(a) + number(b);
  text += over == Characteristic::Over::displacement ? " displacement" : " velocity";
  text += hex(slope_below) + hex(slope_above) + number(static_cast<long>(corners.size()));
  for (const auto& [at, force] : corners) text += hex(at) + hex(force);
  return line(text + called(name));
}

}  // namespace

std::string not_stated(const Model& model) {
  for (const Characteristic& bent : model.characteristics)
    if (bent.over == Characteristic::Over::zones) return "dampers that act in an interval (" + in_quotes(bent.name) + ")";
  for (const FrictionContact& contact : model.frictions)
    if (contact.normal) return "friction whose normal force depends on the state (" + in_quotes(contact.name) + ")";
  for (const CompliantStop& stop : model.compliant_stops)
    if (stop.bounded) return "compliant stops with a bounded damping force (" + in_quotes(stop.name) + ")";
  for (const Stop& stop : model.stops)
    if (!stop.corners.empty()) return "restitution that depends on the impact speed (" + in_quotes(stop.name) + ")";
  for (const Force& force : model.forces) {
    if (force.frequency != 0.0) return "forces with a frequency of their own";
    if (force.signal >= 0) return "signals (" + in_quotes(model.signals[static_cast<std::size_t>(force.signal)].name) + ")";
  }
  return "";
}

namespace {

template <class Part>
std::string all(const std::vector<Part>& parts) {
  std::string text;
  for (const Part& part : parts) text += stated(part);
  return text;
}

std::string matrix(const char* word, const SymmetricMatrix& entries, int n) {
  std::string text;
  for (int i = 0; i < n && !entries.empty(); ++i) {
    text += word + number(i);
    for (int j = 0; j < n; ++j) text += hex(entries[static_cast<std::size_t>(i) * static_cast<std::size_t>(n) + static_cast<std::size_t>(j)]);
    text += "\n";
  }
  return text;
}

/// The pair of a row of W: 1 at a, -1 at b.
std::string pair_of(const mode::Frame& frame, int i) {
  int a = ground, b = ground;
  for (int j = 0; j < frame.n; ++j) {
    if (frame.W(i, j) > 0.0) a = j;
    if (frame.W(i, j) < 0.0) b = j;
  }
  return number(a) + number(b);
}

}  // namespace

std::string stated_model(const flow::CompiledSystem& system) {
  if (const std::string what = not_stated(system.model()); !what.empty())
    throw InputError("model " + in_quotes(system.model().name) + ": certificates do not hold " + what + " yet");
  const auto& [name, coordinates, springs, dampers, forces, frictions, stops, compliant_stops, characteristics, signals,
               mass, damping, stiffness, impact_law, omega] = system.model();
  const mode::Frame& frame = system.frame();
  std::string text = line("slapstick-certificate 2") + line("model" + called(name)) + line("size" + number(frame.n));
  text += line("omega" + hex(omega));
  text += line(std::string("law ") + (impact_law == ImpactLaw::sequence ? "sequence" : "moreau"));
  int k = 0;
  for (const auto& [coordinate, own_mass] : coordinates)
    text += line("coordinate" + number(k++) + hex(own_mass) + called(coordinate));
  text += matrix("mass", mass, frame.n) + matrix("damping", damping, frame.n) + matrix("stiffness", stiffness, frame.n);
  text += all(springs) + all(dampers) + all(forces) + all(stops) + all(frictions) + all(compliant_stops);
  text += all(characteristics);
  for (int i = 0; i < frame.d; ++i)
    text += line("number" + pair_of(frame, i) + hex(frame.shift[i]) + hex(frame.drift[i]));
  return text;
}

std::string stated_contacts(const mode::ContactStates& states) {
  std::string text;
  for (const mode::StopState stop : states.stops) text += stop == mode::StopState::closed ? " closed" : " open";
  for (const mode::FrictionState friction : states.frictions)
    text += friction == mode::FrictionState::stick        ? " stick"
            : friction == mode::FrictionState::slip_plus ? " slip+"
                                                         : " slip-";
  for (const mode::CompliantState stop : states.compliant)
    text += stop == mode::CompliantState::off ? " off" : stop == mode::CompliantState::on ? " on" : " detached";
  for (const int piece : states.pieces) text += number(piece);
  return text;
}

}  // namespace slapstick::certify
