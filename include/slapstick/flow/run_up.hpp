#pragma once
/// A run during which a parameter climbs: it is constant over some whole forcing periods, then steps, and so on.
///
///     RunUp run([&](double omega) { return definition.build({{"omega", omega}}); }, {1.0, 3.0, 400}, start);
///     while (run.next())
///       while (run.motion().advance(run.end()) == Outcome::event) use(run.time(run.motion().event().time));
///
/// The phase is continuous, because every step has whole periods; so is the state. Forces of a frequency of their own
/// keep their phases too, and signals go on at the run's time. A coordinate that is measured from a base keeps its
/// velocity relative to the base.
/// Cost: a System for every step. Threads: as a Motion's. Source: docs/reference/command_line.md, "Run-up".
#include <functional>
#include <optional>
#include <vector>

#include "slapstick/flow/motion.hpp"

namespace slapstick {

struct RunUpOptions {
  double from = 0.0, to = 0.0;
  long steps = 2;  ///< values, the first and the last included; at least 2
  long hold = 1;   ///< forcing periods at each
  /// Values in equal ratios: as many in each octave, as a logarithmic sweep has. Else in equal differences.
  bool logarithmic = false;
};

class RunUp {
 public:
  /// @param model  of a value
  /// @throws InputError for fewer than two steps or less than one period, and for a logarithmic sweep through zero
  RunUp(std::function<Model(double)> model, const RunUpOptions& options, State start);

  /// Goes on to the next value, once the motion has come to `end`. @returns false after the last one
  /// @throws InputError as System and Motion
  bool next();

  [[nodiscard]] double value() const { return value_; }
  [[nodiscard]] Motion& motion() { return *motion_; }
  /// Of the step, on the step's own clock.
  [[nodiscard]] Instant end() const { return {options_.hold, 0.0}; }
  /// Of an instant of the step, from the beginning of the run, in the model's unit of time.
  [[nodiscard]] double time(Instant instant) const { return begun_ + instant.seconds(motion_->system().period()); }

 private:
  void end_step();
  [[nodiscard]] Model continued(Model model) const;

  std::function<Model(double)> model_;
  RunUpOptions options_;
  State start_;
  std::optional<Motion> motion_;
  std::vector<double> turns_;  ///< that each force of a frequency of its own has made so far, less the whole ones
  double value_ = 0.0, begun_ = 0.0;
  long step_ = 0;
};

}  // namespace slapstick
