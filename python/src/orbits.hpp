#pragma once
/// Orbits as Python keeps them: with the model, the values and the equations that they solve.
#include <memory>

#include "bind.hpp"
#include "chosen.hpp"
#include "slapstick/continuation/branch.hpp"
#include "slapstick/orbit/find.hpp"
#include "watch.hpp"

namespace slapstick::python {

/// A model whose orbits are a function of some of its parameters.
struct Setting {
  ModelDefinition definition;
  Overrides values;                ///< of the others too
  std::vector<std::string> names;  ///< of the parameters that orbits have values of
  System system;                   ///< at some values: what names contacts and modes
  std::shared_ptr<const orbit::Problem> problem;
};
using SharedSetting = std::shared_ptr<const Setting>;

/// @param at  of the parameters `names`. @throws InputError
[[nodiscard]] SharedSetting setting(const ModelDefinition& definition, const Overrides& values,
                                    const std::vector<std::string>& names, const std::vector<double>& at);

struct FoundOrbit {
  SharedSetting setting;
  orbit::Solution solution;
  bool settles = false;  ///< the motion settles on it

  /// All values that the orbit is one of.
  [[nodiscard]] Overrides values() const;
};

/// The orbit that is meant. @throws InputError, NumericalError saying what was tried and found instead
[[nodiscard]] FoundOrbit find_orbit(SharedSetting of, const State& start, const orbit::OrbitWish& wish,
                                    const std::atomic<bool>* stop);

}  // namespace slapstick::python
