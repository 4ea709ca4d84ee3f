/// Reads ranges of parameters: NAME=A:B and NAME=A:B:COUNT.
#include "parameter_ranges.hpp"

#include <optional>

#include "base/ranges.hpp"
#include "base/text.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::app {

Sweep parse_sweep(const std::string& text, const std::string& argument) {
  const auto [name, range] = name_and_text(argument, text, "NAME=A:B:COUNT");
  const auto parts = split(range, ':');
  if (parts.size() != 3) throw InputError(argument + ": " + in_quotes(text) + " is not of the form NAME=A:B:COUNT");
  Sweep sweep{name, parse_number(argument + " A", parts[0]), parse_number(argument + " B", parts[1]),
              static_cast<int>(parse_integer(argument + " COUNT", parts[2], 2, most_values))};
  if (!(sweep.from < sweep.to))
    throw InputError(argument + ": A = " + shown(sweep.from) + " is not below B = " + shown(sweep.to) +
                     " (A:B is the range, from its lower to its upper end)");
  return sweep;
}

std::vector<std::string> two_parameters(const std::string& text) {
  std::vector<std::string> names = split(text, ',');
  if (names.size() != 2 || names[0].empty() || names[1].empty() || names[0] == names[1])
    throw InputError("--params: " + in_quotes(text) + " is not of the form A,B with two different parameters");
  return names;
}

std::array<ParameterRange, 2> two_ranges(const std::vector<std::string>& texts, const std::vector<std::string>& names) {
  std::array<std::optional<ParameterRange>, 2> found;
  for (const std::string& text : texts) {
    const auto [name, range] = name_and_text("--range", text, "NAME=A:B");
    const auto place = ranges::find(names, name) - names.begin();
    if (place == 2)
      throw InputError("--range: " + in_quotes(name) + " is not one of --params " +
                       in_quotes(names[0] + "," + names[1]));
    auto& of_name = found[static_cast<std::size_t>(place)];
    if (of_name) throw InputError("--range: " + in_quotes(name) + " is given twice");
    of_name = parse_range("--range " + name, range);
  }
  for (std::size_t i = 0; i < 2; ++i)
    if (!found[i]) throw InputError("--range: give " + in_quotes(names[i] + "=A:B") + " too");
  return {*found[0], *found[1]};
}

}  // namespace slapstick::app
