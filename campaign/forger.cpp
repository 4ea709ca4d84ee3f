/// Forges certificates by their text (docs/reference/certificate.md).
#include "forger.hpp"

#include <sstream>

#include "forging.hpp"

namespace campaign {
namespace {

using namespace forging;

const std::vector<Kind>& deeds() {
  static const std::vector<Kind> all_kinds = [] {
    std::vector<Kind> kinds = of_the_model();
    for (const auto& more : {of_the_run(), of_the_last_bit()}) kinds.insert(kinds.end(), more.begin(), more.end());
    return kinds;
  }();
  return all_kinds;
}

}  // namespace

Forger::Forger(const std::string& certificate) {
  std::istringstream in(certificate);
  for (std::string text; std::getline(in, text);) {
    std::istringstream words(text);
    lines_.emplace_back();
    for (std::string word; words >> word;) lines_.back().push_back(word);
  }
}

std::vector<std::string> Forger::kinds() {
  std::vector<std::string> names;
  for (const Kind& kind : deeds()) names.emplace_back(kind.name);
  return names;
}

Forgery Forger::make(int kind, Random& random) const {
  const Kind& chosen = deeds()[static_cast<std::size_t>(kind)];
  Lines lines = lines_;
  Forgery forgery{chosen.name, {}};
  if (!chosen.deed(lines, random)) return forgery;
  for (const Words& line : lines) {
    for (std::size_t k = 0; k < line.size(); ++k) forgery.text += (k > 0 ? " " : "") + line[k];
    forgery.text += "\n";
  }
  return forgery;
}

}  // namespace campaign
