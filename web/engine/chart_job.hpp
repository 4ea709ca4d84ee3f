#pragma once
/// Pixels of a chart: what the motion is at each of them, by a short classification. Which pixels are due, and in what
/// order, is the page's affair (web/src/pixels.ts).
///
/// Rows: index of the pixel in the first parameter, in the second, what it is (`Attractor`; -1 where it failed), n, p
/// (-1 with a complete chatter), sticking.
/// A pixel starts at the choice's start, so it depends on itself only, as `slapstick map --start reset`.
#include "choice.hpp"
#include "job.hpp"

namespace slapstick::web {

struct ChartWish {
  std::string x, y;  ///< the parameters
  double x_from = 0.0, x_to = 1.0, y_from = 0.0, y_to = 1.0;
  int columns = 2, rows = 2;  ///< of the whole chart
  std::vector<int> pixels;    ///< numbered row by row
  int periods = 100;          ///< a pixel
};

class ChartJob : public Job {
 public:
  ChartJob(const Choice& choice, const ChartWish& wish);

 protected:
  bool work(const Deadline& deadline) override;

 private:
  void run_pixel(int column, int row);

  Choice choice_;
  ChartWish wish_;
  std::size_t next_ = 0;
};

}  // namespace slapstick::web
