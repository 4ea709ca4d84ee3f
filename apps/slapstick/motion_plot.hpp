#pragma once
/// The picture of `simulate`: phase portrait of the relative motion, and its time series.
#include "model_options.hpp"
#include "slapstick/base/clock.hpp"
#include "slapstick/figure/figure.hpp"
#include "slapstick/flow/system.hpp"

namespace slapstick::app {

class MotionPlot {
 public:
  explicit MotionPlot(const System& system) : relative_(system.model()), forced_(system.model().forced()) {}

  /// The next point of the curve; an event adds two, the states before and after.
  void add(Instant time, const State& state) {
    t_.push_back(time.seconds(1.0));
    y_.push_back(relative_.y(state));
    w_.push_back(relative_.w(state));
  }
  [[nodiscard]] bool empty() const { return t_.empty(); }
  [[nodiscard]] figure::Figure figure() const;

 private:
  RelativeMotion relative_;
  bool forced_;
  std::vector<double> t_, y_, w_;  // t in periods
};

}  // namespace slapstick::app
