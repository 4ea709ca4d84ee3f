#pragma once
/// The picture of `simulate`: phase portrait of the relative motion, and its time series, with the stops of the pair.
#include "axis_units.hpp"
#include "relative_motion.hpp"
#include "figure/figure.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::app {

class MotionPlot {
 public:
  MotionPlot(RelativeMotion relative, const AxisUnits& units, bool forced)
      : relative_(std::move(relative)),
        displacement_(with_unit(relative_.displacement, units.displacement(relative_.a, relative_.b))),
        velocity_(with_unit(relative_.velocity, units.velocity(relative_.a, relative_.b))),
        time_(forced ? "t / T" : with_unit("t", units.time())) {}

  /// The next sample. Soon after an event all are taken, so that short bounces are curves; later one in some.
  void add_sample(Instant time, const State& state) {
    if (++since_event_ <= dense || since_event_ % thinned == 0) add(time, state);
  }
  /// An event is two points, the states before and after.
  void add_event(const Motion& motion) {
    const auto before = motion.before();
    add(motion.event().time, State(before.begin(), before.end()));
    add(motion.event().time, motion.state());
    since_event_ = 0;
  }
  [[nodiscard]] bool empty() const { return t_.empty(); }
  [[nodiscard]] figure::Figure figure() const;

 private:
  static constexpr int dense = 40, thinned = 5;

  void add(Instant time, const State& state) {
    t_.push_back(time.seconds(1.0));
    y_.push_back(relative_.y(state));
    w_.push_back(relative_.w(state));
  }

  RelativeMotion relative_;
  std::string displacement_, velocity_, time_;  // the axes
  long since_event_ = 0;
  std::vector<double> t_, y_, w_;  // t in periods
};

}  // namespace slapstick::app
