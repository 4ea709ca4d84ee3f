/// Forgeries of what a certificate says of the model.
#include <array>
#include <cmath>

#include "forging.hpp"

namespace campaign::forging {
namespace {

bool other_law(Lines& lines, Random& random) {
  lines[one(lines, random, {"law"})][1] = lines[one(lines, random, {"law"})][1] == "moreau" ? "sequence" : "moreau";
  return true;
}

/// A clearance, and the numbers that have it.
bool other_clearance(Lines& lines, Random& random) {
  const std::size_t i = one(lines, random, {"stop", "compliant"});
  if (i == lines.size()) return false;
  const std::string before = lines[i][3];
  lines[i][3] = altered(before, random);
  for (const std::size_t k : all(lines, {"number"}))
    if (value(lines[k][3]) != 0.0 && std::abs(value(lines[k][3])) == std::abs(value(before)))
      lines[k][3] = hex(value(lines[k][3]) * value(lines[i][3]) / value(before));
  return lines[i][3] != before;
}

/// A contact that the model does not have any more, taken out of every segment too.
Deed drop_contact(const char* word, std::initializer_list<const char*> before) {
  const std::vector<std::string> earlier(before.begin(), before.end());
  return [=](Lines& lines, Random& random) {
    const std::size_t i = one(lines, random, {word});
    if (i == lines.size()) return false;
    std::size_t column = 5;
    for (std::size_t k = 0; k < i; ++k)
      for (const std::string& other : earlier) column += lines[k].front() == other ? 1 : 0;
    lines.erase(at(lines, i));
    for (const std::size_t k : all(lines, {"segment"}))
      lines[k].erase(lines[k].begin() + static_cast<std::ptrdiff_t>(column));
    return true;
  };
}

/// A number of a corner, of those that restitution has over speed.
bool other_corner(Lines& lines, Random& random) {
  const std::size_t i = one(lines, random, {"stop"});
  if (i == lines.size() || value(lines[i][5]) == 0.0) return false;
  const int corners = static_cast<int>(value(lines[i][5]));
  std::string& number = lines[i][6 + static_cast<std::size_t>(random.below(2 * corners))];
  const std::string before = number;
  number = altered(number, random);
  return number != before;
}

bool other_compliant_law(Lines& lines, Random& random) {
  const std::size_t i = one(lines, random, {"compliant"});
  if (i == lines.size()) return false;
  const std::string before = lines[i][6];
  lines[i][6] = std::to_string(random.below(3));
  return lines[i][6] != before;
}

bool other_polyline(Lines& lines, Random& random) {
  constexpr std::array words = {"displacement", "velocity", "zones"};
  const std::size_t i = one(lines, random, {"polyline"});
  if (i == lines.size()) return false;
  const std::string before = lines[i][3];
  lines[i][3] = words[static_cast<std::size_t>(random.below(3))];
  return lines[i][3] != before;
}

}  // namespace

std::vector<Kind> of_the_model() {
  return {
      {"mass", alter("coordinate", 2, 1)},
      {"stiffness", alter("spring", 3, 1)},
      {"damper", alter("damper", 3, 1)},
      {"amplitude", alter("force", 3, 1)},
      {"phase of a force", alter("force", 4, 1)},
      {"spring left out", drop("spring")},
      {"damper left out", drop("damper")},
      {"frequency of a tone", alter("tone", 2, 1)},
      {"amplitude or phase of a tone", alter("tone", 3)},
      {"force left out", drop("force")},
      {"tone left out", drop("tone")},
      {"force twice", twice("force")},
      {"omega", alter("omega", 1, 1)},
      {"law of impacts", other_law},
      {"restitution", alter("stop", 4, 1)},
      {"clearance", other_clearance},
      {"clearance alone", alter("stop", 3, 1)},
      {"friction limits", alter("friction", 4, 2)},
      {"static friction", alter("friction", 4, 1)},
      {"speed of a belt", alter("friction", 3, 1)},
      {"numbers of a compliant stop", alter("compliant", 3, 3)},
      {"polyline", alter("polyline", 4, 2)},
      {"matrix", alter("stiffness", 2)},
      {"corner of a restitution", other_corner},
      {"law of a compliant stop", other_compliant_law},
      {"what a polyline is over", other_polyline},
      {"normal force", alter("normal", 2, 1)},
      {"normal force left out", drop("normal")},
      {"contact coordinate", alter("number", 3, 2)},
      {"friction contact left out", drop_contact("friction", {"stop"})},
      {"stop left out", drop_contact("stop", {})},
      {"compliant stop left out", drop_contact("compliant", {"stop", "friction"})},
  };
}

}  // namespace campaign::forging
