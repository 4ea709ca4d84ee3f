#include "library/published_cases.hpp"

namespace slapstick::library {

const std::vector<Entry>& all_cases() {
  static const auto cases = [] {
    std::vector<Entry> all;
    for (const char* file : {"cases.json", "own_cases.json"})
      for (Entry& entry : read_entries(std::string(SLAPSTICK_CASES) + file)) all.push_back(std::move(entry));
    return all;
  }();
  return cases;
}

}  // namespace slapstick::library
