/// The part of a flat program that all parameter values share: slots, what ends each mode, what may follow.
#include "batch/shape.hpp"

#include <algorithm>

#include "base/ranges.hpp"

namespace slapstick::batch {

using mode::CompliantState;
using mode::FrictionState;
using mode::GuardKind;
using mode::StopState;

namespace {

/// What a contact may be in after an event, as digits of a mode, the preferred one first.
struct Offer {
  int digit[3] = {};
  int count = 1;
};

Offer at_rest(bool falls) { return falls ? Offer{{1, 0, 2}, 3} : Offer{{1, 2, 0}, 3}; }

void add(const Shape& shape, const std::vector<int>& digits, Action& action) {
  int id = 0, stride = 1;
  for (std::size_t c = 0; c < digits.size(); ++c) {
    id += stride * digits[c];
    stride *= static_cast<int>(c) < shape.stops ? 2 : 3;
  }
  if (action.candidates < most_candidates) action.candidate[action.candidates++] = static_cast<std::int16_t>(id);
}

/// What every contact offers after an event, in the order of a mode's digits: that of flow/mode_graph.cpp where the
/// state's zeros are those that the mode and the event make.
class Offers {
 public:
  explicit Offers(std::vector<Offer> offers) : offers_(std::move(offers)) {}

  /// All combinations in which at most `most_changed` contacts differ from what they prefer: those with few first.
  template <class Take>
  void each(int most_changed, const Take& take) {
    std::vector<int> digits;
    for (const Offer& offer : offers_) digits.push_back(offer.digit[0]);
    for (int changed = 0; changed <= most_changed; ++changed) change(0, changed, digits, take);
  }

 private:
  template <class Take>
  void change(std::size_t from, int left, std::vector<int>& digits, const Take& take) {
    if (left == 0) return take(digits);
    for (std::size_t c = from; c < offers_.size(); ++c) {
      for (int k = 1; k < offers_[c].count; ++k) {
        digits[c] = offers_[c].digit[k];
        change(c + 1, left - 1, digits, take);
      }
      digits[c] = offers_[c].digit[0];
    }
  }

  std::vector<Offer> offers_;
};

/// The same where the state's zeros are those that the mode and an event make. With given states of the others no more
/// than one direction of slip fits; the likely one comes first.
class EventOffers {
 public:
  EventOffers(const Model& model, const mode::Frame& frame, const Action& action, const mode::Guard& guard)
      : model_(model), frame_(frame), action_(action), guard_(guard) {}

  [[nodiscard]] std::vector<Offer> of(const mode::ContactStates& states) const {
    std::vector<Offer> offers;
    for (const StopState stop : states.stops) offers.push_back(of_stop(stop));
    for (std::size_t i = 0; i < states.frictions.size(); ++i) offers.push_back(of_friction(i, states.frictions[i]));
    for (std::size_t i = 0; i < states.compliant.size(); ++i) offers.push_back(of_compliant(i, states.compliant[i]));
    return offers;
  }

 private:
  static Offer of_stop(StopState state) { return state == StopState::closed ? Offer{{1, 0}, 2} : Offer{{0}, 1}; }

  /// An impulse may turn the velocity of another pair; which way, the slip guards of both say.
  [[nodiscard]] Offer of_friction(std::size_t i, FrictionState state) const {
    const mode::ContactRow& contact = frame_.frictions[i];
    const bool same = contact.own == action_.own;
    if (action_.jump == Jump::impact) {
      if (same) return {{contact.sign * action_.sign > 0.0 ? 0 : 2}, 1};
      if (frame_.mass_inverse(contact.own, action_.own) != 0.0)
        return state == FrictionState::slip_minus ? Offer{{0, 2}, 2} : Offer{{2, 0}, 2};
    }
    if (state == FrictionState::stick || (same && action_.jump == Jump::velocity_zero)) return at_rest(falls(i, state));
    return {{static_cast<int>(state) + 1}, 1};
  }

  /// Whether the velocity is likely to go below zero: it comes from above, or the holding force is at its lower limit.
  [[nodiscard]] bool falls(std::size_t i, FrictionState state) const {
    if (state != FrictionState::stick) return state == FrictionState::slip_plus;
    return guard_.kind == GuardKind::stick_below && guard_.contact == static_cast<int>(i);
  }

  [[nodiscard]] Offer of_compliant(std::size_t i, CompliantState state) const {
    const CompliantStop& stop = model_.compliant_stops[i];
    const bool can_detach = !stop.pulls && stop.damping > 0.0;
    if (action_.jump == Jump::gap_zero && frame_.compliant[i].own == action_.own)
      return {{0, 1, 2}, can_detach ? 3 : 2};
    if (state == CompliantState::off) return {{0}, 1};
    return {{1, 2}, can_detach ? 2 : 1};
  }

  const Model& model_;
  const mode::Frame& frame_;
  const Action& action_;
  const mode::Guard& guard_;
};

/// The modes that may follow. A force at its limit does not leave the mode as it is: it is falling.
void add_candidates(const Model& model, const mode::Frame& frame, const Shape& shape, int mode,
                    const mode::Guard& guard, Action& action) {
  Offers(EventOffers(model, frame, action, guard).of(states_of(shape, mode)))
      .each(2, [&](const std::vector<int>& digits) {
        add(shape, digits, action);
        const bool stays = action.candidates > 0 && action.candidate[action.candidates - 1] == mode;
        if (action.jump == Jump::none && stays) --action.candidates;
      });
}

/// An impact beside a stop in contact is one of several at an instant.
bool another_closed(const mode::ContactStates& states) {
  return ranges::find(states.stops, StopState::closed) != states.stops.end();
}

Action action_of(const Model& model, const mode::Frame& frame, const Shape& shape, int mode, const mode::Guard& guard) {
  Action action;
  action.contact = static_cast<std::int8_t>(guard.contact);
  const auto of = [&](Jump jump, const mode::ContactRow& contact) {
    action.jump = jump;
    action.own = static_cast<std::int8_t>(contact.own);
    action.sign = contact.sign > 0.0 ? 1 : -1;
  };
  const int first = shape.stops + shape.frictions;
  switch (guard.kind) {
    case GuardKind::gap:
      of(Jump::impact, frame.stops[guard.contact]);
      action.stop = static_cast<std::int8_t>(guard.contact);
      if (another_closed(states_of(shape, mode))) return {};
      break;
    case GuardKind::slip:
      of(Jump::velocity_zero, frame.frictions[guard.contact]);
      action.contact = static_cast<std::int8_t>(shape.stops + guard.contact);
      break;
    case GuardKind::stick_above:
    case GuardKind::stick_below:
      if (guard.single >= 0) return {};  // Engine::set_holding_guard_zero
      of(Jump::none, frame.frictions[guard.contact]);
      action.contact = static_cast<std::int8_t>(shape.stops + guard.contact);
      break;
    case GuardKind::press:
      if (guard.single >= 0) return {};
      of(Jump::none, frame.stops[guard.contact]);
      break;
    case GuardKind::engage:
    case GuardKind::leave:
    case GuardKind::let_go:
    case GuardKind::push:
      of(guard.kind == GuardKind::engage || guard.kind == GuardKind::leave ? Jump::gap_zero : Jump::force_zero,
         frame.compliant[guard.contact]);
      action.stop = static_cast<std::int8_t>(guard.contact);
      action.contact = static_cast<std::int8_t>(first + guard.contact);
      break;
    default:
      return {};
  }
  add_candidates(model, frame, shape, mode, guard, action);
  return action;
}

/// What a contact may be in at a start, or nothing where a stop or a compliant stop is just in contact.
std::vector<Offer> start_offers(const Model& model, const mode::Frame& frame, const double* p, const double* u) {
  std::vector<Offer> offers;
  for (const mode::ContactRow& stop : frame.stops) {
    if (p[stop.own] == 0.0) return {};
    offers.push_back({});
  }
  for (const mode::ContactRow& friction : frame.frictions) {
    const double w = friction.sign * u[friction.own];
    offers.push_back(w == 0.0 ? at_rest(false) : Offer{{w > 0.0 ? 2 : 0}, 1});
  }
  for (std::size_t i = 0; i < frame.compliant.size(); ++i) {
    const double depth = frame.compliant[i].sign * p[frame.compliant[i].own];
    if (depth == 0.0) return {};
    const CompliantStop& stop = model.compliant_stops[i];
    offers.push_back(depth < 0.0 ? Offer{} : Offer{{1, 2}, !stop.pulls && stop.damping > 0.0 ? 2 : 1});
  }
  return offers;
}

}  // namespace

Action start_action(const Model& model, const mode::Frame& frame, const Shape& shape, const double* p,
                    const double* u) {
  Action action;
  std::vector<Offer> given = start_offers(model, frame, p, u);
  if (given.empty() && shape.modes > 1) return action;
  action.jump = Jump::none;
  Offers(std::move(given)).each(2, [&](const std::vector<int>& digits) { add(shape, digits, action); });
  return action;
}

std::vector<SlotRows> slots_of(const mode::Outline& outline, const mode::Frame& frame) {
  std::vector<SlotRows> slots;
  const auto& guards = outline.guards;
  std::vector<int> falling(guards.size(), -1);  // the slip guard that a gap falls with
  for (std::size_t g = 0; g < guards.size(); ++g)
    if (guards[g].falls_with >= 0) falling[static_cast<std::size_t>(guards[g].falls_with)] = static_cast<int>(g);
  for (std::size_t g = 0; g < guards.size(); ++g) {
    if (falling[g] >= 0) continue;
    SlotRows slot;
    slot.row = guards[g].row;
    slot.guard[at_lower] = static_cast<int>(g);
    if (guards[g].kind == GuardKind::stick_above && g + 1 < guards.size()) {
      slot.row = 0.5 * (guards[g + 1].row - guards[g].row);
      slot.limit = 0.5 * (guards[g + 1].row[frame.one()] + guards[g].row[frame.one()]);
      slot.guard[at_upper] = static_cast<int>(g);
      slot.guard[at_lower] = static_cast<int>(++g);
    }
    if (guards[g].single >= 0) {
      slot.slot.speed = guards[g].single >= frame.d;
      slot.slot.own = static_cast<std::int8_t>(guards[g].single - (slot.slot.speed ? frame.d : 0));
    }
    if (const int gap = guards[g].falls_with; gap >= 0) {
      slot.slot.gap = static_cast<std::int8_t>(guards[static_cast<std::size_t>(gap)].contact);
      slot.guard[at_gap] = gap;
    }
    slots.push_back(std::move(slot));
  }
  return slots;
}

bool fits_lanes(const Model& model, const mode::Frame& frame) {
  const std::size_t contacts = model.stops.size() + model.frictions.size() + model.compliant_stops.size();
  const auto shares = [&](const mode::ContactRow& stop) {
    return ranges::any_of(frame.compliant, [&](const mode::ContactRow& other) { return other.own == stop.own; });
  };
  std::size_t slots = model.stops.size() + model.frictions.size() + 2 * model.compliant_stops.size();
  return frame.d == frame.n && frame.n <= most_coordinates && contacts <= most_contacts && slots <= most_slots &&
         2 * frame.harmonics.size() <= most_streams && model.characteristics.empty() && model.periodic() &&
         model.signals.empty() &&
         ranges::none_of(model.frictions, [](const FrictionContact& contact) { return contact.normal.has_value(); }) &&
         ranges::all_of(model.stops, [](const Stop& stop) { return stop.corners.empty() && stop.restitution > 0.0; }) &&
         ranges::none_of(model.compliant_stops, [](const CompliantStop& stop) { return stop.bounded; }) &&
         frame.inner.empty() && ranges::none_of(frame.stops, shares);
}

namespace {

/// What of a model the shape is made of: pairs and senses of the contacts, which compliant stops let go, streams.
std::vector<int> structure_of(const Model& model, const mode::Frame& frame) {
  std::vector<int> all = {frame.n, static_cast<int>(frame.stops.size()), static_cast<int>(frame.frictions.size()),
                          static_cast<int>(frame.compliant.size())};
  const auto add = [&](const std::vector<mode::ContactRow>& contacts) {
    for (const mode::ContactRow& contact : contacts) all.push_back(2 * contact.own + (contact.sign > 0.0 ? 1 : 0));
  };
  add(frame.stops);
  add(frame.frictions);
  add(frame.compliant);
  for (const CompliantStop& stop : model.compliant_stops) all.push_back(!stop.pulls && stop.damping > 0.0 ? 1 : 0);
  for (std::size_t k = 0; k < frame.harmonics.size(); ++k)
    for (const int which : {0, 1})
      if (!frame.free.col(2 * frame.d + 2 * static_cast<Eigen::Index>(k) + which).isZero(0.0))
        all.push_back(2 * frame.harmonics[k] + which);
  for (int i = 0; i < frame.n; ++i)
    for (int j = 0; j < frame.n; ++j) all.push_back(frame.mass_inverse(i, j) != 0.0 ? 1 : 0);
  return all;
}

}  // namespace

bool same_shape(const Shape& shape, const Model& model, const mode::Frame& frame) {
  return shape.structure == structure_of(model, frame);
}

Shape shape_of(const Model& model, const mode::Frame& frame) {
  Shape shape;
  shape.structure = structure_of(model, frame);
  shape.stops = static_cast<int>(model.stops.size());
  shape.frictions = static_cast<int>(model.frictions.size());
  shape.compliant = static_cast<int>(model.compliant_stops.size());
  shape.modes = 1;
  for (int i = 0; i < shape.stops; ++i) shape.modes *= 2;
  for (int i = 0; i < shape.frictions + shape.compliant; ++i) shape.modes *= 3;
  for (std::size_t k = 0; k < frame.harmonics.size(); ++k)
    for (int cosine = 1; cosine >= 0; --cosine) {
      if (frame.free.col(2 * frame.d + 2 * static_cast<Eigen::Index>(k) + 1 - cosine).isZero(0.0)) continue;
      shape.harmonic.push_back(frame.harmonics[k]);
      shape.cosine_of.push_back(static_cast<std::uint8_t>(cosine));
    }
  const int doubled = ranges::any_of(model.compliant_stops,
                                     [](const CompliantStop& stop) { return !stop.pulls && stop.damping > 0.0; });
  shape.layout = {frame.n, static_cast<int>(shape.harmonic.size()),
                  shape.stops + shape.frictions + (1 + doubled) * shape.compliant};
  const auto modes = static_cast<std::size_t>(shape.modes), slots = static_cast<std::size_t>(shape.layout.slots);
  shape.slot.resize(modes * slots);
  shape.slots.resize(modes + 1);
  shape.action.resize(modes * slots * sides);
  shape.open.resize(modes);
  shape.still.resize(modes);
  shape.known.resize(modes);
  return shape;
}

mode::ContactStates states_of(const Shape& shape, int mode) {
  mode::ContactStates states;
  const auto digit = [&](int base) {
    const int value = mode % base;
    mode /= base;
    return value;
  };
  for (int i = 0; i < shape.stops; ++i) states.stops.push_back(static_cast<StopState>(digit(2)));
  for (int i = 0; i < shape.frictions; ++i) states.frictions.push_back(static_cast<FrictionState>(digit(3) - 1));
  for (int i = 0; i < shape.compliant; ++i) states.compliant.push_back(static_cast<CompliantState>(digit(3)));
  return states;
}

namespace {

/// The numbers that a mode holds still: velocities of held pairs, displacements of closed stops.
std::uint8_t held_still(const mode::Outline& outline, const mode::Frame& frame) {
  unsigned still = 0;
  for (int i = 0; i < frame.n; ++i)
    if (outline.steady[static_cast<std::size_t>(i)]) still |= 1U << i;
  for (std::size_t i = 0; i < frame.stops.size(); ++i)
    if (outline.states.stops[i] == StopState::closed) still |= 1U << (most_coordinates + frame.stops[i].own);
  return static_cast<std::uint8_t>(still);
}

}  // namespace

void add_mode(const Model& model, const mode::Frame& frame, const mode::Outline& outline,
              const std::vector<SlotRows>& slots, int mode, Shape& shape) {
  const auto first = static_cast<std::size_t>(mode) * static_cast<std::size_t>(shape.layout.slots);
  unsigned open = 0;
  for (std::size_t i = 0; i < outline.states.stops.size(); ++i)
    if (outline.states.stops[i] == StopState::open) open |= 1U << frame.stops[i].own;
  for (const mode::Guard& guard : outline.guards)
    if (guard.kind == GuardKind::gap) open &= ~(1U << frame.stops[guard.contact].own);
  for (std::size_t s = 0; s < slots.size(); ++s) {
    shape.slot[first + s] = slots[s].slot;
    for (std::size_t side = 0; side < sides; ++side)
      if (const int g = slots[s].guard[side]; g >= 0) {
        shape.action[(first + s) * sides + side] =
            action_of(model, frame, shape, mode, outline.guards[static_cast<std::size_t>(g)]);
      }
  }
  shape.slots[static_cast<std::size_t>(mode)] = static_cast<std::uint8_t>(slots.size());
  shape.open[static_cast<std::size_t>(mode)] = static_cast<std::uint8_t>(open);
  shape.still[static_cast<std::size_t>(mode)] = held_still(outline, frame);
  shape.known[static_cast<std::size_t>(mode)] = 1;
}

bool has_shape(const Shape& shape, int mode, const std::vector<SlotRows>& slots) {
  const auto first = static_cast<std::size_t>(mode) * static_cast<std::size_t>(shape.layout.slots);
  if (slots.size() != shape.slots[static_cast<std::size_t>(mode)]) return false;
  for (std::size_t s = 0; s < slots.size(); ++s) {
    const Slot &a = shape.slot[first + s], &b = slots[s].slot;
    if (a.own != b.own || a.speed != b.speed || a.gap != b.gap) return false;
  }
  return true;
}

}  // namespace slapstick::batch
