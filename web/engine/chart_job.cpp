/// Classifies the pixels of a chart.
#include "chart_job.hpp"

#include "slapstick/attractor/classify.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/sweep/diagram.hpp"

namespace slapstick::web {

ChartJob::ChartJob(const Choice& choice, const ChartWish& wish) : choice_(choice), wish_(wish) { width_ = 6; }

bool ChartJob::work(const Deadline& deadline) {
  for (; next_ < wish_.pixels.size(); ++next_) {
    if (deadline.passed()) return false;
    run_pixel(wish_.pixels[next_] % wish_.columns, wish_.pixels[next_] / wish_.columns);
  }
  return true;
}

void ChartJob::run_pixel(int column, int row) {
  const Overrides at{{wish_.x, sweep::sweep_value(wish_.x_from, wish_.x_to, wish_.columns, column)},
                     {wish_.y, sweep::sweep_value(wish_.y_from, wish_.y_to, wish_.rows, row)}};
  double kind = -1.0, n = 0.0, p = 0.0, sticking = 0.0;
  try {
    const Classification found =
        classify_quickly(System(choice_.model(at)), choice_.start_at(at), wish_.periods, {.exponent_periods = 0});
    kind = static_cast<double>(found.attractor);
    n = found.n;
    p = found.chatter == Chatter::complete ? -1.0 : static_cast<double>(found.p);
    sticking = found.sticking ? 1.0 : 0.0;
  } catch (const NumericalError&) {
  } catch (const InputError&) {
  }
  rows_.insert(rows_.end(), {static_cast<double>(column), static_cast<double>(row), kind, n, p, sticking});
}

}  // namespace slapstick::web
