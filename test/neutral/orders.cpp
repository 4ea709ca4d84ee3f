/// Edits that put things in another order.
#include <algorithm>
#include <numeric>

#include "neutral/edits.hpp"

namespace slapstick::neutral {
namespace {

/// A permutation that is not the identity; `count` at least 2.
std::vector<std::size_t> permutation(std::size_t count, campaign::Random& random) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count - 1; i > 0; --i)
    std::swap(order[i], order[static_cast<std::size_t>(random.below(static_cast<int>(i + 1)))]);
  if (std::ranges::is_sorted(order)) std::ranges::reverse(order);
  return order;
}

template <class Thing>
void reorder(std::vector<Thing>& things, const std::vector<std::size_t>& order) {
  std::vector<Thing> after;
  for (const std::size_t k : order) after.push_back(things[k]);
  things = std::move(after);
}

std::optional<Edited> reordered(const Definition& file, campaign::Random& random,
                                std::initializer_list<const char*> kinds) {
  Edited edited{file, {}};
  bool changed = false;
  for (const char* kind : kinds) {
    auto& all = parts(edited.file, kind);
    if (all.size() < 2) continue;
    reorder(all, permutation(all.size(), random));
    changed = true;
  }
  if (!changed) return std::nullopt;
  return edited;
}

}  // namespace

std::optional<Edited> other_order_of_coordinates(const Definition& file, campaign::Random& random) {
  const auto n = file.of("coordinate").size();
  if (n < 2) return std::nullopt;
  Edited edited{file, {}};
  const auto order = permutation(n, random);  // order[new] = old
  std::vector<int> place(n);
  for (std::size_t k = 0; k < n; ++k) place[order[k]] = static_cast<int>(k);
  reorder(parts(edited.file, "coordinate"), order);
  const auto move = [&](int& end) {
    if (end >= 0) end = place[static_cast<std::size_t>(end)];
  };
  each_linked(edited.file, [&](Part& part) { move(part.a), move(part.b); });
  for (const char* kind : {"force", "impulse"})
    for (Part& load : parts(edited.file, kind)) move(load.a);
  for (auto& [key, matrix] : edited.file.matrices) {
    const std::vector<Scalar> before = matrix.entries;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) matrix.entries[i * n + j] = before[order[i] * n + order[j]];
  }
  return edited;
}

std::optional<Edited> other_order_of_links(const Definition& file, campaign::Random& random) {
  return reordered(file, random, {"spring", "damper", "maxwell", "jenkins", "force"});
}

/// `sequence` goes by the order of the stops in the file.
std::optional<Edited> other_order_of_contacts(const Definition& file, campaign::Random& random) {
  if (file.impact_law == ImpactLaw::sequence)
    return reordered(file, random, {"friction", "freewheel", "compliant_stop"});
  return reordered(file, random, {"friction", "freewheel", "stop", "compliant_stop"});
}

}  // namespace slapstick::neutral
