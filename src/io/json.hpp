#pragma once
/// JSON results as a plain tree. nlohmann/json lives behind `dump` and nowhere else.
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace slapstick {

/// A JSON value. Objects keep the order in which their keys were set, so that equal results are equal bytes.
///
///     Json json = Json::object();
///     json.set("class", "1-1-I").set("p", 1).set("w", 0.25).set("state", Json::list({-0.5, 0.0}));
class Json {
 public:
  using List = std::vector<Json>;
  using Object = std::vector<std::pair<std::string, Json>>;
  using Value = std::variant<std::nullptr_t, bool, std::int64_t, double, std::string, List, Object>;

  Json() = default;  ///< null
  // NOLINTBEGIN(google-explicit-constructor): values stand for themselves
  Json(bool value) : value_(value) {}
  Json(double value) : value_(value) {}
  Json(const char* text) : value_(std::string(text)) {}
  Json(std::string text) : value_(std::move(text)) {}
  template <class Integer, class = std::enable_if_t<std::is_integral_v<Integer> && !std::is_same_v<Integer, bool>>>
  Json(Integer value) : value_(static_cast<std::int64_t>(value)) {}
  // NOLINTEND(google-explicit-constructor)

  static Json object() { return Json(Value(Object{})); }
  static Json list() { return Json(Value(List{})); }
  static Json list(const std::vector<double>& numbers);

  /// Sets a key of an object (replacing it) or appends to a list; null becomes one. @throws std::logic_error on other
  /// values
  Json& set(std::string_view key, Json value);
  Json& push(Json value);

  /// The text with this indentation, or on one line with -1; ends without a line break. A double has 17 significant
  /// digits, as in tables, and reads back as the same; one that is not finite becomes the string "inf", "-inf" or
  /// "nan". Bytes that are not UTF-8 become U+FFFD.
  [[nodiscard]] std::string dump(int indent = 2) const;
  [[nodiscard]] const Value& value() const { return value_; }

 private:
  explicit Json(Value value) : value_(std::move(value)) {}
  Value value_;
};

}  // namespace slapstick
