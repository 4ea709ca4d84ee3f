/// Finds what is wrong with ratios: of one link, and of contacts between the same ends.
#include <cmath>

#include "base/text.hpp"
#include "model/fault.hpp"

namespace slapstick {
namespace {

using Found = std::optional<Fault>;

/// Beyond, what moves one end would be rounding beside what moves the other.
constexpr double most_ratio = 1e6, least_ratio = 1e-6;

bool within(double size) { return size >= least_ratio && size <= most_ratio; }

template <class Link>
bool rides(const Link& link) {
  if constexpr (requires { link.motion; }) return !link.motion.none();
  return false;
}

template <class Links>
Found of_links(const char* kind, const Links& links) {
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Ratio& ratio = links[i].ratio;
    const auto fault = [&](const std::string& what) {
      return Fault{kind, static_cast<int>(i), "ratio",
                   "ratio = [" + shown(ratio.a) + ", " + shown(ratio.b) + "]: " + what};
    };
    if (!within(std::abs(ratio.a)) || !within(std::abs(ratio.b)) || !within(std::abs(ratio.a / ratio.b)))
      return fault("a number or their quotient is beyond 1e-6 .. 1e6, of either sign");
    if (ratio != Ratio{} && rides(links[i])) return fault("one of the ends is a base; a ratio is between coordinates");
  }
  return std::nullopt;
}

/// A link that has contacts with others: which are on one pair decides how they act together.
struct Contact {
  const char* kind;
  int index;
  const std::string* name;
  int a, b;
  Ratio ratio;
};

template <class Links>
void add(std::vector<Contact>& all, const char* kind, const Links& links) {
  for (std::size_t i = 0; i < links.size(); ++i)
    all.push_back({kind, static_cast<int>(i), &links[i].name, links[i].a, links[i].b, links[i].ratio});
}

/// Is the y of one a multiple of the other's?
bool multiples(const Contact& one, const Contact& other) {
  constexpr double ratio_rounding = 0x1p-50;
  for (const int end : {one.a, one.b})
    if (end != ground && end != other.a && end != other.b) return false;
  for (const int end : {other.a, other.b})
    if (end != ground && end != one.a && end != one.b) return false;
  const int i = one.a == ground ? one.b : one.a, j = one.a == ground ? one.a : one.b;
  const double left = share(one, i) * share(other, j), right = share(one, j) * share(other, i);
  return std::abs(left - right) <= ratio_rounding * std::abs(left);
}

}  // namespace

std::optional<Fault> first_ratio_fault(const Model& model) {
  for (const Found& found :
       {of_links("spring", model.springs), of_links("damper", model.dampers), of_links("friction", model.frictions),
        of_links("stop", model.stops), of_links("compliant_stop", model.compliant_stops),
        of_links("characteristic", model.characteristics)})
    if (found) return found;
  std::vector<Contact> all;
  add(all, "friction", model.frictions);
  add(all, "stop", model.stops);
  add(all, "compliant_stop", model.compliant_stops);
  add(all, "characteristic", model.characteristics);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (same_pair(all[i], all[j]) == 0 && multiples(all[i], all[j]))
        return Fault{all[i].kind, all[i].index, "ratio",
                     "the ratio is a multiple of that of " + in_quotes(*all[j].name) +
                         ", which is between the same ends: give both one ratio, and multiply lengths and forces"};
  return std::nullopt;
}

}  // namespace slapstick
