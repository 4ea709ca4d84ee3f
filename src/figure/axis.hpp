#pragma once
/// One axis: its range, its ticks and how much room their numbers take.
#include <string>
#include <vector>

#include "figure/figure.hpp"

namespace slapstick::figure {

struct Axis {
  Range range{};
  bool log = false;
  double step = 0;              ///< between numbered ticks; logarithmic: a factor, 0 lets gnuplot choose
  std::vector<double> ticks{};  ///< instead of steps, on a logarithmic axis of less than two decades
  int minor = 1;                ///< intervals between numbered ticks
  std::string format = "%g";    ///< of the numbers, in gnuplot's notation
  double label_em = 0;          ///< width of the widest number

  double place(double value) const;  ///< 0 at the lower end, 1 at the upper
  bool shows(double value) const { return value >= range.min && value <= range.max; }  ///< false for NaN
};

/// Can the value be drawn at all?
bool drawable(double value, bool log);

/// The smallest and largest drawable value seen, in one pass over any number of columns.
struct Extent {
  double min = std::numeric_limits<double>::infinity(), max = -min;
  bool one_way = true;  ///< every column ran in one direction
  void add(const std::vector<double>& column, bool log);
  bool empty() const { return !(min <= max); }
};

/// The range to show: the extent and `padding` (a share of it) on both sides. Nothing seen gives [0, 1] or [1, 10];
/// a constant gives a range around it.
Range padded(const Extent& extent, double padding, bool log);

/// Is a range wide enough to be numbered (in double precision and in print)?
bool resolvable(Range range);

/// Numbers need air: between two of them most of a label's width (or a line of height) is free.
int most_labels(double length_cm, double label_cm);

/// Ticks at round numbers such that at most `most` labels stand on the axis (at least two where possible).
Axis with_ticks(Range range, bool log, int most);

}  // namespace slapstick::figure
