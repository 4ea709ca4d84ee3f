/// Prints JSON; the only source that includes nlohmann/json.
#include "io/json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "io/table.hpp"

namespace slapstick {
namespace {

/// Writes a tree with `indent` blanks a level, or with -1 on one line.
class JsonPrinter {
 public:
  explicit JsonPrinter(int indent) : indent_(indent) {}

  [[nodiscard]] std::string text(const Json& json) {
    std::visit(*this, json.value());
    return std::move(out_);
  }

  void operator()(std::nullptr_t) { out_ += "null"; }
  void operator()(bool value) { out_ += value ? "true" : "false"; }
  void operator()(std::int64_t value) { out_ += std::to_string(value); }
  /// 17 digits as in tables; JSON has no word for what is not finite.
  void operator()(double value) {
    if (std::isfinite(value)) return append_number(out_, value);
    out_ += std::isnan(value) ? "\"nan\"" : value > 0.0 ? "\"inf\"" : "\"-inf\"";
  }
  void operator()(const std::string& text) {
    out_ += nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
  void operator()(const Json::List& list) {
    enclosed('[', ']', list, [&](const Json& item) { std::visit(*this, item.value()); });
  }
  void operator()(const Json::Object& object) {
    enclosed('{', '}', object, [&](const auto& entry) {
      (*this)(entry.first);
      out_ += indent_ < 0 ? ":" : ": ";
      std::visit(*this, entry.second.value());
    });
  }

 private:
  template <class Items, class Write>
  void enclosed(char open, char close, const Items& items, const Write& write) {
    out_ += open;
    ++depth_;
    bool first = true;
    for (const auto& item : items) {
      if (!first) out_ += ',';
      first = false;
      new_line();
      write(item);
    }
    --depth_;
    if (!first) new_line();
    out_ += close;
  }
  void new_line() {
    if (indent_ >= 0) out_ += '\n' + std::string(static_cast<std::size_t>(depth_ * indent_), ' ');
  }

  int indent_, depth_ = 0;
  std::string out_;
};

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

std::string Json::dump(int indent) const { return JsonPrinter(indent).text(*this); }

}  // namespace slapstick
