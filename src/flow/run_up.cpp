/// Steps a parameter from whole periods to whole periods.
#include "slapstick/flow/run_up.hpp"

#include "slapstick/base/error.hpp"

namespace slapstick {

RunUp::RunUp(std::function<Model(double)> model, const RunUpOptions& options, State start)
    : model_(std::move(model)), options_(options), start_(std::move(start)) {
  if (options.steps < 2) throw InputError("steps = " + std::to_string(options.steps) + " is less than 2");
  if (options.hold < 1) throw InputError("hold = " + std::to_string(options.hold) + " is less than 1");
}

bool RunUp::next() {
  if (motion_) {
    begun_ = time(end());
    start_ = motion_->state();
  }
  if (step_ == options_.steps) return false;
  const double part = static_cast<double>(step_) / static_cast<double>(options_.steps - 1);
  value_ = step_ + 1 == options_.steps ? options_.to : options_.from + part * (options_.to - options_.from);
  motion_.emplace(System(model_(value_)), start_);
  ++step_;
  return true;
}

}  // namespace slapstick
