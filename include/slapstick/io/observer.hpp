#pragma once
/// The [[observable]]s of a model file along a motion.
///
/// Expressions that name quantities need their values beside the state: quantity/observables.hpp reads both.
#include <memory>
#include <vector>

#include "slapstick/io/model_file.hpp"
#include "slapstick/model/quantity.hpp"

namespace slapstick {

/// Computes the observables of one model with one set of parameter values. Movable; not for several threads at once.
class Observer {
 public:
  ~Observer();
  Observer(Observer&&) noexcept;
  Observer& operator=(Observer&&) noexcept;

  /// The quantities that expressions name besides the state and gaps, in the order of `read`.
  [[nodiscard]] const std::vector<Quantity>& quantities() const;

  /// Every observable's value, in the order of ModelDefinition::observables. Where an expression has no finite value
  /// (1 / x1 at x1 = 0) it is inf or nan: that is a property of the state, not a mistake in the file.
  /// @param time  in the model's unit of time, from the start of the run
  /// @param numbers  of `quantities`
  /// @return valid until the next call
  /// @throws InputError unless there are as many numbers as quantities
  [[nodiscard]] const std::vector<double>& read(double time, const State& state,
                                                const std::vector<double>& numbers = {});

 private:
  friend class ModelDefinition;
  struct Parts;
  explicit Observer(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace slapstick
