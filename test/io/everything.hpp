#pragma once
/// A model file with every key of the format: the file of `slapstick new` with all of its examples switched on.
#include <string>

#include "slapstick/io/model_file.hpp"

namespace slapstick {

/// Every line that is switched off ("#key", not "# text") switched on.
inline std::string switched_on(std::string text) {
  for (auto at = text.find("\n#"); at != std::string::npos; at = text.find("\n#", at + 1))
    if (text[at + 2] != ' ') text.erase(at + 1, 1);
  return text;
}

inline std::string everything() { return switched_on(new_model("everything")); }

}  // namespace slapstick
