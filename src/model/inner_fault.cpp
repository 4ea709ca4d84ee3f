/// Finds what is wrong with inner coordinates, which have no mass.
#include <cmath>

#include <vector>

#include "base/text.hpp"
#include "model/fault.hpp"

namespace slapstick {
namespace {

using Found = std::optional<Fault>;

/// What acts on one inner coordinate beside its spring.
class Inner {
 public:
  Inner(const Model& model, int coordinate) : model_(model), coordinate_(coordinate) {}

  [[nodiscard]] Found fault() const {
    const Coordinate& own = model_.coordinates[static_cast<std::size_t>(coordinate_)];
    if (own.mass != 0.0)
      return Fault{"coordinate", coordinate_, "mass", "an inner coordinate has no mass, not " + shown(own.mass)};
    for (const Found& found : {links("spring", model_.springs), links("friction", model_.frictions),
                               links("stop", model_.stops), links("compliant_stop", model_.compliant_stops),
                               links("characteristic", model_.characteristics), forces(), matrices()})
      if (found) return found;
    return std::nullopt;
  }
  /// By dampers to ground alone, of which a slider has none.
  [[nodiscard]] Found damped(bool slider) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < model_.dampers.size(); ++i) {
      const Damper& damper = model_.dampers[i];
      if (damper.a != coordinate_ && damper.b != coordinate_) continue;
      const bool plain = damper.ratio == Ratio{} && damper.motion.none();
      if (slider || !plain || (damper.a != ground && damper.b != ground)) return other("damper", i, "between");
      sum += damper.coefficient;
    }
    if (slider || sum >= smallest) return std::nullopt;
    return Fault{"coordinate", coordinate_, "damping",
                 "the dampers of an inner coordinate add up to " + shown(sum) + ", which is not positive"};
  }

 private:
  [[nodiscard]] Fault other(const char* kind, std::size_t index, const char* field) const {
    return {kind, static_cast<int>(index), field,
            in_quotes(model_.coordinates[static_cast<std::size_t>(coordinate_)].name) +
                " is an inner coordinate: its spring and dampers to ground alone act on it"};
  }
  template <class Links>
  [[nodiscard]] Found links(const char* kind, const Links& all) const {
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].a == coordinate_ || all[i].b == coordinate_) return other(kind, i, "between");
    return std::nullopt;
  }
  [[nodiscard]] Found forces() const {
    for (std::size_t i = 0; i < model_.forces.size(); ++i)
      if (model_.forces[i].presses < 0 && model_.forces[i].coordinate == coordinate_) return other("force", i, "on");
    for (std::size_t i = 0; i < model_.frictions.size(); ++i)
      for (const NormalForce::Term& term : model_.frictions[i].normal.value_or(NormalForce{}).terms)
        if (term.coordinate == coordinate_) return other("friction", i, "normal_force");
    return std::nullopt;
  }
  [[nodiscard]] Found matrices() const {
    const auto n = static_cast<std::size_t>(model_.size()), row = static_cast<std::size_t>(coordinate_);
    for (const auto& [field, entries] : {std::pair("mass", &model_.mass), std::pair("damping", &model_.damping),
                                         std::pair("stiffness", &model_.stiffness)})
      for (std::size_t j = 0; j < n && entries->size() == n * n; ++j)
        if ((*entries)[row * n + j] != 0.0) return Fault{"matrix", -1, field, other("", 0, "").what};
    return std::nullopt;
  }
  const Model& model_;
  int coordinate_;
};

}  // namespace

std::optional<Fault> first_inner_fault(const Model& model) {
  std::vector<int> used;
  const auto fault_of = [&](const char* kind, std::size_t index, int inner) -> Found {
    const auto fault = [&](std::string what) {
      return Fault{kind, static_cast<int>(index), "between", std::move(what)};
    };
    if (inner < 0 || inner >= model.size()) return fault("there is no inner coordinate " + std::to_string(inner));
    for (const int other : used)
      if (other == inner) return fault("two elements have one inner coordinate");
    used.push_back(inner);
    return Inner(model, inner).fault();
  };
  for (std::size_t i = 0; i < model.springs.size(); ++i) {
    const Spring& spring = model.springs[i];
    if (spring.inner == -1) continue;
    if (!(spring.stiffness >= smallest))
      return Fault{"spring", static_cast<int>(i), "stiffness",
                   "stiffness = " + shown(spring.stiffness) + " is not positive"};
    if (!spring.motion.none())
      return Fault{"spring", static_cast<int>(i), "between",
                   "a spring with an inner coordinate is on no base that moves"};
    if (auto found = fault_of("spring", i, spring.inner)) return found;
    if (auto found = Inner(model, spring.inner).damped(false)) return found;
  }
  for (std::size_t i = 0; i < model.characteristics.size(); ++i) {
    const Characteristic& one_of = model.characteristics[i];
    if (one_of.inner == -1) continue;
    const bool plain = one_of.over == Characteristic::Over::displacement && one_of.corners.size() == 2 &&
                       one_of.slope_below == 0.0 && one_of.slope_above == 0.0 &&
                       one_of.corners[1].force > one_of.corners[0].force;
    if (!plain)
      return Fault{
          "characteristic", static_cast<int>(i), "characteristic",
          "one with an inner coordinate is over the displacement, rises between two corners and is flat outside"};
    if (auto found = fault_of("characteristic", i, one_of.inner)) return found;
    if (auto found = Inner(model, one_of.inner).damped(true)) return found;
  }
  return std::nullopt;
}

}  // namespace slapstick
