#pragma once
/// --stop: which stops a section, a cycle or a picture is about.
#include <string>
#include <vector>

#include "arguments.hpp"
#include "slapstick/section/stop_choice.hpp"

namespace slapstick::app {

struct StopOptions {
  std::vector<std::string> names;  ///< --stop; none: every stop

  Arguments::Declared declare(Arguments& arguments, const std::string& help);
  /// @throws InputError naming the argument and the stops there are
  [[nodiscard]] StopChoice choice(const Model& model) const;
};

/// The numbers of the chosen stops, in the model's order.
[[nodiscard]] std::vector<int> chosen_stops(const Model& model, const StopChoice& choice);

/// The contact that a picture of the motion is about: the first chosen stop, or else the first friction contact, or -1.
[[nodiscard]] int shown_contact(const Model& model, const StopChoice& choice);

/// Whether tables must say which stop a row is about.
[[nodiscard]] bool several_stops(const Model& model);

/// What the points of the chosen stops are: "impact", "engagement", or "contact" if there are both kinds.
[[nodiscard]] std::string contact_noun(const Model& model, const StopChoice& choice);

/// The same for axes, and of one stop among several: "impact on NAME".
[[nodiscard]] std::string contact_words(const Model& model, const StopChoice& choice);

}  // namespace slapstick::app
