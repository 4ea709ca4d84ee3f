#pragma once
/// Laws between verbs: two answers of one file that say the same in two ways.
#include <optional>
#include <string>
#include <vector>

#include "neutral/triple.hpp"

namespace slapstick::neutral {

struct Law {
  const char* name;
  const char* meaning;
  /// What breaks it, "" if nothing does; nothing at all where the file has nothing that it speaks of.
  std::optional<std::string> (*check)(const ModelDefinition& definition, const Question& question);
};

[[nodiscard]] const std::vector<Law>& laws();

/// What breaks a law of a file; nothing where it speaks of nothing there, or the numerics did not succeed.
[[nodiscard]] std::optional<std::string> check(const Law& law, const ModelDefinition& definition);

/// The law `basins` (basins_law.cpp).
std::optional<std::string> basins_classify(const ModelDefinition& definition, const Question& question);

/// The smallest file found that breaks a law.
[[nodiscard]] Definition smallest(const Definition& file, const Law& law, int most_tries);

}  // namespace slapstick::neutral
