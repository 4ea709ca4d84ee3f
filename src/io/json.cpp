#include "slapstick/io/json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace slapstick {
namespace {

using Tree = nlohmann::ordered_json;

Tree to_tree(const Json& json);

struct Visitor {
  Tree operator()(std::nullptr_t) const { return nullptr; }
  Tree operator()(bool value) const { return value; }
  Tree operator()(std::int64_t value) const { return value; }
  Tree operator()(double value) const {
    if (std::isfinite(value)) return value;
    if (std::isnan(value)) return "nan";
    return value > 0.0 ? "inf" : "-inf";
  }
  Tree operator()(const std::string& text) const { return text; }
  Tree operator()(const Json::List& list) const {
    Tree tree = Tree::array();
    for (const auto& item : list) tree.push_back(to_tree(item));
    return tree;
  }
  Tree operator()(const Json::Object& object) const {
    Tree tree = Tree::object();
    for (const auto& [key, value] : object) tree[key] = to_tree(value);
    return tree;
  }
};

Tree to_tree(const Json& json) { return std::visit(Visitor{}, json.value()); }

}  // namespace

Json Json::list(const std::vector<double>& numbers) {
  Json json = list();
  for (const double number : numbers) json.push(number);
  return json;
}

Json& Json::set(std::string_view key, Json value) {
  if (std::holds_alternative<std::nullptr_t>(value_)) value_ = Object{};
  auto* object = std::get_if<Object>(&value_);
  if (object == nullptr) throw std::logic_error("Json::set on a value that is not an object");
  for (auto& [name, old] : *object)
    if (name == key) {
      old = std::move(value);
      return *this;
    }
  object->emplace_back(std::string(key), std::move(value));
  return *this;
}

Json& Json::push(Json value) {
  if (std::holds_alternative<std::nullptr_t>(value_)) value_ = List{};
  auto* list = std::get_if<List>(&value_);
  if (list == nullptr) throw std::logic_error("Json::push on a value that is not a list");
  list->push_back(std::move(value));
  return *this;
}

std::string Json::dump(int indent) const {
  return to_tree(*this).dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace slapstick
