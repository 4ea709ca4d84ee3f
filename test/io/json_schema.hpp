#pragma once
/// A checker for the part of JSON Schema (draft 2020-12) that models/model.schema.json uses. A keyword that it does not
/// know is an error, so that no rule of the schema goes unchecked.
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>

namespace slapstick {

using JsonValue = nlohmann::ordered_json;

class SchemaChecker {
 public:
  /// "" or the first violation: "/spring/0: unknown key 'stifness'".
  static std::string violation(const JsonValue& schema, const JsonValue& value, const std::string& path = "") {
    for (const auto& [keyword, rule] : schema.items()) {
      const auto what = broken(schema, keyword, rule, value, path);
      if (!what.empty()) return what.front() == '/' ? what : (path.empty() ? "/" : path) + ": " + what;
    }
    return "";
  }

 private:
  static std::string broken(const JsonValue& schema, const std::string& keyword, const JsonValue& rule,
                            const JsonValue& value, const std::string& path) {
    static const std::set<std::string> prose = {"$schema", "title", "description", "default", "examples"};
    if (prose.count(keyword) != 0) return "";
    if (keyword == "type") return of_type(rule, value) ? "" : "not of type " + rule.dump();
    if (keyword == "anyOf") return any(rule, value);
    if (keyword == "enum")
      return std::find(rule.begin(), rule.end(), value) != rule.end() ? "" : "not in " + rule.dump();
    const bool object = value.is_object(), list = value.is_array(), text = value.is_string(),
               number = value.is_number();
    if (keyword == "properties") return object ? properties(rule, value, path) : "";
    if (keyword == "additionalProperties") return object ? others(schema, rule, value, path) : "";
    if (keyword == "propertyNames") return object ? names(rule, value) : "";
    if (keyword == "required") return object ? missing(rule, value) : "";
    if (keyword == "dependentRequired") return object ? dependent(rule, value) : "";
    if (keyword == "items") return list ? items(rule, value, path) : "";
    if (keyword == "minItems") return !list || value.size() >= rule ? "" : "too few items";
    if (keyword == "maxItems") return !list || value.size() <= rule ? "" : "too many items";
    if (keyword == "minLength") return !text || value.get<std::string>().size() >= rule ? "" : "too short";
    if (keyword == "maxLength") return !text || value.get<std::string>().size() <= rule ? "" : "too long";
    if (keyword == "pattern")
      return !text || std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>()))
                 ? ""
                 : "not of the pattern";
    if (keyword == "minimum") return !number || value >= rule ? "" : "below " + rule.dump();
    if (keyword == "maximum") return !number || value <= rule ? "" : "above " + rule.dump();
    if (keyword == "exclusiveMinimum") return !number || value > rule ? "" : "not above " + rule.dump();
    return "the checker does not know the keyword " + keyword;
  }

  static bool of_type(const JsonValue& types, const JsonValue& value) {
    if (types.is_array())
      return std::any_of(types.begin(), types.end(), [&](const JsonValue& type) { return of_type(type, value); });
    if (types == "integer") return value.is_number() && value.get<double>() == std::floor(value.get<double>());
    return types == (value.is_object()    ? "object"
                     : value.is_array()   ? "array"
                     : value.is_string()  ? "string"
                     : value.is_boolean() ? "boolean"
                     : value.is_number()  ? "number"
                                          : "null");
  }

  static std::string any(const JsonValue& schemas, const JsonValue& value) {
    std::string last;
    for (const auto& schema : schemas)
      if ((last = violation(schema, value)).empty()) return "";
    return "fits none of " + std::to_string(schemas.size()) + ", the last because " + last.substr(1);
  }

  static std::string properties(const JsonValue& rules, const JsonValue& value, const std::string& path) {
    for (const auto& [key, rule] : rules.items())
      if (value.contains(key))
        if (auto what = violation(rule, value[key], path + "/" + key); !what.empty()) return what;
    return "";
  }

  static std::string others(const JsonValue& schema, const JsonValue& rule, const JsonValue& value,
                            const std::string& path) {
    for (const auto& [key, each] : value.items()) {
      if (schema.contains("properties") && schema["properties"].contains(key)) continue;
      if (rule == false) return "unknown key '" + key + "'";
      if (auto what = violation(rule, each, path + "/" + key); !what.empty()) return what;
    }
    return "";
  }

  static std::string names(const JsonValue& rule, const JsonValue& value) {
    for (const auto& [key, each] : value.items())
      if (!violation(rule, key).empty()) return "name '" + key + "'";
    return "";
  }

  static std::string missing(const JsonValue& keys, const JsonValue& value) {
    for (const auto& key : keys)
      if (!value.contains(key.get<std::string>())) return "'" + key.get<std::string>() + "' is missing";
    return "";
  }

  static std::string dependent(const JsonValue& rules, const JsonValue& value) {
    for (const auto& [key, needed] : rules.items())
      if (value.contains(key))
        if (auto what = missing(needed, value); !what.empty()) return what;
    return "";
  }

  static std::string items(const JsonValue& rule, const JsonValue& value, const std::string& path) {
    for (std::size_t i = 0; i < value.size(); ++i)
      if (auto what = violation(rule, value[i], path + "/" + std::to_string(i)); !what.empty()) return what;
    return "";
  }
};

}  // namespace slapstick
