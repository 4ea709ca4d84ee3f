#pragma once
/// --inset X=A:B,Y=A:B: what a picture shows enlarged.
#include <optional>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "figure/figure.hpp"

namespace slapstick::app {

/// The name of an axis as users write it, and its range if the range is known before the work.
struct NamedAxis {
  std::string name;
  std::optional<figure::Range> range{};
};

struct InsetOptions {
  std::vector<std::string> texts;

  void declare(Arguments& arguments);
};

/// An inset for each panel whose y axis has this name.
struct NamedInset {
  figure::Inset inset;
  std::string y;
};

/// Reads `options`: the x axis and one of the y axes, in either order.
/// @throws InputError naming --inset, also for a rectangle outside of a range
[[nodiscard]] std::vector<NamedInset> read_insets(const InsetOptions& options, const NamedAxis& x,
                                                  const std::vector<NamedAxis>& y);

/// Gives each panel its insets. @param y  the name of the y axis of each panel, or one for all
void add_insets(const std::vector<NamedInset>& insets, const std::vector<std::string>& y, figure::Figure& figure);

}  // namespace slapstick::app
