#pragma once
/// All that the program takes: the verbs with their arguments, as the verbs declare them.
///
/// Nothing is listed a second time: help, manual pages, the page docs/reference/options.md, completion and `describe`
/// walk this.
#include <string>
#include <vector>

#include "arguments.hpp"

namespace slapstick::app {

struct VerbFacts {
  std::string name, summary, notes;
  std::vector<ArgumentFact> arguments;
};

/// In the order of `verbs`.
[[nodiscard]] std::vector<VerbFacts> catalogue();

/// Verbs with their arguments, quantities, statistics and models, as JSON and as the page docs/reference/options.md.
[[nodiscard]] std::string catalogue_json();
[[nodiscard]] std::string catalogue_markdown();

/// The manual page of "slapstick", or slapstick-VERB(1) of a verb, for man. @throws InputError of another name
[[nodiscard]] std::string manual(const std::string& page);

/// The script of a shell: "bash", "zsh" or "fish".
[[nodiscard]] std::string completion(const std::string& shell);

}  // namespace slapstick::app
