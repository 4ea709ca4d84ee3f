/// Places insets: in which corner, how large, and which lines join them to what they show.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/ranges.hpp"
#include "layout.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::figure {
namespace {

/// of the frame, by preference: an inset with its numbers
constexpr std::array<double, 4> shares{0.46, 0.4, 0.33, 0.26};
constexpr double gap_em = 0.7;  ///< to the frame: its ticks stay free

bool overlap(const Box& a, const Box& b) {
  return a.left < b.right && b.left < a.right && a.bottom < b.top && b.bottom < a.top;
}

/// What a panel shows of a rectangle.
Box source_box(const Inset& inset, const PanelLayout& layout, const std::string& where) {
  const auto share = [](const Axis& axis, double value) { return std::clamp(axis.place(value), 0.0, 1.0); };
  const Box& frame = layout.frame;
  const Box box{frame.left + share(layout.x, inset.x.min) * frame.width(),
                frame.left + share(layout.x, inset.x.max) * frame.width(),
                frame.bottom + share(layout.y, inset.y.min) * frame.height(),
                frame.bottom + share(layout.y, inset.y.max) * frame.height()};
  if (!(box.width() > 0.0 && box.height() > 0.0)) throw InputError(where + " shows nothing of its panel");
  return box;
}

/// How much of a panel a box hides: the share of a grid over the box in which there are points, lines, or cells beside
/// cells of another colour.
class Hidden {
 public:
  Hidden(const Panel& panel, const PanelLayout& layout, const Box& box) : taken_(grid * grid, false) {
    const auto value = [](const Axis& axis, double share) {
      return axis.range.min + share * (axis.range.max - axis.range.min);
    };
    const Box& frame = layout.frame;
    x_ = {value(layout.x, (box.left - frame.left) / frame.width()),
          value(layout.x, (box.right - frame.left) / frame.width())};
    y_ = {value(layout.y, (box.bottom - frame.bottom) / frame.height()),
          value(layout.y, (box.top - frame.bottom) / frame.height())};
    if (panel.cells) changes(*panel.cells);
    for (const Points& points : panel.points)
      for (std::size_t i = 0; i < points.x.size(); ++i) take(points.x[i], points.y[i]);
    for (const Line& line : panel.lines) along(line);
  }

  [[nodiscard]] std::ptrdiff_t count() const { return std::count(taken_.begin(), taken_.end(), true); }

 private:
  static constexpr int grid = 48;

  void take(double x, double y) {
    const double across = (x - x_.min) / (x_.max - x_.min) * grid, up = (y - y_.min) / (y_.max - y_.min) * grid;
    if (across >= 0.0 && across < grid && up >= 0.0 && up < grid)
      taken_[static_cast<std::size_t>(up) * grid + static_cast<std::size_t>(across)] = true;
  }

  void along(const Line& line) {
    constexpr int samples = 16;
    for (std::size_t i = 1; i < line.x.size(); ++i)
      for (int k = 0; k < samples; ++k) {
        const double f = static_cast<double>(k) / samples;
        take(line.x[i - 1] + f * (line.x[i] - line.x[i - 1]), line.y[i - 1] + f * (line.y[i] - line.y[i - 1]));
      }
  }

  void changes(const Cells& cells) {
    const auto place = [](double at, const Range& of, int count) {
      return std::clamp(static_cast<int>(std::floor((at - of.min) / (of.max - of.min) * count)), 0, count - 1);
    };
    const auto middle = [](int i, const Range& of, int count) {
      return of.min + (i + 0.5) / count * (of.max - of.min);
    };
    const int left = place(x_.min, cells.x, cells.columns), right = place(x_.max, cells.x, cells.columns);
    const int low = place(y_.min, cells.y, cells.rows), high = place(y_.max, cells.y, cells.rows);
    const auto code = [&](int i, int j) { return cells.codes[static_cast<std::size_t>(j) * cells.columns + i]; };
    for (int j = low; j <= high; ++j)
      for (int i = left; i <= right; ++i)
        if ((i < right && code(i, j) != code(i + 1, j)) || (j < high && code(i, j) != code(i, j + 1)))
          take(middle(i, cells.x, cells.columns), middle(j, cells.y, cells.rows));
  }

  std::vector<bool> taken_;
  Range x_{}, y_{};
};

/// Axes and boxes of an inset that takes a share of its panel's frame.
InsetLayout sized(const Inset& inset, const PanelLayout& panel, double em_cm, int corner, double share) {
  InsetLayout at{.right = corner % 2 == 1, .top = corner / 2 == 1};
  const Box& frame = panel.frame;
  const double gap = gap_em * em_cm, em = spacing::inset_font * em_cm;
  const double width = share * frame.width() - gap, height = share * frame.height() - gap;
  at.outer.left = at.right ? frame.right - gap - width : frame.left + gap;
  at.outer.bottom = at.top ? frame.top - gap - height : frame.bottom + gap;
  at.outer.right = at.outer.left + width;
  at.outer.top = at.outer.bottom + height;
  at.y = with_ticks(inset.y, false, std::clamp(static_cast<int>(height / (2.0 * em)), 2, 4));
  int labels = 4;
  do at.x = with_ticks(inset.x, false, labels);
  while (--labels >= 1 && most_labels(width, (at.x.label_em + 1.2) * em) <= labels);
  at.frame = at.outer;
  const double across = (at.y.label_em + 0.6) * em, up = 1.45 * em;
  (at.right ? at.frame.right : at.frame.left) += at.right ? -across : across;
  (at.top ? at.frame.top : at.frame.bottom) += at.top ? -up : up;
  Box across_numbers = at.outer, up_numbers = at.outer;  // the outermost numbers stand half beside the frame
  (at.top ? across_numbers.bottom : across_numbers.top) = at.top ? at.frame.top : at.frame.bottom;
  (at.right ? across_numbers.left : across_numbers.right) += (at.right ? -0.55 : 0.55) * at.x.label_em * em;
  (at.right ? up_numbers.left : up_numbers.right) = at.right ? at.frame.right : at.frame.left;
  (at.top ? up_numbers.bottom : up_numbers.top) += (at.top ? -0.65 : 0.65) * em;
  at.paper = {at.frame, across_numbers, up_numbers};
  return at;
}

/// The lines from corner to corner that do not cross either box: those with both boxes on one side.
std::vector<int> joined_corners(const Box& source, const Box& frame) {
  std::vector<int> joined;
  for (int corner = 0; corner < 4; ++corner) {
    const double x = corner_x(source, corner), y = corner_y(source, corner);
    const double dx = corner_x(frame, corner) - x, dy = corner_y(frame, corner) - y;
    int left = 0, right = 0;
    for (const Box* box : {&source, &frame})
      for (int other = 0; other < 4; ++other) {
        if (other == corner) continue;
        (dx * (corner_y(*box, other) - y) > dy * (corner_x(*box, other) - x) ? left : right) += 1;
      }
    if (left == 0 || right == 0) joined.push_back(corner);
  }
  return joined;
}

}  // namespace

std::vector<InsetLayout> place_insets(const Panel& panel, const PanelLayout& layout, double em_cm,
                                      const std::string& where) {
  std::vector<Box> sources;
  std::vector<InsetLayout> placed;
  const auto named = [&](std::size_t i) { return where + ", inset " + std::to_string(i + 1); };
  for (std::size_t i = 0; i < panel.insets.size(); ++i)
    sources.push_back(source_box(panel.insets[i], layout, named(i)));
  const auto fits = [&](const InsetLayout& at, const Box& source) {
    const bool larger = at.frame.width() > 0.0 && at.frame.height() > 0.0 &&
                        at.frame.width() * at.frame.height() > source.width() * source.height();
    return larger && ranges::none_of(sources, [&](const Box& other) { return overlap(at.outer, other); }) &&
           ranges::none_of(placed, [&](const InsetLayout& other) { return overlap(at.outer, other.outer); });
  };
  for (std::size_t i = 0; i < sources.size(); ++i) {
    std::optional<InsetLayout> best;
    std::ptrdiff_t least = 0;
    for (auto share = shares.begin(); share != shares.end() && !best; ++share)
      for (const int corner : {3, 2, 1, 0}) {
        const InsetLayout at = sized(panel.insets[i], layout, em_cm, corner, *share);
        if (!fits(at, sources[i])) continue;
        const std::ptrdiff_t hidden = Hidden(panel, layout, at.outer).count();
        if (best && hidden >= least) continue;
        best = at;
        least = hidden;
      }
    if (!best)
      throw InputError(named(i) +
                       " finds no corner in which it is larger than what it shows; ask for a smaller rectangle");
    best->source = sources[i];
    best->joined = joined_corners(best->source, best->frame);
    placed.push_back(*best);
  }
  return placed;
}

}  // namespace slapstick::figure
