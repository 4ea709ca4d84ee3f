/// Lists the keys of a model file: the one table that reader, printer and reference follow.
#include "base/text.hpp"
#include "io/definition.hpp"

namespace slapstick {

namespace {

/// Bodies and what links them.
std::vector<PartRule> bodies() {
  const FieldRule ratio{"ratio", false, Holds::ratio}, below{"slope_below", false, Holds::number, {}, "characteristic"},
      above{"slope_above", false, Holds::number, {}, "characteristic"};
  return {
      {"coordinate", true, Ends::none, {{"mass"}, {"unit", false, Holds::text}, {"base", false, Holds::text}}},
      {"signal",
       true,
       Ends::none,
       {{"points", true, Holds::points},
        {"file", false, Holds::text, "points"},
        {"column", false, Holds::text, {}, "file"},
        {"shape", false, Holds::shape, "points|file"},
        {"duty", false, Holds::number, {}, "shape"},
        {"rise", false, Holds::number, {}, "shape"},
        {"phase", false, Holds::number, {}, "shape"},
        {"low", false, Holds::number, {}, "shape"},
        {"high", false, Holds::number, {}, "shape"},
        {"period", false, Holds::number, {}, "shape"},
        {"repeats", false, Holds::flag, "shape"},
        {"in_periods", false, Holds::flag, "period", "repeats|shape"}}},
      {"base",
       true,
       Ends::none,
       {{"harmonics", true, Holds::harmonics},
        {"band", false, Holds::band, "harmonics"},
        {"signal", false, Holds::text, "harmonics|band"}}},
      {"spring",
       false,
       Ends::moving,
       {ratio,
        {"stiffness", true},
        {"characteristic", false, Holds::points, "stiffness"},
        below,
        above,
        {"name", false, Holds::text}}},
      {"damper",
       false,
       Ends::moving,
       {ratio,
        {"coefficient", true},
        {"feeds", false, Holds::flag, {}, "coefficient"},
        {"within", false, Holds::interval, {}, "coefficient"},
        {"coefficient_outside", false, Holds::number, {}, "within"},
        {"characteristic", false, Holds::points, "coefficient"},
        below,
        above,
        {"name", false, Holds::text}}},
  };
}

/// A spring in series with something.
std::vector<PartRule> elements() {
  const FieldRule ratio{"ratio", false, Holds::ratio};
  return {
      {"maxwell", true, Ends::between, {ratio, {"stiffness", true}, {"damping", true}}},
      {"jenkins", true, Ends::between, {ratio, {"stiffness", true}, {"limit", true}}},
  };
}

std::vector<PartRule> loads() {
  return {
      {"force",
       false,
       Ends::on,
       {{"amplitude", true},
        {"harmonic"},
        {"phase"},
        {"frequency", false, Holds::number, "harmonic"},
        {"signal", false, Holds::text, "harmonic|phase|frequency"},
        {"band", false, Holds::band, "amplitude|harmonic|phase|frequency|signal"}}},
      {"impulse",
       true,
       Ends::on,
       {{"momentum", true},
        {"time", true},
        {"phase", false, Holds::number, "time"},
        {"period", false, Holds::number, {}, "time"}}},
  };
}

/// Contacts, and what is looked at.
std::vector<PartRule> contacts() {
  const FieldRule ratio{"ratio", false, Holds::ratio};
  return {
      {"friction",
       true,
       Ends::between,
       {ratio,
        {"static", true},
        {"kinetic"},
        {"characteristic", false, Holds::points, "kinetic"},
        {"stribeck", false, Holds::stribeck, "static|kinetic|characteristic"},
        {"normal_force", false, Holds::load},
        {"belt_speed"}}},
      {"freewheel", true, Ends::between, {ratio, {"holds", true}, {"drag"}}},
      {"stop",
       true,
       Ends::between,
       {ratio,
        {"two_sided", false, Holds::flag},
        {"clearance", true},
        {"clearance_lower"},
        {"restitution", true},
        {"restitution_over_speed", false, Holds::points, "restitution"}}},
      {"compliant_stop",
       true,
       Ends::between,
       {ratio,
        {"two_sided", false, Holds::flag},
        {"clearance", true},
        {"clearance_lower"},
        {"stiffness", true},
        {"damping"},
        {"unloading_stiffness", false, Holds::number, "damping"},
        {"pulls", false, Holds::flag},
        {"law", false, Holds::contact_law, "pulls"}}},
      {"observable", true, Ends::none, {{"value", true, Holds::observed}, {"unit", false, Holds::text}}},
  };
}

}  // namespace

const std::vector<PartRule>& part_rules() {
  static const std::vector<PartRule> rules = [] {
    std::vector<PartRule> all = bodies();
    for (auto* more : {elements, loads, contacts})
      for (PartRule& rule : more()) all.push_back(std::move(rule));
    return all;
  }();
  return rules;
}

const PartRule& harmonic_rule() {
  static const PartRule rule = {
      "harmonic",
      false,
      Ends::none,
      {{"amplitude", true}, {"harmonic"}, {"phase"}, {"frequency", false, Holds::number, "harmonic"}}};
  return rule;
}

std::vector<std::string> part_keys(const PartRule& rule) {
  std::vector<std::string> keys;
  if (rule.kind != harmonic_rule().kind) keys.emplace_back("description");
  if (rule.named) keys.emplace_back("name");
  if (rule.ends != Ends::none) keys.emplace_back(rule.ends == Ends::on ? "on" : "between");
  for (const auto& field : rule.fields) keys.emplace_back(field.key);
  return keys;
}

const std::vector<std::string>& top_keys() {
  static const std::vector<std::string> keys = [] {
    std::vector<std::string> all = {"name",       "summary", "notes", "omega",  "impact_law",
                                    "parameters", "groups",  "start", "matrix", "scale"};
    for (const auto& rule : part_rules()) all.emplace_back(rule.kind);
    return all;
  }();
  return keys;
}

const std::vector<std::string>& parameter_keys() {
  static const std::vector<std::string> keys = {"value", "min", "max", "above", "below", "description", "unit"};
  return keys;
}

const std::vector<std::string>& matrix_keys() {
  static const std::vector<std::string> keys = {"mass", "damping", "stiffness", "coordinates"};
  return keys;
}

const std::vector<std::string>& scale_keys() {
  static const std::vector<std::string> keys = {"length", "time", "mass"};
  return keys;
}

const std::vector<std::string>& quantity_keys() {
  static const std::vector<std::string> keys = {"value", "unit"};
  return keys;
}

const std::vector<std::string>& stribeck_keys() {
  static const std::vector<std::string> keys = {"static", "kinetic", "speed", "exponent", "corners"};
  return keys;
}

const std::vector<std::string>& band_keys() {
  static const std::vector<std::string> keys = {"from", "to", "lines", "rms", "seed"};
  return keys;
}

const std::vector<std::string>& contact_laws() {
  static const std::vector<std::string> words = {"lets_go", "pulls", "bounded"};
  return words;
}

const std::vector<std::string>& signal_shapes() {
  static const std::vector<std::string> words = {"square", "trapezoid", "triangle", "sawtooth"};
  return words;
}

const std::vector<std::string>& impact_laws() {
  static const std::vector<std::string> words = {"moreau", "sequence"};
  return words;
}

std::string scale_name(const std::string& key) { return "scale_" + key; }

std::string gap_name(const std::string& stop) { return "gap_" + stop; }

std::string inner_name(const std::string& element) { return "s_" + element; }

std::string part_label(std::string_view kind, std::size_t index, const Part& part) {
  std::string label(kind);
  label += ' ';
  return label + (part.name.empty() ? std::to_string(index + 1) : in_quotes(part.name));
}

}  // namespace slapstick
