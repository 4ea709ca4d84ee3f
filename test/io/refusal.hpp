#pragma once
/// The message with which a model file is refused, for tests.
#include <string>

#include "slapstick/base/error.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick {

/// "accepted", or the message.
inline std::string refusal(const std::string& text, const Overrides& overrides = {}) {
  try {
    (void)ModelDefinition::parse(text, "f.toml").start(overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace slapstick
