#include "neutral/file.hpp"

#include <algorithm>

#include "base/decimal.hpp"

namespace slapstick::neutral {
namespace {

using Visit = std::function<void(Scalar&, Dimension)>;

/// Dimensions of a field by kind and key; a key that is not here is a pure number.
Dimension dimension(const std::string& kind, const std::string& key, bool loaded) {
  if (key == "mass") return dim::mass;
  if (key == "stiffness" || key == "unloading_stiffness") return dim::stiffness;
  if (key == "slope_below" || key == "slope_above") return kind == "spring" ? dim::stiffness : dim::damping;
  if (key == "coefficient" || key == "coefficient_outside" || key == "damping") return dim::damping;
  if (key == "clearance" || key == "clearance_lower") return dim::length;
  if (key == "belt_speed") return dim::speed;
  if (key == "frequency") return dim::rate;
  if (key == "momentum") return dim::impulse;
  if (key == "time" || key == "period") return dim::time;
  if (key == "amplitude") return kind == "force" ? dim::force : dim::length;
  if (key == "holds" || key == "drag" || key == "limit") return dim::force;
  if (key == "static" || key == "kinetic") return loaded ? dim::pure : dim::force;
  return dim::pure;
}

/// What stands at the points of a polyline or a signal.
void visit_points(const std::string& kind, Part& part, const Visit& visit) {
  const bool loaded = !part.load.empty() || !part.load_stop.empty();
  Dimension at = dim::length, height = dim::force;
  if (kind == "signal") at = part.flag("in_periods") ? dim::pure : dim::time, height = dim::length;
  if (kind == "damper") at = dim::speed;
  if (kind == "friction") at = dim::speed, height = loaded ? dim::pure : dim::force;
  if (kind == "stop") at = dim::speed, height = dim::pure;
  for (Point& point : part.points) visit(point.at, at), visit(point.force, height);
}

void visit_part(const std::string& kind, Part& part, const Visit& visit) {
  const bool loaded = !part.load.empty() || !part.load_stop.empty();
  for (auto& [key, scalar] : part.fields)
    visit(scalar, kind == "force" && key == "amplitude" && part.texts.contains("signal")
                      ? dim::stiffness
                      : dimension(kind, key, loaded));
  for (Part& harmonic : part.harmonics) visit_part(kind, harmonic, visit);
  visit_points(kind, part, visit);
  for (Scalar& end : part.within) visit(end, dim::length);
  for (auto& [key, scalar] : part.stribeck)
    visit(scalar, key == "speed"                                    ? dim::speed
                  : key == "corners" || key == "exponent" || loaded ? dim::pure
                                                                    : dim::force);
  for (auto& [key, scalar] : part.band)
    visit(scalar, key != "rms" ? dim::pure : kind == "force" ? dim::force : dim::length);
  for (auto& [key, scalar] : part.load)
    visit(scalar, key == "constant" ? dim::force : key.starts_with("v") ? dim::damping : dim::stiffness);
}

}  // namespace

void each_number(Definition& file, const Visit& visit) {
  if (file.omega) visit(*file.omega, dim::rate);
  for (auto& [kind, all] : file.parts)
    for (Part& part : all)
      if (kind != "observable") visit_part(kind, part, visit);
  for (auto& [key, matrix] : file.matrices)
    for (Scalar& entry : matrix.entries)
      visit(entry, key == "mass" ? dim::mass : key == "damping" ? dim::damping : dim::stiffness);
  for (auto& [name, scalar] : file.start) visit(scalar, name.starts_with("v") ? dim::speed : dim::length);
}

Scalar number(double value) { return {value, std::nullopt, 0}; }

void multiply(Scalar& scalar, double factor) {
  if (scalar.expression)
    scalar.expression = Expression("(" + scalar.expression->text() + ") * " + shortest_decimal(factor));
  scalar.number *= factor;
}

void add(Scalar& scalar, double summand) {
  if (scalar.expression)
    scalar.expression = Expression(scalar.expression->text() + " + (" + shortest_decimal(summand) + ")");
  scalar.number += summand;
}

double value(const Definition& file, const Scalar& scalar) {
  return scalar.expression ? scalar.expression->evaluate(all_values(file, {})) : scalar.number;
}

void each_linked(Definition& file, const std::function<void(Part&)>& visit) {
  for (const PartRule& rule : part_rules())
    if (rule.ends == Ends::between || rule.ends == Ends::moving)
      for (Part& part : parts(file, std::string(rule.kind))) visit(part);
}

std::vector<Part>& parts(Definition& file, const std::string& kind) { return file.parts[kind]; }

Scalar* field(Part& part, const std::string& key) {
  const auto found = part.fields.find(key);
  return found == part.fields.end() ? nullptr : &found->second;
}

int coordinates(const Definition& file) { return static_cast<int>(file.of("coordinate").size()); }

int home(const Definition& file, int coordinate) {
  return file.of("coordinate")[static_cast<std::size_t>(coordinate)].b;
}

std::string velocity_name(const std::string& coordinate) {
  return coordinate.starts_with("x") ? "v" + coordinate.substr(1) : "v_" + coordinate;
}

bool has_harmonics(const Definition& file) { return read(file).build().forced(); }

std::vector<std::pair<std::string, Scalar>> whole_start(const Definition& file) {
  std::vector<std::pair<std::string, Scalar>> all;
  for (const Part& coordinate : file.of("coordinate"))
    for (const std::string& name : {coordinate.name, velocity_name(coordinate.name)}) {
      const auto found = std::ranges::find(file.start, name, &std::pair<std::string, Scalar>::first);
      all.emplace_back(name, found == file.start.end() ? number(0) : found->second);
    }
  return all;
}

std::string text(const Definition& file) { return print_definition(file, {}); }

ModelDefinition read(const Definition& file) { return ModelDefinition::parse(text(file), "random.toml"); }

}  // namespace slapstick::neutral
