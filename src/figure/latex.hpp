#pragma once
/// Text in gnuplot's enhanced notation as other programs take it.
#include <string>
#include <string_view>

#include "figure/figure.hpp"

namespace slapstick::figure {

enum class Dialect {
  latex,      ///< all signs by their commands, all else escaped
  matplotlib  ///< its mathtext between dollars; signs stay UTF-8
};

/// `{/:Italic x}_1` as `$\mathit{x}$$_{\mathrm{1}}$`; what is plain stays upright.
std::string translate(std::string_view enhanced, Dialect dialect);

/// A figure with all its texts in the dialect.
Figure translated(Figure figure, Dialect dialect);

/// A gnuplot number format of an axis in LaTeX's mathematics: "%.1f" as "$%.1f$".
std::string latex_format(const std::string& format);

}  // namespace slapstick::figure
