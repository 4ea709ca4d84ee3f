/// Writes the head of a certificate.
///
/// Every part is taken apart into all of its members: a member that the model format gains does not compile here until
/// certificates say it, or refuse it.
#include "certify/stated_model.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "base/text.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/certify/certificate.hpp"

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
  // Name and motion are for tables, ratios and inner coordinates are refused.
  const auto& [a, b, stiffness, name, motion, ratio, inner] = spring;
  return line("spring" + number(a) + number(b) + hex(stiffness));
}

std::string stated(const Damper& damper) {
  const auto& [a, b, coefficient, feeds, name, motion, ratio] = damper;  // likewise
  return line("damper" + number(a) + number(b) + hex(coefficient));
}

std::string stated(const Force& force) {
  // A part of a contact's force moves what it acts on as any force does.
  const auto& [coordinate, harmonic, amplitude, phase, frequency, signal, rate, presses, contact] = force;
  if (frequency != 0.0) return line("tone" + number(coordinate) + hex(frequency) + hex(amplitude) + hex(phase));
  return line("force" + number(coordinate) + number(harmonic) + hex(amplitude) + hex(phase));
}

std::string stated(const Stop& stop) {
  const auto& [name, a, b, clearance, restitution, corners, ratio] = stop;
  std::string text = "stop" + number(a) + number(b) + hex(clearance) + hex(restitution);
  text += number(static_cast<long>(corners.size()));
  for (const auto& [speed, there] : corners) text += hex(speed) + hex(there);
  return line(text + called(name));
}

std::string stated(const FrictionContact& friction) {
  const auto& [name, a, b, belt_speed, static_friction, kinetic_friction, normal, ratio] = friction;
  return line("friction" + number(a) + number(b) + hex(belt_speed) + hex(static_friction) + hex(kinetic_friction) +
              called(name));
}

std::string stated(int friction, const NormalForce& normal) {
  const auto& [constant, terms, compliant_stop] = normal;
  std::string text = "normal" + number(friction) + hex(constant) + number(compliant_stop);
  text += number(static_cast<long>(terms.size()));
  for (const auto& [coordinate, stiffness, damping] : terms) text += number(coordinate) + hex(stiffness) + hex(damping);
  return line(text);
}

std::string stated(const CompliantStop& stop) {
  const auto& [name, a, b, clearance, stiffness, damping, pulls, bounded, ratio] = stop;
  return line("compliant" + number(a) + number(b) + hex(clearance) + hex(stiffness) + hex(damping) +
              number(pulls     ? 1
                     : bounded ? 2
                               : 0) +
              called(name));
}

std::string stated(const Characteristic& bent) {
  const auto& [name, a, b, over, corners, slope_below, slope_above, ratio, inner] = bent;
  std::string text = "polyline" + number(a) + number(b);
  text += over == Characteristic::Over::displacement ? " displacement"
          : over == Characteristic::Over::velocity   ? " velocity"
                                                     : " zones";
  text += hex(slope_below) + hex(slope_above) + number(static_cast<long>(corners.size()));
  for (const auto& [at, force] : corners) text += hex(at) + hex(force);
  return line(text + called(name));
}

}  // namespace

/// The limits of the verifier's reader.
std::string not_stated(const Model& model) {
  constexpr int most_coordinates = 400, most_harmonic = 1'000'000;
  constexpr std::size_t most_corners = 1000;
  if (model.size() > most_coordinates) return "more than 400 coordinates";
  const auto multiplied = [](const auto& links) {  // also by -1
    return std::any_of(links.begin(), links.end(), [](const auto& link) { return link.ratio != Ratio{}; });
  };
  if (multiplied(model.springs) || multiplied(model.dampers) || multiplied(model.frictions) ||
      multiplied(model.stops) || multiplied(model.compliant_stops) || multiplied(model.characteristics))
    return "ratios";
  for (const Spring& spring : model.springs)
    if (spring.inner >= 0) return "Maxwell elements (" + in_quotes(spring.name) + ")";
  for (const Force& force : model.forces)
    if (force.harmonic > most_harmonic) return "forces of a harmonic beyond 1000000";
  for (const Characteristic& bent : model.characteristics)
    if (bent.inner >= 0) return "Jenkins elements (" + in_quotes(bent.name) + ")";
  for (const Characteristic& bent : model.characteristics)
    if (bent.corners.size() > most_corners) return "more than 1000 corners (" + in_quotes(bent.name) + ")";
  for (const Stop& stop : model.stops)
    if (stop.corners.size() > most_corners) return "more than 1000 corners (" + in_quotes(stop.name) + ")";
  for (const FrictionContact& contact : model.frictions)
    if (contact.normal && contact.normal->terms.size() > most_corners)
      return "a normal force of more than 1000 terms (" + in_quotes(contact.name) + ")";
  for (const Force& force : model.forces) {
    if (force.presses >= 0)
      return "forces that press a friction contact (" +
             in_quotes(model.frictions[static_cast<std::size_t>(force.presses)].name) + ")";
    if (force.signal >= 0)
      return "signals and impulses (" + in_quotes(model.signals[static_cast<std::size_t>(force.signal)].name) + ")";
  }
  return "";
}

void demand_stated(const Model& model) {
  if (const std::string what = not_stated(model); !what.empty())
    throw InputError("model " + in_quotes(model.name) + ": certificates do not hold " + what);
}

namespace {

template <class Part>
std::string all(const std::vector<Part>& parts) {
  std::string text;
  for (const Part& part : parts) text += stated(part);
  return text;
}

/// Tones behind the forces of harmonics.
std::string all_forces(std::vector<Force> forces) {
  std::stable_partition(forces.begin(), forces.end(), [](const Force& force) { return force.frequency == 0.0; });
  return all(forces);
}

std::string matrix(const char* word, const SymmetricMatrix& entries, int n) {
  std::string text;
  for (int i = 0; i < n && !entries.empty(); ++i) {
    text += word + number(i);
    for (int j = 0; j < n; ++j)
      text += hex(entries[static_cast<std::size_t>(i) * static_cast<std::size_t>(n) + static_cast<std::size_t>(j)]);
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
  demand_stated(system.model());
  const auto& [name, coordinates, springs, dampers, forces, frictions, stops, compliant_stops, characteristics, signals,
               mass, damping, stiffness, impact_law, omega, numbered_by] = system.model();
  (void)numbered_by;  // the numbers themselves are stated
  const mode::Frame& frame = system.frame();
  std::string text = line("slapstick-certificate 3") + line("model" + called(name)) + line("size" + number(frame.n));
  text += line("omega" + hex(omega));
  text += line(std::string("law ") + (impact_law == ImpactLaw::sequence ? "sequence" : "moreau"));
  int k = 0;
  for (const auto& [coordinate, own_mass] : coordinates)
    text += line("coordinate" + number(k++) + hex(own_mass) + called(coordinate));
  text += matrix("mass", mass, frame.n) + matrix("damping", damping, frame.n) + matrix("stiffness", stiffness, frame.n);
  text += all(springs) + all(dampers) + all_forces(forces) + all(stops) + all(frictions) + all(compliant_stops);
  int friction = 0;
  for (const FrictionContact& contact : frictions) {
    if (contact.normal) text += stated(friction, *contact.normal);
    ++friction;
  }
  text += all(characteristics);
  for (int i = 0; i < frame.d; ++i)
    text += line("number" + pair_of(frame, i) + hex(frame.shift[i]) + hex(frame.drift[i]));
  return text;
}

std::string stated_contacts(const mode::ContactStates& states) {
  std::string text;
  for (const mode::StopState stop : states.stops) text += stop == mode::StopState::closed ? " closed" : " open";
  for (const mode::FrictionState friction : states.frictions)
    text += friction == mode::FrictionState::stick       ? " stick"
            : friction == mode::FrictionState::slip_plus ? " slip+"
            : friction == mode::FrictionState::unloaded  ? " unloaded"
                                                         : " slip-";
  for (const mode::CompliantState stop : states.compliant)
    text += stop == mode::CompliantState::off        ? " off"
            : stop == mode::CompliantState::on       ? " on"
            : stop == mode::CompliantState::detached ? " detached"
                                                     : " bounded";
  for (const int piece : states.pieces) text += number(piece);
  return text;
}

}  // namespace slapstick::certify
