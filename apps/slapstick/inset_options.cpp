/// Reads what a picture shows enlarged.
#include "inset_options.hpp"

#include "base/ranges.hpp"
#include "base/text.hpp"
#include "model_options.hpp"
#include "orbit_options.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::app {
namespace {

const std::string argument = "--inset";

void check_within(const std::string& text, const NamedAxis& axis, const figure::Range& wanted) {
  if (!axis.range || (wanted.min >= axis.range->min && wanted.max <= axis.range->max)) return;
  throw InputError(argument + ": " + in_quotes(text) + " leaves the picture, in which " + in_quotes(axis.name) +
                   " runs from " + shown(axis.range->min) + " to " + shown(axis.range->max));
}

std::string names_of(const std::vector<NamedAxis>& axes) {
  std::string all;
  for (const NamedAxis& axis : axes) all += (all.empty() ? "" : " or ") + in_quotes(axis.name);
  return all;
}

NamedInset read_inset(const std::string& text, const NamedAxis& x, const std::vector<NamedAxis>& y) {
  const std::vector<std::string> parts = split(text, ',');
  if (parts.size() != 2) throw InputError(argument + ": " + in_quotes(text) + " is not of the form X=A:B,Y=A:B");
  NamedInset found;
  int given_x = 0, given_y = 0;
  for (const std::string& part : parts) {
    const auto [name, range] = name_and_text(argument, part, "NAME=A:B");
    const ParameterRange wanted = parse_range(argument + " " + name, range);
    const bool is_x = name == x.name;
    const auto axis = ranges::find(y, name, &NamedAxis::name);
    if (!is_x && axis == y.end())
      throw InputError(argument + ": " + in_quotes(name) + " is no axis of the picture; give " + in_quotes(x.name) +
                       " and " + names_of(y));
    (is_x ? found.inset.x : found.inset.y) = {wanted.from, wanted.to};
    if (!is_x) found.y = name;
    ++(is_x ? given_x : given_y);
    check_within(text, is_x ? x : *axis, {wanted.from, wanted.to});
  }
  if (given_x != 1 || given_y != 1)
    throw InputError(argument + ": " + in_quotes(text) + " needs a range of " + in_quotes(x.name) + " and one of " +
                     names_of(y));
  return found;
}

}  // namespace

void InsetOptions::declare(Arguments& arguments) {
  arguments
      .repeated(argument, texts, "X=A:B,Y=A:B",
                "show this rectangle of the axes enlarged, in the corner where it hides least; may be repeated, up to "
                "four in a panel")
      .with({"--plot"});
}

std::vector<NamedInset> read_insets(const InsetOptions& options, const NamedAxis& x, const std::vector<NamedAxis>& y) {
  std::vector<NamedInset> all;
  for (const std::string& text : options.texts) all.push_back(read_inset(text, x, y));
  for (const NamedInset& one : all)
    if (ranges::count_if(all, [&](const NamedInset& other) { return other.y == one.y; }) >
        static_cast<std::ptrdiff_t>(figure::most_insets))
      throw InputError(argument + ": a panel has at most four insets");
  return all;
}

void add_insets(const std::vector<NamedInset>& insets, const std::vector<std::string>& y, figure::Figure& figure) {
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
    for (const NamedInset& one : insets)
      if (one.y == y[y.size() == 1 ? 0 : i]) figure.panels[i].insets.push_back(one.inset);
}

}  // namespace slapstick::app
