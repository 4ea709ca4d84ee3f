/// Chooses stops by name.
#include "slapstick/section/stop_choice.hpp"

#include <numeric>

#include "base/ranges.hpp"
#include "base/text.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {

StopChoice::StopChoice(const Model& model, const std::vector<std::string>& names) {
  if (names.empty()) return;
  contacts_ = 0;
  const std::vector<int> stops = stop_contacts(model);
  for (const std::string& name : names) {
    const auto found = ranges::find_if(stops, [&](int contact) { return stop_name(model, contact) == name; });
    if (found != stops.end()) {
      contacts_ |= std::uint32_t{1} << static_cast<unsigned>(*found);
      continue;
    }
    std::string known;
    for (const int contact : stops) known += (known.empty() ? "; the model has " : ", ") + stop_name(model, contact);
    throw InputError("model " + in_quotes(model.name) + " has no stop " + in_quotes(name) +
                     (known.empty() ? ", nor any other" : known));
  }
}

std::vector<int> stop_contacts(const Model& model) {
  std::vector<int> contacts(model.stops.size() + model.compliant_stops.size());
  const auto compliant = contacts.begin() + static_cast<std::ptrdiff_t>(model.stops.size());
  std::iota(contacts.begin(), compliant, 0);
  std::iota(compliant, contacts.end(), static_cast<int>(model.stops.size() + model.frictions.size()));
  return contacts;
}

const std::string& stop_name(const Model& model, int contact) {
  const auto number = static_cast<std::size_t>(contact);
  if (number < model.stops.size()) return model.stops[number].name;
  return model.compliant_stops.at(number - model.stops.size() - model.frictions.size()).name;
}

}  // namespace slapstick
