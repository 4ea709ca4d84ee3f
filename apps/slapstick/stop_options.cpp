/// Reads --stop.
#include "stop_options.hpp"

#include "axis_text.hpp"
#include "base/ranges.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::app {

Arguments::Declared StopOptions::declare(Arguments& arguments, const std::string& help) {
  return arguments.repeated("--stop", names, "STOP", help);
}

StopChoice StopOptions::choice(const Model& model) const {
  try {
    return {model, names};
  } catch (const InputError& error) {
    throw InputError(std::string("--stop: ") + error.what());
  }
}

std::vector<int> chosen_stops(const Model& model, const StopChoice& choice) {
  std::vector<int> chosen = stop_contacts(model);
  std::erase_if(chosen, [&](int contact) { return !choice.holds(contact); });
  return chosen;
}

int shown_contact(const Model& model, const StopChoice& choice) {
  const auto chosen = chosen_stops(model, choice);
  if (!chosen.empty()) return chosen.front();
  return model.frictions.empty() ? -1 : static_cast<int>(model.stops.size());
}

bool several_stops(const Model& model) { return stop_contacts(model).size() > 1; }

std::string contact_noun(const Model& model, const StopChoice& choice) {
  const auto chosen = chosen_stops(model, choice);
  const auto rigid = [&](int contact) { return contact < static_cast<int>(model.stops.size()); };
  if (ranges::all_of(chosen, rigid)) return "impact";
  return ranges::none_of(chosen, rigid) ? "engagement" : "contact";
}

std::string contact_words(const Model& model, const StopChoice& choice) {
  const auto chosen = chosen_stops(model, choice);
  const std::string noun = contact_noun(model, choice);
  if (chosen.size() != 1 || !several_stops(model)) return noun;
  return noun + (noun == "impact" ? " on " : " of ") + axis_text(stop_name(model, chosen.front()));
}

}  // namespace slapstick::app
