#pragma once
/// The [[observable]]s of a model file along a motion.
#include <memory>
#include <vector>

#include "slapstick/io/model_file.hpp"

namespace slapstick {

/// Computes the observables of one model with one set of parameter values. Movable; not for several threads at once.
class Observer {
 public:
  ~Observer();
  Observer(Observer&&) noexcept;
  Observer& operator=(Observer&&) noexcept;

  /// Every observable's value, in the order of ModelDefinition::observables. Where an expression has no finite value
  /// (1 / x1 at x1 = 0) it is inf or nan: that is a property of the state, not a mistake in the file.
  /// @param time  in the model's unit of time, from the start of the run
  /// @return valid until the next call
  [[nodiscard]] const std::vector<double>& read(double time, const State& state);

 private:
  friend class ModelDefinition;
  struct Parts;
  explicit Observer(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace slapstick
