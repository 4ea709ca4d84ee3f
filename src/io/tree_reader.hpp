#pragma once
/// What every part of the model reader needs: checks of a tree's nodes, with messages that name file, line and key.
///
/// `where` in every function is the part, for messages: "spring 2", "parameter 'omega': value".
#include <string>
#include <string_view>
#include <vector>

#include "io/definition.hpp"
#include "io/toml_tree.hpp"

namespace slapstick {

class TreeReader {
 public:
  using Kind = TomlNode::Kind;

  static constexpr std::size_t most_entries =
      1000;  ///< of one kind; also bounds the depth of expressions that refer to each other
  static constexpr std::size_t longest_text = 500;
  static constexpr std::size_t longest_notes_line = 1000;

  explicit TreeReader(std::string source) : source_(std::move(source)) {}

  /// The parameters that expressions may name.
  void know_parameter(const std::string& name) { parameters_.push_back(name); }
  [[nodiscard]] const std::vector<std::string>& parameters() const { return parameters_; }
  [[nodiscard]] bool is_parameter(const std::string& name) const;

  /// What changes in the course of a motion, which coefficients may not follow.
  void know_state(const std::string& name) { states_.push_back(name); }

  [[noreturn]] void fail(int line, const std::string& where, const std::string& what) const;
  void expect(const TomlNode& node, Kind kind, const std::string& where) const;
  void check_keys(const TomlNode& table, const std::string& where, const std::vector<std::string>& known) const;
  void check_count(const TomlNode& node, std::size_t count, const std::string& where) const;
  void check_text(const TomlNode& node, std::string_view line, const std::string& where, std::size_t longest) const;
  /// A name that is usable in expressions, in tables and on the command line.
  void check_new_name(const std::string& name, int line, const std::string& what) const;

  /// A one-line text, or "" if the key is absent.
  [[nodiscard]] std::string text(const TomlNode& table, const char* key, const std::string& where) const;
  /// One of these words. @returns its index
  [[nodiscard]] std::size_t word(const TomlNode& node, const std::string& where,
                                 const std::vector<std::string>& words) const;
  [[nodiscard]] bool flag(const TomlNode& node, const std::string& where) const;
  [[nodiscard]] double plain_number(const TomlNode& node, const std::string& where) const;
  /// A number or an expression of parameters that exist.
  [[nodiscard]] Scalar scalar(const TomlNode& node, const std::string& where) const;
  /// A number or an expression of `known` names; `what` is what the message calls them: "unknown parameter 'm'". A name
  /// that is known twice may not be used.
  [[nodiscard]] Scalar scalar(const TomlNode& node, const std::string& where, const char* what,
                              const std::vector<std::string>& known) const;

 private:
  std::string source_;
  std::vector<std::string> parameters_, states_;
};

}  // namespace slapstick
