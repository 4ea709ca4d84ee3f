#pragma once
/// A model that depends on parameters: what orbits are continued in.
#include <functional>
#include <string>
#include <vector>

#include "slapstick/model/model.hpp"

namespace slapstick {

/// Both functions may throw an InputError where there is no model, or none that is differentiable.
struct Family {
  std::vector<std::string> names;  ///< of the parameters
  std::function<Model(const std::vector<double>& values)> model;
  /// The derivative of the model with respect to one parameter: every number of it is that number's derivative.
  std::function<Model(const std::vector<double>& values, std::size_t which)> rate;
};

/// A model that depends on nothing.
[[nodiscard]] inline Family constant_family(const Model& model) {
  return {{}, [model](const std::vector<double>&) { return model; }, {}};
}

}  // namespace slapstick
