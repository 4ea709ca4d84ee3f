/// Says markers and lines in gnuplot's words.
#include "style.hpp"

#include "text.hpp"

namespace slapstick::figure {
namespace {

std::string dash_type(Dash dash) {
  switch (dash) {
    case Dash::dashed:
      return "(8,4)";
    case Dash::dotted:
      return "(1.5,2)";
    case Dash::dash_dotted:
      return "(7,2.5,1.5,2.5)";
    case Dash::solid:
      break;
  }
  return "solid";
}

constexpr double pointsize_mm = 2.15;  // diameter of gnuplot's disc (pt 7) at pointsize 1, measured

/// gnuplot's number of a marker's shape, and how large it draws it beside the disc.
struct Shape {
  int type;
  double size;
};

Shape shape(Marker marker) {
  switch (marker) {
    case Marker::square:
      return {5, 0.85};
    case Marker::triangle:
      return {9, 1.1};
    case Marker::diamond:
      return {13, 1.1};
    case Marker::star:
      return {3, 1.1};
    case Marker::circle:
      return {6, 1.0};
    case Marker::box:
      return {4, 0.85};
    case Marker::delta:
      return {8, 1.1};
    case Marker::nabla:
      return {10, 1.1};
    case Marker::cross:
      return {2, 0.85};
    case Marker::disc:
      break;
  }
  return {7, 1.0};
}

}  // namespace

std::string point_style(Marker marker, double diameter_mm, Colour colour) {
  const Shape drawn = shape(marker);
  return "pt " + std::to_string(drawn.type) + " ps " + number(drawn.size * diameter_mm / pointsize_mm) +
         " lw 0.6 lc rgb " + quote_colour(colour);
}

std::string line_style(double width_pt, Dash dash, Colour colour) {
  return "lw " + number(width_pt) + " dt " + dash_type(dash) + " lc rgb " + quote_colour(colour);
}

}  // namespace slapstick::figure
