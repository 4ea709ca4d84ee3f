/// Writes the gaps, velocities, forces and powers of contacts as polynomials in the extended state.
#include <algorithm>

#include "mode/contact_force.hpp"
#include "quantity/formula.hpp"

namespace slapstick::quantity {

using mode::CompliantState;
using mode::FrictionState;
using mode::StopState;

Formulas::Formulas(const Model& model, const mode::Frame& frame, const mode::Outline& outline)
    : model_(model), frame_(frame), outline_(outline), held_(mode::held_pairs(frame, outline.states)) {
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const RowVector limit = mode::friction_limit(held_[k], model, frame, outline.states);
    for (const double side : {1.0, -1.0}) {
      const bool stopped = std::any_of(held_[k].stops.begin(), held_[k].stops.end(), [&](int i) {
        return sense(held_[k], frame.stops[static_cast<std::size_t>(i)]) == side;
      });
      if (!stopped) continue;
      kink_of_.push_back({k, side});
      kinks_.push_back(side * outline.holding.row(static_cast<Eigen::Index>(k)) - limit);
    }
  }
}

/// +1 or -1: the sense of a contact along the displacement of its pair.
double Formulas::sense(const mode::HeldPair& pair, const mode::ContactRow& contact) const {
  return contact.sign * frame_.parallel(pair.displacement, contact.own);
}

/// +1 or -1 where f0 of a pair is beyond its friction on a side that a stop is on, else 0.
double Formulas::beyond(std::size_t pair, const std::vector<bool>& above) const {
  for (std::size_t k = 0; k < kink_of_.size(); ++k)
    if (kink_of_[k].pair == pair && above[k]) return kink_of_[k].side;
  return 0.0;
}

RowVector Formulas::relative(int contact) const {
  if (contact < stops()) return frame_.velocity_row(frame_.stops[static_cast<std::size_t>(contact)]);
  contact -= stops();
  if (contact < frictions()) return frame_.velocity_row(frame_.frictions[static_cast<std::size_t>(contact)]);
  contact -= frictions();
  if (contact < compliants()) return frame_.velocity_row(frame_.compliant[static_cast<std::size_t>(contact)]);
  return frame_.characteristics[static_cast<std::size_t>(contact - compliants())].velocity;
}

RowVector Formulas::gap(int contact) const {
  if (contact < stops()) return frame_.gap_row(frame_.stops[static_cast<std::size_t>(contact)]);
  return frame_.gap_row(frame_.compliant[static_cast<std::size_t>(contact - stops() - frictions())]);
}

/// What f0 is beyond the friction of the pair, shared by the stops on that side.
RowVector Formulas::held_stop(int stop, const std::vector<bool>& above) const {
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const mode::HeldPair& pair = held_[k];
    if (std::find(pair.stops.begin(), pair.stops.end(), stop) == pair.stops.end()) continue;
    const double side = beyond(k, above);
    if (sense(pair, frame_.stops[static_cast<std::size_t>(stop)]) != side) return none();
    const auto sharing = std::count_if(pair.stops.begin(), pair.stops.end(), [&](int i) {
      return sense(pair, frame_.stops[static_cast<std::size_t>(i)]) == side;
    });
    const RowVector f0 = outline_.holding.row(static_cast<Eigen::Index>(k));
    return (side * f0 - mode::friction_limit(pair, model_, frame_, outline_.states)) / static_cast<double>(sharing);
  }
  return none();
}

/// f0 up to the limit, shared by the friction contacts of the pair as their static frictions are.
RowVector Formulas::held_friction(int friction, const std::vector<bool>& above) const {
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const mode::HeldPair& pair = held_[k];
    if (std::find(pair.frictions.begin(), pair.frictions.end(), friction) == pair.frictions.end()) continue;
    const double own_sense = sense(pair, frame_.frictions[static_cast<std::size_t>(friction)]), side = beyond(k, above);
    const double own = model_.frictions[static_cast<std::size_t>(friction)].static_friction;
    if (side != 0.0) return own_sense * side * own * mode::load_row(model_, frame_, outline_.states, friction);
    double all = 0.0;
    for (const int i : pair.frictions) all += model_.frictions[static_cast<std::size_t>(i)].static_friction;
    const double share = all > 0.0 ? own / all : 1.0 / static_cast<double>(pair.frictions.size());
    return own_sense * share * outline_.holding.row(static_cast<Eigen::Index>(k));
  }
  return none();
}

RowVector Formulas::force(int contact, const std::vector<bool>& above) const {
  if (contact < stops()) return held_stop(contact, above);
  contact -= stops();
  if (contact < frictions()) {
    const auto at = static_cast<std::size_t>(contact);
    const FrictionState state = outline_.states.frictions[at];
    if (state == FrictionState::stick) return held_friction(contact, above);
    return mode::direction(state) * model_.frictions[at].kinetic_friction *
           mode::load_row(model_, frame_, outline_.states, contact);
  }
  contact -= frictions();
  if (contact < compliants())
    return mode::compliant_row(model_, frame_, contact, outline_.states.compliant[static_cast<std::size_t>(contact)]);
  contact -= compliants();
  return frame_.force_row(model_, contact, outline_.states.pieces[static_cast<std::size_t>(contact)]);
}

/// F w; of a compliant stop damping w^2, or as much as its spring's where that bounds it; of a stop nothing between
/// impacts.
Formula Formulas::power(int contact, const std::vector<bool>& above) const {
  if (contact < stops()) return {none()};
  const RowVector w = relative(contact);
  const int compliant = contact - stops() - frictions();
  if (compliant < 0 || compliant >= compliants()) return {none(), {{force(contact, above), w}}};
  const auto at = static_cast<std::size_t>(compliant);
  const CompliantState state = outline_.states.compliant[at];
  if (state == CompliantState::on) return {none(), {{model_.compliant_stops[at].damping * w, w}}};
  if (state != CompliantState::bounded) return {none()};
  return {none(), {{-model_.compliant_stops[at].stiffness * frame_.gap_row(frame_.compliant[at]), w}}};
}

}  // namespace slapstick::quantity
