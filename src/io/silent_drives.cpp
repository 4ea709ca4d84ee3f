/// Leaves out of a model what drives it by nothing: forces whose size the file writes as 0, and signals without use.
///
/// Only what is 0 at all values of the parameters counts. So all models of a family, and their derivatives, have the
/// same forces and signals, also where a parameter happens to be 0.
#include <algorithm>

#include "base/ranges.hpp"
#include "io/model_builder.hpp"

namespace slapstick {

bool ModelBuilder::always_zero(const Scalar& scalar) {
  if (!scalar.expression) return scalar.number == 0.0;
  return scalar.expression->names().empty() && scalar.expression->value({}) == 0.0;
}

bool ModelBuilder::always_zero(const Part& part, std::string_view key) {
  const auto found = part.fields.find(key);
  return found != part.fields.end() && always_zero(found->second);
}

bool ModelBuilder::silent_signal(int index) const {
  if (index < 0 || index >= static_cast<int>(definition_.of("signal").size())) return false;  // none, or of an impulse
  const Part& part = definition_.of("signal")[static_cast<std::size_t>(index)];
  return ranges::all_of(part.samples, [](const auto& sample) { return sample.second == 0.0; }) &&
         ranges::all_of(part.points, [](const Point& point) { return always_zero(point.force); }) &&
         (!part.texts.contains("shape") || (always_zero(part, "low") && always_zero(part, "high")));
}

void ModelBuilder::add_force(Model& model, const Force& force, bool silent) {
  origins_["force"].push_back({kind_, index_});
  silent_.push_back(silent || silent_signal(force.signal));
  model.forces.push_back(force);
}

namespace {

/// The numbers that the things which stay have then.
std::vector<int> numbers_of(const std::vector<bool>& stays) {
  std::vector<int> numbers(stays.size() + 1, 0);
  for (std::size_t i = 0; i < stays.size(); ++i) numbers[i + 1] = numbers[i] + (stays[i] ? 1 : 0);
  return numbers;
}

template <class Thing>
void keep(std::vector<Thing>& things, const std::vector<bool>& stays) {
  std::vector<Thing> kept;
  for (std::size_t i = 0; i < things.size(); ++i)
    if (stays[i]) kept.push_back(std::move(things[i]));
  things = std::move(kept);
}

}  // namespace

bool ModelBuilder::leave_out_silent(Model& model) {
  if (model.signals.empty() && std::find(silent_.begin(), silent_.end(), true) == silent_.end()) return false;
  std::vector<bool> stays(silent_);
  stays.flip();
  const std::vector<int> force_at = numbers_of(stays);
  keep(model.forces, stays);
  keep(origins_["force"], stays);
  const auto renumber = [&](BaseMotion& motion) {
    const auto first = static_cast<std::size_t>(motion.first), end = first + static_cast<std::size_t>(motion.count);
    motion = {force_at[first], force_at[end] - force_at[first]};
  };
  for (Spring& spring : model.springs) renumber(spring.motion);
  for (Damper& damper : model.dampers) renumber(damper.motion);

  std::vector<bool> used(model.signals.size(), false);
  for (const Force& force : model.forces)
    if (force.signal >= 0) used[static_cast<std::size_t>(force.signal)] = true;
  for (const auto& base : bases_)  // an observable may follow it, and looks at its points
    for (const Term& term : base)
      if (term.signal >= 0) used[static_cast<std::size_t>(term.signal)] = true;
  const std::vector<int> signal_at = numbers_of(used);
  keep(model.signals, used);
  keep(origins_["signal"], used);
  for (Force& force : model.forces)
    if (force.signal >= 0) force.signal = signal_at[static_cast<std::size_t>(force.signal)];
  return true;
}

}  // namespace slapstick
