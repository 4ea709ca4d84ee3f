#pragma once
/// A model that depends on parameters: what orbits are continued in.
///
/// `ModelDefinition::family` (io/model_file.hpp) makes one of a model file; one may also be made by hand.
/// Threads: the library calls both functions from one thread at a time, diagrams apart. Cost: a call for every step of
/// Newton's method.
#include <functional>
#include <string>
#include <vector>

#include "slapstick/model/model.hpp"

namespace slapstick {

/// Both functions may throw an InputError where there is no model, or none that is differentiable.
struct Family {
  std::vector<std::string> names;  ///< of the parameters
  std::function<Model(const std::vector<double>& values)> model;
  /// The derivative of the model with respect to one parameter: a Model of the same shape, in which every number is
  /// that number's derivative (names, indices, harmonics and the impact law as in the model). Of a group: when its
  /// members move together.
  std::function<Model(const std::vector<double>& values, std::size_t which)> rate;
};

/// A model that depends on nothing.
[[nodiscard]] inline Family constant_family(const Model& model) {
  return {{}, [model](const std::vector<double>&) { return model; }, {}};
}

}  // namespace slapstick
