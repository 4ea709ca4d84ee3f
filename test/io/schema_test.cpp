/// models/model.schema.json, which editors use, and the reader know the same keys, and agree on what is a model.
#include <gtest/gtest.h>
#include <algorithm>

#include <fstream>

#include "io/definition.hpp"
#include "io/everything.hpp"
#include "io/json_schema.hpp"
#include "io/refusal.hpp"
#include "io/toml_tree.hpp"

namespace slapstick {
namespace {

using Names = std::set<std::string>;

const JsonValue& schema() {
  static const JsonValue json = JsonValue::parse(std::ifstream(SLAPSTICK_SCHEMA));
  return json;
}

JsonValue json_of(const TomlNode& node) {
  JsonValue json;
  switch (node.kind) {
    case TomlNode::Kind::table:
      json = JsonValue::object();
      for (const auto& [key, value] : node.entries) json[key] = json_of(value);
      break;
    case TomlNode::Kind::list:
      json = JsonValue::array();
      for (const auto& item : node.items) json.push_back(json_of(item));
      break;
    case TomlNode::Kind::number:
      json = node.number;
      break;
    case TomlNode::Kind::boolean:
      json = node.number != 0.0;
      break;
    default:
      json = node.text;
  }
  return json;
}

std::string violation(const std::string& text) {
  return SchemaChecker::violation(schema(), json_of(parse_toml(text, "f.toml")));
}

Names keys_of(const JsonValue& object) {
  Names keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}

Names names(const std::vector<std::string>& list) { return {list.begin(), list.end()}; }
Names required(const JsonValue& object) { return object.at("required").get<Names>(); }

/// By another key of the part; the schema says it in `anyOf`.
bool replaceable(const PartRule& rule, std::string_view key) {
  return std::any_of(rule.fields.begin(), rule.fields.end(), [&](const auto& field) {
    return ("|" + std::string(field.instead_of) + "|").find("|" + std::string(key) + "|") != std::string::npos;
  });
}

Names required(const PartRule& rule) {
  Names keys;
  if (rule.named) keys.insert("name");
  if (rule.ends != Ends::none) keys.insert(rule.ends == Ends::on ? "on" : "between");
  for (const auto& field : rule.fields)
    if (field.required && !replaceable(rule, field.key)) keys.emplace(field.key);
  return keys;
}

/// The type that the schema must give a key for what the reader takes.
std::string type_of(Holds holds, std::string_view key) {
  if (key == "harmonic") return R"(["integer","string"])";
  switch (holds) {
    case Holds::flag:
      return R"("boolean")";
    case Holds::text:
    case Holds::contact_law:
    case Holds::shape:
      return R"("string")";
    case Holds::stribeck:
    case Holds::load:
    case Holds::band:
      return R"("object")";
    case Holds::interval:
    case Holds::ratio:
    case Holds::harmonics:
    case Holds::points:
      return R"("array")";
    default:
      return R"(["number","string"])";
  }
}

void expect_part(const PartRule& rule, const JsonValue& item) {
  SCOPED_TRACE(rule.kind);
  const auto& properties = item.at("properties");
  EXPECT_EQ(keys_of(properties), names(part_keys(rule)));
  EXPECT_EQ(required(item), required(rule));
  EXPECT_EQ(item.at("additionalProperties"), false);
  for (const auto& field : rule.fields)
    EXPECT_EQ(properties.at(field.key).at("type").dump(), type_of(field.holds, field.key)) << field.key;
}

TEST(Schema, its_keys_are_the_readers) {
  const auto& properties = schema().at("properties");
  EXPECT_EQ(keys_of(properties), names(top_keys()));
  EXPECT_EQ(schema().at("additionalProperties"), false);
  for (const auto& rule : part_rules()) expect_part(rule, properties.at(rule.kind).at("items"));
  expect_part(harmonic_rule(), properties.at("base").at("items").at("properties").at("harmonics").at("items"));
  const auto& parameter = properties.at("parameters").at("additionalProperties").at("anyOf").at(2);
  EXPECT_EQ(keys_of(parameter.at("properties")), names(parameter_keys()));
  EXPECT_EQ(keys_of(properties.at("matrix").at("properties")), names(matrix_keys()));
  EXPECT_EQ(keys_of(properties.at("scale").at("properties")), names(scale_keys()));
  for (const auto& [key, quantity] : properties.at("scale").at("properties").items())
    EXPECT_EQ(keys_of(quantity.at("properties")), names(quantity_keys())) << key;
  EXPECT_EQ(properties.at("impact_law").at("enum").get<std::vector<std::string>>(), impact_laws());
}

/// Every key under every "properties".
void expect_descriptions(const JsonValue& node, const std::string& path) {
  if (node.is_object() && node.contains("properties")) {
    for (const auto& [key, value] : node["properties"].items())
      EXPECT_FALSE(value.value("description", "").empty()) << path << "/" << key;
  }
  if (node.is_structured())
    for (const auto& [key, value] : node.items()) expect_descriptions(value, path + "/" + key);
}

TEST(Schema, every_key_is_described_and_every_number_has_its_unit) {
  expect_descriptions(schema(), "");
  for (const auto& rule : part_rules())
    for (const auto& field : rule.fields) {
      if (field.holds != Holds::number) continue;
      const auto& key = schema().at("properties").at(rule.kind).at("items").at("properties").at(field.key);
      EXPECT_NE(key.at("description").get<std::string>().find("Unit: "), std::string::npos) << rule.kind << field.key;
      EXPECT_TRUE(field.key == "phase" || key.contains("minimum") || key.contains("exclusiveMinimum"))
          << rule.kind << " " << field.key;
    }
}

TEST(Schema, every_model_conforms) {
  for (const auto& name : builtin_models()) EXPECT_EQ(violation(load_model(name).to_toml()), "") << name;
  EXPECT_EQ(violation(new_model("mine")), "");
  EXPECT_EQ(violation(everything()), "");
  EXPECT_EQ(violation(ModelDefinition::parse(everything(), "f.toml").to_toml()), "");
}

TEST(Schema, what_it_refuses_the_reader_refuses) {
  const std::string head = "name = 'm'\n", x = "[[coordinate]]\nname = 'x'\nmass = 1\n";
  const std::string spring = "[[spring]]\nbetween = ['x', 'ground']\n",
                    stop = "[[stop]]\nname = 's'\nbetween = ['x', 'ground']\n";
  const std::vector<std::string> texts = {
      x,
      head,
      head + "nmae = 1\n" + x,
      head + x + "masss = 1\n",
      head + x + spring,
      head + x + spring + "stiffness = true\n",
      head + x + spring + "stiffness = 1e60\n",
      head + x + "[[spring]]\nbetween = ['x']\nstiffness = 1\n",
      head + x + stop + "clearance = 1\nrestitution = 2\n",
      head + x + stop + "clearance = 1\nrestitution = 1\ntwo_sided = 'yes'\n",
      head + x + stop + "clearance = 1\nrestitution = 1\nclearance_lower = 1\n",
      head + x + "[[force]]\non = 'x'\namplitude = 1\nharmonic = 0.5\n",
      head + x + "[[compliant_stop]]\nname = 's'\nbetween = ['x', 'ground']\nclearance = 0\nstiffness = 0\n",
      head + "impact_law = 'newton'\n" + x,
      head + x + "[matrix]\nmas = [[1]]\n",
      head + x + "[matrix]\nmass = 1\n",
      head + x + "[scale]\nlength = { value = 1, unit = 'm' }\n",
      head + x + "[parameters]\np = { min = 1 }\n",
      head + x + "[parameters]\n'a b' = 1\n",
      head + x + "[groups]\ng = []\n",
      "omega = -1\n" + head + x,
  };
  for (const auto& text : texts) {
    EXPECT_NE(violation(text), "") << text;
    EXPECT_NE(refusal(text), "accepted") << text;
  }
  EXPECT_EQ(violation(head + x), "");
}

}  // namespace
}  // namespace slapstick
