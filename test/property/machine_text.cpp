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

void contacts(std::ostream& out, const Model& m) {
  for (const FrictionContact& f : m.frictions) {
    out << "[[friction]]\nname = \"" << f.name << "\"\n";
    between(out, m, f.a, f.b);
    line(out, "static", f.static_friction), line(out, "kinetic", f.kinetic_friction);
    line(out, "belt_speed", f.belt_speed);
  }
  for (const Stop& s : m.stops) {
    out << "[[stop]]\nname = \"" << s.name << "\"\n";
    between(out, m, s.a, s.b);
    line(out, "clearance", s.clearance), line(out, "restitution", s.restitution);
  }
  for (const CompliantStop& c : m.compliant_stops) {
    out << "[[compliant_stop]]\nname = \"" << c.name << "\"\n";
    between(out, m, c.a, c.b);
    line(out, "clearance", c.clearance), line(out, "stiffness", c.stiffness), line(out, "damping", c.damping);
    out << "pulls = " << (c.pulls ? "true\n" : "false\n");
  }
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
