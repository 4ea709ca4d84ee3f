/// Steps a parameter from whole periods to whole periods.
#include "slapstick/flow/run_up.hpp"

#include <cmath>
#include <numbers>

#include "base/elementary.hpp"
#include "base/text.hpp"
#include "mode/drive.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {

RunUp::RunUp(std::function<Model(double)> model, const RunUpOptions& options, State start)
    : model_(std::move(model)), options_(options), start_(std::move(start)) {
  if (options.steps < 2) throw InputError("steps = " + std::to_string(options.steps) + " is less than 2");
  if (options.hold < 1) throw InputError("hold = " + std::to_string(options.hold) + " is less than 1");
  if (options.logarithmic && !(options.from * options.to > 0.0))
    throw InputError("no equal ratios lead from " + shown(options.from) + " to " + shown(options.to) +
                     ": both ends of a logarithmic sweep have one sign, and neither is 0");
}

/// Takes the state, the time and the phases from the step that is over.
void RunUp::end_step() {
  const Model& model = motion_->system().model();
  const double period = motion_->system().period();
  turns_.resize(model.forces.size(), 0.0);
  for (std::size_t i = 0; i < turns_.size(); ++i) {
    if (model.forces[i].frequency == 0.0) continue;
    turns_[i] += mode::Tone(model.forces[i].frequency, period).at(end());
    turns_[i] -= std::nearbyint(turns_[i]);
  }
  begun_ = time(end());
  start_ = motion_->state();
}

/// The model on the clock of a step, which shows 0 where the run's shows `begun_`.
Model RunUp::continued(Model model) const {
  if (turns_.size() == model.forces.size())
    for (std::size_t i = 0; i < turns_.size(); ++i) model.forces[i].phase += 2.0 * std::numbers::pi * turns_[i];
  for (Signal& signal : model.signals)
    for (Signal::Knot& knot : signal.knots) knot.time -= signal.in_periods ? 0.0 : begun_;
  return model;
}

bool RunUp::next() {
  if (motion_) end_step();
  if (step_ == options_.steps) return false;
  const double part = static_cast<double>(step_) / static_cast<double>(options_.steps - 1);
  value_ = step_ + 1 == options_.steps ? options_.to
           : options_.logarithmic      ? options_.from * fixed::power(options_.to / options_.from, part)
                                       : options_.from + part * (options_.to - options_.from);
  motion_.emplace(System(continued(model_(value_))), start_);
  ++step_;
  return true;
}

}  // namespace slapstick
