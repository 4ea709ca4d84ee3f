/// A machine as a model file.
#include <cstdio>
#include <ostream>
#include <string_view>

#include "property/machine.hpp"

namespace slapstick::test {
namespace {

/// name = number, ... to the last bit.
void line(std::ostream& out, const char* name, double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  const bool whole = std::string_view(text).find_first_of(".e") == std::string_view::npos;
  out << name << " = " << text << (whole ? ".0\n" : "\n");
}

void between(std::ostream& out, const Model& m, int a, int b) {
  const auto name = [&](int i) { return i == ground ? "ground" : m.coordinates[i].name.c_str(); };
  out << "between = [\"" << name(a) << "\", \"" << name(b) << "\"]\n";
}

void point(std::ostream& out, double x, double y) {
  char text[80];
  std::snprintf(text, sizeof text, "[%.17g, %.17g], ", x, y);
  out << text;
}

void normal_force(std::ostream& out, const Model& m, const NormalForce& normal) {
  const auto names = state_names(m);
  char text[80];
  std::snprintf(text, sizeof text, "normal_force = { constant = %.17g", normal.constant);
  out << text;
  for (const NormalForce::Term& term : normal.terms) {
    const auto at = 2 * static_cast<std::size_t>(term.coordinate);
    std::snprintf(text, sizeof text, ", %s = %.17g, %s = %.17g", names[at].c_str(), term.stiffness,
                  names[at + 1].c_str(), term.damping);
    out << text;
  }
  if (normal.compliant_stop >= 0)
    out << ", compliant_stop = \"" << m.compliant_stops[normal.compliant_stop].name << '"';
  out << " }\n";
}

/// Zones of more than one edge are not in a file: their numbers are there as a comment.
void characteristic(std::ostream& out, const Model& m, const Characteristic& c) {
  const bool zones = c.over == Characteristic::Over::zones;
  out << (c.over == Characteristic::Over::displacement ? "[[spring]]\n" : "[[damper]]\n") << "name = \"" << c.name
      << "\"\n";
  between(out, m, c.a, c.b);
  out << (zones ? "#zones = [" : "characteristic = [");
  for (const Characteristic::Corner& corner : c.corners) point(out, corner.at, corner.force);
  out << "]\n";
  line(out, "slope_below", c.slope_below), line(out, "slope_above", c.slope_above);
}

void contacts(std::ostream& out, const Model& m) {
  for (const FrictionContact& f : m.frictions) {
    out << "[[friction]]\nname = \"" << f.name << "\"\n";
    between(out, m, f.a, f.b);
    line(out, "static", f.static_friction), line(out, "kinetic", f.kinetic_friction);
    line(out, "belt_speed", f.belt_speed);
    if (f.normal) normal_force(out, m, *f.normal);
  }
  for (const Stop& s : m.stops) {
    out << "[[stop]]\nname = \"" << s.name << "\"\n";
    between(out, m, s.a, s.b);
    line(out, "clearance", s.clearance);
    if (s.corners.empty()) {
      line(out, "restitution", s.restitution);
      continue;
    }
    out << "restitution_over_speed = [";
    for (const Stop::Corner& corner : s.corners) point(out, corner.speed, corner.restitution);
    out << "]\n";
  }
  for (const CompliantStop& c : m.compliant_stops) {
    out << "[[compliant_stop]]\nname = \"" << c.name << "\"\n";
    between(out, m, c.a, c.b);
    line(out, "clearance", c.clearance), line(out, "stiffness", c.stiffness), line(out, "damping", c.damping);
    out << "law = " << (c.pulls ? "\"pulls\"\n" : c.bounded ? "\"bounded\"\n" : "\"lets_go\"\n");
  }
  for (const Characteristic& c : m.characteristics) characteristic(out, m, c);
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const Machine& machine) {
  const Model& m = machine.model;
  out << "# seed " << machine.seed << "\nname = \"" << m.name << "\"\n";
  line(out, "omega", m.omega);
  out << "impact_law = " << (m.impact_law == ImpactLaw::moreau ? "\"moreau\"" : "\"sequence\"") << "\n[start]\n";
  const auto names = state_names(m);
  for (std::size_t i = 0; i < names.size(); ++i) line(out, names[i].c_str(), machine.start[i]);
  for (const Coordinate& c : m.coordinates) {
    out << "[[coordinate]]\nname = \"" << c.name << "\"\n";
    line(out, "mass", c.mass);
  }
  for (const Spring& s : m.springs) {
    out << "[[spring]]\n";
    between(out, m, s.a, s.b), line(out, "stiffness", s.stiffness);
  }
  for (const Damper& d : m.dampers) {
    out << "[[damper]]\n";
    between(out, m, d.a, d.b), line(out, "coefficient", d.coefficient);
  }
  for (const Force& f : m.forces) {
    out << "[[force]]\non = \"" << m.coordinates[f.coordinate].name << "\"\nharmonic = " << f.harmonic << '\n';
    line(out, "amplitude", f.amplitude), line(out, "phase", f.phase);
  }
  contacts(out, m);
  return out;
}

}  // namespace slapstick::test
