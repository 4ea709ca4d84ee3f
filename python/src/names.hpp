#pragma once
/// Columns of words, kept as the numbers of a list of names.
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace slapstick::python {

/// Which name each row has: `codes` are indices of `names`.
struct Words {
  std::vector<std::string> names;
  std::vector<std::int32_t> codes;
};

/// The names of modes in the order in which a motion meets them.
class ModeWords {
 public:
  template <class System, class Id>
  void add(const System& system, Id id) {
    const auto [place, fresh] = numbers_.try_emplace(id, static_cast<std::int32_t>(words.names.size()));
    if (fresh) words.names.push_back(system.mode_name(id));
    words.codes.push_back(place->second);
  }

  Words words;

 private:
  std::unordered_map<std::int64_t, std::int32_t> numbers_;
};

}  // namespace slapstick::python
