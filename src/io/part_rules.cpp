#include "io/definition.hpp"
#include "slapstick/base/text.hpp"

namespace slapstick {

const std::vector<PartRule>& part_rules() {
  static const std::vector<PartRule> rules = {
      {"coordinate", true, Ends::none, {{"mass", true}}},
      {"spring", false, Ends::between, {{"stiffness", true}}},
      {"damper", false, Ends::between, {{"coefficient", true}}},
      {"force", false, Ends::on, {{"amplitude", true}, {"harmonic", false}, {"phase", false}}},
      {"friction", true, Ends::between, {{"static", true}, {"kinetic", false}, {"belt_speed", false}}},
      {"stop", true, Ends::between, {{"clearance", true}, {"restitution", true}}},
  };
  return rules;
}

std::string part_label(std::string_view kind, std::size_t index, const Part& part) {
  std::string label(kind);
  label += ' ';
  return label + (part.name.empty() ? std::to_string(index + 1) : in_quotes(part.name));
}

}  // namespace slapstick
