#pragma once
/// "Did you mean ...?" for every name that a user can mistype.
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"

namespace slapstick {

/// Number of single-character insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
[[nodiscard]] inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    next[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      next[j] = std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) next[j] = std::min(next[j], before[j - 2] + 1);
    }
    before.swap(row);
    row.swap(next);
  }
  return row.back();
}

/// A name without what is most easily left out or mistaken: underscores and the case of letters.
[[nodiscard]] inline std::string plain_name(std::string_view name) {
  std::string plain;
  for (const char c : name)
    if (c != '_') plain += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return plain;
}

/// The candidate that `word` most likely stands for: the one at the least edit distance (the first of equals), or else
/// the only one that begins with it; before all others one that differs in underscores and case only. Empty if no
/// candidate is closer than a third of the word (at least 2 edits).
[[nodiscard]] inline std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  const std::size_t tolerated = std::max<std::size_t>(2, word.size() / 3);
  std::size_t least = tolerated + 1;
  std::string best, longer;
  std::size_t continued = 0;
  if (word.size() > 100) return {};
  const std::string plain = plain_name(word);
  for (const auto& candidate : candidates)
    if (candidate != word && !plain.empty() && plain_name(candidate) == plain) return candidate;
  for (const auto& candidate : candidates) {
    const auto [shorter, longest] = std::minmax({word.size(), candidate.size()});
    const std::size_t distance = longest - shorter < least ? edit_distance(word, candidate) : least;
    if (distance < least && distance < longest) {
      least = distance;
      best = candidate;
    }
    if (!word.empty() && candidate.size() > word.size() && candidate.starts_with(word)) {
      longer = candidate;
      ++continued;
    }
  }
  return best.empty() && continued == 1 ? longer : best;
}

/// The end of a message about an unknown name: "; did you mean 'omega'?", or else "; known: a, b, c" (at most 20), or
/// nothing.
[[nodiscard]] inline std::string suggestion(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string best = nearest(word, candidates);
  if (!best.empty()) return "; did you mean " + in_quotes(best) + "?";
  if (candidates.empty()) return {};
  std::string list = "; known: ";
  for (std::size_t i = 0; i < candidates.size() && i < 20; ++i) list += (i == 0 ? "" : ", ") + candidates[i];
  return list + (candidates.size() > 20 ? ", ..." : "");
}

/// The same for a name of a state: that of a coordinate and of its velocity in turn. The velocity of x1 is v1, that of
/// x is v, that of l is v_l; v_x means the velocity that x has.
[[nodiscard]] inline std::string state_suggestion(const std::string& word, const std::vector<std::string>& names) {
  for (std::size_t i = 0; i + 1 < names.size(); i += 2)
    if (word == "v_" + names[i] || word == "v" + names[i]) return "; did you mean " + in_quotes(names[i + 1]) + "?";
  return suggestion(word, names);
}

}  // namespace slapstick
