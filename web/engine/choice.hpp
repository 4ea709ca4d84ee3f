#pragma once
/// The model that the page shows: a built-in one or the user's text, with the values of its sliders and a start.
///
/// Plain values; errors are those of ModelDefinition. One thread, as everything of the page's engine: a worker has an
/// engine of its own.
#include <string>

#include "slapstick/flow/motion.hpp"
#include "slapstick/io/model_file.hpp"
#include "slapstick/quantity/quantity.hpp"

namespace slapstick::web {

struct Choice {
  ModelDefinition definition;
  Overrides set;
  State start;  ///< user's coordinates, at phase 0; empty: the model's own

  /// @param source  the name of a built-in model, or the text of a model file (which has more than one line)
  /// @throws InputError; of a text its place is "line N: "
  static Choice of(const std::string& source, Overrides set, State start);

  /// The model with these values and `more` on top of them. A mistake in the values names no line of the file.
  [[nodiscard]] Model model(const Overrides& more = {}) const;
  /// Where the motion starts. With `more` the user's own start, moved by rounding errors at most, or the model's.
  [[nodiscard]] State start_at(const Overrides& more = {}) const;
};

/// The text of a built-in model as its file has it, or as `to_toml` prints it with values.
[[nodiscard]] std::string text_of(const Choice& choice);

/// Quantity names, separated by commas, of the model. @throws InputError that names the nearest
[[nodiscard]] std::vector<Quantity> quantities_of(const Choice& choice, const std::string& names);

}  // namespace slapstick::web
