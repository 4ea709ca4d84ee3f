#pragma once
/// Which keys of a part stand in place of others, as its rule says.
#include <string>
#include <string_view>

#include "io/definition.hpp"
#include "io/toml_tree.hpp"

namespace slapstick {

/// The first of keys with '|' between them that a table has, or "".
[[nodiscard]] std::string first_present(const TomlNode& table, std::string_view keys);

/// Has a table a key that stands in place of this one?
[[nodiscard]] bool replaced(const TomlNode& table, const PartRule& rule, std::string_view key);

}  // namespace slapstick
