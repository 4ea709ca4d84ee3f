#pragma once
/// The small model (model.toml) that arguments are checked against, read once.
#include "slapstick/io/model_file.hpp"

namespace slapstick::fuzz {

inline const ModelDefinition& small_model() {
  static const ModelDefinition definition = load_model(SLAPSTICK_FUZZ_MODEL);
  return definition;
}

}  // namespace slapstick::fuzz
