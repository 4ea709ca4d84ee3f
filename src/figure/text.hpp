#pragma once
/// Text for gnuplot: quoting, numbers, and how wide a label will be.
#include <string>
#include <string_view>

#include "figure/figure.hpp"

namespace slapstick::figure {

/// A single-quoted gnuplot string, in which gnuplot substitutes nothing. Control characters become spaces; an
/// apostrophe becomes the typographic one, because gnuplot 5.4 takes the escaped one at the start of a string for its
/// end.
std::string quote(std::string_view text);

/// A file of the script's own folder as a gnuplot string. The leading ./ keeps gnuplot from taking "<x" or "|x" for a
/// command (and the name from starting with an apostrophe). Control characters are the caller's to refuse.
std::string quote_file(const std::string& name);

/// Shortest decimal that reads back as the same double.
std::string number(double value);

/// With that many decimals; a point whatever the locale.
std::string fixed(double value, int decimals);

/// '#rrggbb', quoted.
std::string quote_colour(Colour colour);

/// Width of an enhanced-notation text in em, a slight overestimate for DejaVu Sans.
double width_em(std::string_view text);

}  // namespace slapstick::figure
