/// Writes the gaps, velocities, forces and powers of contacts as polynomials in the extended state.
#include <algorithm>

#include "mode/contact_force.hpp"
#include "quantity/formula.hpp"

namespace slapstick::quantity {

using mode::CompliantState;
using mode::FrictionState;

Formulas::Formulas(const Model& model, const mode::Frame& frame, const mode::Outline& outline, const Rates* rates)
    : model_(model),
      frame_(frame),
      outline_(outline),
      rates_(rates != nullptr ? std::optional(*rates) : std::nullopt),
      held_(mode::held_pairs(frame, outline.states)) {
  for (std::size_t k = 0; k < held_.size(); ++k) {
    for (const double side : {1.0, -1.0}) {
      const bool stopped = std::any_of(held_[k].stops.begin(), held_[k].stops.end(), [&](int i) {
        return sense(held_[k], frame.stops[static_cast<std::size_t>(i)]) == side;
      });
      if (!stopped) continue;
      kink_of_.push_back({k, side});
      kinks_.push_back(side * holding(k) - limit(held_[k]));
    }
    if (shares_by_sense(held_[k])) {
      kink_of_.push_back({k, 0.0});
      kinks_.push_back(borne(held_[k], k));
    }
  }
}

/// f0 of a held pair.
Row Formulas::holding(std::size_t pair) const {
  const auto k = static_cast<Eigen::Index>(pair);
  return {outline_.holding.row(k), rates_ ? RowVector(rates_->outline->holding.row(k)) : zero()};
}

/// N of a friction contact, or 1.
Row Formulas::load(int friction) const {
  return {mode::load_row(model_, frame_, outline_.states, friction),
          rates_ ? mode::load_rate(model_, rates_->model, frame_, rates_->frame, outline_.states, friction) : zero()};
}

/// What a contact does beside its friction (Force::contact), as -F on a and F on b.
Row Formulas::constant_part(int friction) const {
  const FrictionContact& contact = model_.frictions[static_cast<std::size_t>(friction)];
  for (std::size_t i = 0; i < model_.forces.size(); ++i) {
    const Force& force = model_.forces[i];
    if (force.contact != friction) continue;
    const double of_end = force.coordinate == contact.a ? -contact.ratio.a : contact.ratio.b;
    return 1.0 / of_end * drive(static_cast<int>(i));
  }
  return none();
}

/// Do several contacts hold a pair, one of which bears more in one sense than in the other?
bool Formulas::shares_by_sense(const mode::HeldPair& pair) const {
  const auto uneven = [&](int friction) {
    return std::any_of(model_.forces.begin(), model_.forces.end(),
                       [&](const Force& force) { return force.contact == friction; });
  };
  return pair.frictions.size() > 1 && std::any_of(pair.frictions.begin(), pair.frictions.end(), uneven);
}

/// What the contacts of a held pair bear together, along its displacement: f0 and their constant parts.
Row Formulas::borne(const mode::HeldPair& pair, std::size_t index) const {
  Row all = holding(index);
  for (const int i : pair.frictions)
    all += sense(pair, frame_.frictions[static_cast<std::size_t>(i)]) * constant_part(i);
  return all;
}

/// How much a contact can bear of what is borne in this sense of a pair's displacement.
Number Formulas::room(const mode::HeldPair& pair, int friction, double along) const {
  const Row part = constant_part(friction);
  const auto one = frame_.one();
  const double own = along * sense(pair, frame_.frictions[static_cast<std::size_t>(friction)]);
  return number(&Model::frictions, friction, &FrictionContact::static_friction) +
         own * Number{part.value[one], part.rate.size() == 0 ? 0.0 : part.rate[one]};
}

/// What the friction contacts of a pair can bear.
Row Formulas::limit(const mode::HeldPair& pair) const {
  Row row = still(mode::friction_limit(pair, model_, frame_, outline_.states));
  for (const int i : pair.frictions)
    row.rate += (number(&Model::frictions, i, &FrictionContact::static_friction) * load(i)).rate;
  return row;
}

/// +1 or -1: the sense of a contact along the displacement of its pair.
double Formulas::sense(const mode::HeldPair& pair, const mode::ContactRow& contact) const {
  return contact.sign * frame_.parallel(pair.displacement, contact.own);
}

/// +1 or -1 where f0 of a pair is beyond its friction on a side that a stop is on, else 0.
double Formulas::beyond(std::size_t pair, const std::vector<bool>& above) const {
  for (std::size_t k = 0; k < kink_of_.size(); ++k)
    if (kink_of_[k].pair == pair && above[k] && kink_of_[k].side != 0.0) return kink_of_[k].side;
  return 0.0;
}

/// The sense of what a pair bears that shares by sense.
double Formulas::borne_sense(std::size_t pair, const std::vector<bool>& above) const {
  for (std::size_t k = 0; k < kink_of_.size(); ++k)
    if (kink_of_[k].pair == pair && kink_of_[k].side == 0.0) return above[k] ? 1.0 : -1.0;
  return 1.0;
}

Row Formulas::relative(int contact) const {
  if (contact < stops()) return still(frame_.velocity_row(frame_.stops[static_cast<std::size_t>(contact)]));
  contact -= stops();
  if (contact < frictions()) return still(frame_.velocity_row(frame_.frictions[static_cast<std::size_t>(contact)]));
  contact -= frictions();
  if (contact < compliants()) return still(frame_.velocity_row(frame_.compliant[static_cast<std::size_t>(contact)]));
  contact -= compliants();
  if (contact < bends()) return moved(frame_.characteristics[static_cast<std::size_t>(contact)].velocity);
  return link_speed(contact - bends());
}

/// strength (x_a - x_b), or of the velocities, between ends that bases may move (BaseMotion).
template <class Link>
Row Formulas::link_force(const Link& link, Number strength, bool velocities) const {
  Row row = strength * difference(link, velocities);
  const bool of_a = link.a != ground;
  for (int i = link.motion.first; i < link.motion.first + link.motion.count; ++i) {
    if (model_.forces[static_cast<std::size_t>(i)].coordinate != (of_a ? link.a : link.b)) continue;
    if (of_a)
      row -= drive(i);
    else
      row += drive(i);
  }
  return row;
}

Row Formulas::spring_force(int i) const {
  return link_force(model_.springs[static_cast<std::size_t>(i)], number(&Model::springs, i, &Spring::stiffness), false);
}

Row Formulas::damper_force(int i) const {
  return link_force(model_.dampers[static_cast<std::size_t>(i)], number(&Model::dampers, i, &Damper::coefficient),
                    true);
}

/// v_a - v_b of a spring or damper; of a damper on a base that moves F / coefficient.
Row Formulas::link_speed(int i) const {
  if (i < springs()) {
    const Spring& spring = model_.springs[static_cast<std::size_t>(i)];
    return difference(spring, true);
  }
  const Damper& damper = model_.dampers[static_cast<std::size_t>(i - springs())];
  if (damper.motion.none()) return difference(damper, true);
  const Number coefficient = number(&Model::dampers, i - springs(), &Damper::coefficient);
  if (coefficient.value == 0.0) return none();
  return Number{1.0, 0.0} / coefficient * damper_force(i - springs());
}

Row Formulas::gap(int contact) const {
  if (contact < stops()) return still(frame_.gap_row(frame_.stops[static_cast<std::size_t>(contact)]));
  return still(frame_.gap_row(frame_.compliant[static_cast<std::size_t>(contact - stops() - frictions())]));
}

/// What f0 is beyond the friction of the pair, shared by the stops on that side.
Row Formulas::held_stop(int stop, const std::vector<bool>& above) const {
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const mode::HeldPair& pair = held_[k];
    if (std::find(pair.stops.begin(), pair.stops.end(), stop) == pair.stops.end()) continue;
    const double side = beyond(k, above);
    if (sense(pair, frame_.stops[static_cast<std::size_t>(stop)]) != side) return none();
    const auto sharing = std::count_if(pair.stops.begin(), pair.stops.end(), [&](int i) {
      return sense(pair, frame_.stops[static_cast<std::size_t>(i)]) == side;
    });
    return 1.0 / static_cast<double>(sharing) * (side * holding(k) - limit(pair));
  }
  return none();
}

/// Sum of the static frictions of a pair.
Number Formulas::shared_friction(const mode::HeldPair& pair) const {
  Number all;
  for (const int i : pair.frictions) all += number(&Model::frictions, i, &FrictionContact::static_friction);
  return all;
}

/// What the contacts of a pair bear, shared as each can bear in that sense.
Row Formulas::shared_by_sense(int friction, std::size_t index, const std::vector<bool>& above) const {
  const mode::HeldPair& pair = held_[index];
  const double along = borne_sense(index, above);
  Number all;
  for (const int i : pair.frictions) all += room(pair, i, along);
  if (all.value <= 0.0) return none();
  return sense(pair, frame_.frictions[static_cast<std::size_t>(friction)]) * (room(pair, friction, along) / all) *
         borne(pair, index);
}

/// f0 up to the limit, shared by the friction contacts of the pair as their static frictions are.
Row Formulas::held_friction(int friction, const std::vector<bool>& above) const {
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const mode::HeldPair& pair = held_[k];
    if (std::find(pair.frictions.begin(), pair.frictions.end(), friction) == pair.frictions.end()) continue;
    const double own_sense = sense(pair, frame_.frictions[static_cast<std::size_t>(friction)]), side = beyond(k, above);
    const Number own = number(&Model::frictions, friction, &FrictionContact::static_friction);
    if (side != 0.0) return own_sense * side * own * load(friction) + constant_part(friction);
    if (shares_by_sense(pair)) return shared_by_sense(friction, k, above);
    const Number all = shared_friction(pair);
    const Number share = all.value > 0.0 ? own / all : Number{1.0 / static_cast<double>(pair.frictions.size()), 0.0};
    return own_sense * share * holding(k) + constant_part(friction);
  }
  return none();
}

/// slope value + offset of the piece in force.
Row Formulas::bend_force(int characteristic) const {
  const auto at = static_cast<std::size_t>(characteristic);
  const int piece = outline_.states.pieces[at];
  Row row = still(frame_.force_row(model_, characteristic, piece));
  if (!rates_) return row;
  const mode::Piece line = mode::piece_of(model_.characteristics[at], piece),
                    rate = mode::piece_rate(model_.characteristics[at], rates_->model.characteristics[at], piece);
  const Row over = moved(frame_.slope_row(model_, characteristic));
  row.rate = rate.slope * over.value + line.slope * over.rate;
  row.rate[frame_.one()] += rate.offset;
  return row;
}

Row Formulas::force(int contact, const std::vector<bool>& above) const {
  if (contact < stops()) return held_stop(contact, above);
  contact -= stops();
  if (contact < frictions()) {
    const FrictionState state = outline_.states.frictions[static_cast<std::size_t>(contact)];
    if (state == FrictionState::stick) return held_friction(contact, above);
    return mode::direction(state) * number(&Model::frictions, contact, &FrictionContact::kinetic_friction) *
               load(contact) +
           constant_part(contact);
  }
  contact -= frictions();
  if (contact < compliants()) {
    const CompliantState state = outline_.states.compliant[static_cast<std::size_t>(contact)];
    return {mode::compliant_row(model_, frame_, contact, state),
            rates_ ? mode::compliant_row(rates_->model, frame_, contact, state) : zero()};
  }
  contact -= compliants();
  if (contact < bends()) return bend_force(contact);
  contact -= bends();
  return contact < springs() ? spring_force(contact) : damper_force(contact - springs());
}

/// F w; of a compliant stop damping w^2, or as much as its spring's where that bounds it; of a stop nothing between
/// impacts.
Formula Formulas::power(int contact, const std::vector<bool>& above) const {
  if (contact < stops()) return {none()};
  const int link = contact - stops() - frictions() - compliants() - bends();
  if (link >= 0 && link < springs()) {  // of a spring in series with a damper, which goes at s'
    const int inner = model_.springs[static_cast<std::size_t>(link)].inner;
    return inner < 0 ? Formula{none()} : Formula{none(), {{force(contact, above), velocity(inner)}}};
  }
  const Row w = relative(contact);
  const int compliant = contact - stops() - frictions();
  if (const int bend = compliant - compliants(); bend >= 0 && bend < bends()) {  // a slider that rests takes nothing
    const mode::SliderRow* const slider = frame_.slider(bend);
    if (slider != nullptr && slider->rests(outline_.states.pieces)) return {none()};
  }
  if (compliant < 0 || compliant >= compliants()) return {none(), {{force(contact, above), w}}};
  const auto at = static_cast<std::size_t>(compliant);
  const CompliantState state = outline_.states.compliant[at];
  if (state == CompliantState::on)
    return {none(), {{number(&Model::compliant_stops, compliant, &CompliantStop::damping) * w, w}}};
  if (state != CompliantState::bounded) return {none()};
  const Number stiffness = number(&Model::compliant_stops, compliant, &CompliantStop::stiffness);
  return {none(), {{-stiffness * still(frame_.gap_row(frame_.compliant[at])), w}}};
}

}  // namespace slapstick::quantity
