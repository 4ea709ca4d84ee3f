#pragma once
/// A line that is no TOML: what its author most likely meant.
#include <string>
#include <string_view>

namespace slapstick {

/// "mass: write 0.5, not 0,5" of the first `key = value` in the line whose value TOML does not read; "" if there is no
/// such pair.
[[nodiscard]] std::string toml_remedy(std::string_view line);

}  // namespace slapstick
