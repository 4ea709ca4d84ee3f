#pragma once
/// What a model with [scale] calculates with: its own numbers, which have no unit. A parameter that names a unit holds
/// a number of that unit instead, and an expression has to divide it by what 1 is. One that forgets would be wrong
/// without a word.
///
/// Found by measuring the parameters in another unit of length, time or mass: a number of the model does not change.
/// The other units are 2^12 times smaller, so that sums, products and the usual roots scale exactly, however much
/// cancels in them.
#include <array>
#include <optional>
#include <vector>

#include "io/model_builder.hpp"

namespace slapstick {

class ModelNumbers {
 public:
  /// @param values     of all parameters
  /// @param overrides  those of them that were set (groups resolved)
  ModelNumbers(const Definition& definition, const Values& values, const Overrides& overrides);

  /// That an expression of parameters is a number of the model. @throws InputError with the reason only
  void demand(const Expression& expression) const;
  /// That a parameter's expression, a scale and an observable are in the unit that they name. @throws InputError with
  /// the file's line
  void check() const;

 private:
  using Powers = std::array<int, 3>;  // of length, time, mass
  struct View {
    std::size_t dimension;
    bool scaled;  // 1 is not the unit itself: a number of the model is not the number in the unit
    Values values;
  };

  double measured(const std::string& name, View& view) const;
  [[nodiscard]] bool without_unit(const Powers& powers) const;
  [[nodiscard]] std::optional<Powers> powers(const Expression& expression, const Values& others) const;
  [[nodiscard]] std::string with_units(const Expression& expression) const;
  void demand(const Expression& expression, const Values& others) const;
  void demand_unit(const Scalar& scalar, const Powers& wanted, const std::string& unit, const std::string& where) const;
  void check_observable(const Part& part) const;

  const Definition& definition_;
  const Values& values_;
  const Overrides& overrides_;
  std::vector<View> views_;
};

}  // namespace slapstick
