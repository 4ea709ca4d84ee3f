#pragma once
/// What slapstick-verify tells about itself.
#include <string>

namespace verify {

/// The text of --help.
[[nodiscard]] std::string usage();

/// slapstick-verify(1), as `man` reads it.
[[nodiscard]] std::string manual();

}  // namespace verify
