/// Divides what happens at one instant among the guards that were zero.
#include "flow/instant_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/ranges.hpp"
#include "flow/engine.hpp"

namespace slapstick::flow {
namespace {

using mode::ContactRow;
using mode::ContactStates;
using mode::Guard;
using mode::GuardKind;

bool coupled(const mode::Frame& frame, const ContactRow& a, const ContactRow& b) {
  return frame.mass_inverse(a.own, b.own) != 0.0;
}

/// The contact of a guard that is no corner.
const ContactRow& contact_of(const mode::Frame& frame, const Guard& guard) {
  if (guard.kind == GuardKind::gap || guard.kind == GuardKind::press) return frame.stops[guard.contact];
  const bool friction = mode::of_friction(guard.kind) || mode::of_load(guard.kind);
  return friction ? frame.frictions[guard.contact] : frame.compliant[guard.contact];
}

/// Does the guard's pair share a mass with the contact's?
bool acts_on(const mode::Frame& frame, const Guard& guard, const ContactRow& contact) {
  if (mode::of_corner(guard.kind)) return frame.characteristics[guard.contact].push[contact.own] != 0.0;
  return coupled(frame, contact_of(frame, guard), contact);
}

/// The parts of a strike that do not act on each other.
std::vector<Motion::Strike> separated(const mode::Frame& frame, const Motion::Strike& strike) {
  std::vector<Motion::Strike> parts;
  for (std::size_t stop = 0; stop < frame.stops.size(); ++stop) {
    if ((strike.stops >> stop & 1U) == 0) continue;
    Motion::Strike joined{std::uint32_t{1} << stop, strike.to_rest};
    std::vector<Motion::Strike> others;
    for (const Motion::Strike& part : parts) {
      bool touched = false;
      for (std::size_t s = 0; s < frame.stops.size(); ++s)
        touched = touched || ((part.stops >> s & 1U) != 0 && coupled(frame, frame.stops[s], frame.stops[stop]));
      if (touched)
        joined.stops |= part.stops;
      else
        others.push_back(part);
    }
    others.push_back(joined);
    parts.swap(others);
  }
  return parts;
}

/// The guards that were zero at an instant, and what belongs to each.
class Division {
 public:
  Division(const Engine& engine, bool backward);
  [[nodiscard]] std::vector<InstantPart> parts();

 private:
  [[nodiscard]] const Guard& guard(std::size_t k) const { return before_.guards()[hits_[k]]; }
  [[nodiscard]] bool owns(std::size_t k, const ContactRow& contact) const;
  [[nodiscard]] std::size_t owner(const ContactRow& contact) const;
  [[nodiscard]] std::size_t owner(const Motion::Strike& strike) const;
  [[nodiscard]] std::size_t owner_of_piece(int characteristic) const;
  [[nodiscard]] bool changed(const Guard& guard) const;
  void add_forces_at_limits(const double* X);
  void drop_touches();
  void drop_hits_of_others();
  void take_states(std::size_t k, ContactStates& states) const;

  const Model& model_;
  const mode::Frame& frame_;
  const mode::Mode &before_, &behind_;
  std::vector<int> hits_;
  std::vector<Motion::Strike> strikes_;
};

Division::Division(const Engine& engine, bool backward)
    : model_(engine.system().model()),
      frame_(engine.system().frame()),
      before_(engine.system().mode(engine.segment().mode)),
      behind_(engine.system().mode(engine.mode_id())),
      hits_(engine.hits().begin(), engine.hits().end()),
      strikes_(separated_strikes(frame_, engine.strikes())) {
  drop_touches();
  add_forces_at_limits(engine.extended_before().data());
  ranges::sort(hits_);  // the search's own order is rounding: an orbit has one order in each of its cycles
  if (backward) std::reverse(hits_.begin(), hits_.end());
  std::stable_partition(hits_.begin(), hits_.end(),
                        [&](int g) { return passes_smoothly(model_, before_.guards()[g]); });
  drop_hits_of_others();
}

/// A slider that is just at its limit as its pair turns back rests on: the instant has no event of its own.
void Division::drop_touches() {
  const auto touches = [&](int g) {
    const Guard& own = before_.guards()[g];
    return frame_.slider(own.kind, own.contact) != nullptr && !changed(own);
  };
  for (std::size_t k = hits_.size(); k > 1; --k)
    if (touches(hits_[k - 1])) hits_.erase(hits_.begin() + static_cast<std::ptrdiff_t>(k) - 1);
}

/// Is the state of a guard's contact another one behind the instant?
bool Division::changed(const Guard& guard) const {
  const ContactStates &a = before_.states(), &b = behind_.states();
  const auto i = static_cast<std::size_t>(guard.contact);
  if (mode::of_corner(guard.kind)) return a.pieces[i] != b.pieces[i];
  if (guard.kind == GuardKind::gap || guard.kind == GuardKind::press) return a.stops[i] != b.stops[i];
  if (mode::of_friction(guard.kind) || mode::of_load(guard.kind)) return a.frictions[i] != b.frictions[i];
  return a.compliant[i] != b.compliant[i];
}

/// The engine gathers gaps and velocities that are zero together. A force that comes to its limit at the same instant
/// shows by the change of its contact, where no other guard of the instant acts on that contact.
void Division::add_forces_at_limits(const double* X) {
  constexpr double limit_rounding = 0x1p-40;  // of the guard's terms; less takes two instants for one, more one for two
  const std::size_t known = hits_.size();
  for (int g = 0; g < before_.guard_count(); ++g) {
    const Guard& own = before_.guards()[g];
    if (!changed(own) || ranges::find(hits_, g) != hits_.end()) continue;
    bool alone = true;
    for (std::size_t k = 0; k < known; ++k) alone = alone && !share_mass(frame_, guard(k), own);
    const Eigen::Map<const mode::Vector> state(X, before_.size());
    const double terms = own.row.cwiseAbs().dot(state.cwiseAbs());
    if (alone && std::abs(own.row.dot(state)) <= limit_rounding * terms) hits_.push_back(g);
  }
}

bool Division::owns(std::size_t k, const ContactRow& contact) const {
  if (!passes_smoothly(model_, guard(k))) return acts_on(frame_, guard(k), contact);
  return !mode::of_corner(guard(k).kind) && &contact_of(frame_, guard(k)) == &contact;
}

/// The first guard whose pair shares a mass with the contact's; without such a guard the last one.
std::size_t Division::owner(const ContactRow& contact) const {
  for (std::size_t k = 0; k < hits_.size(); ++k)
    if (owns(k, contact)) return k;
  return hits_.size() - 1;
}

/// The guard that is the gap of one of the stops struck, or else the first that acts on one of them.
std::size_t Division::owner(const Motion::Strike& strike) const {
  for (std::size_t k = 0; k < hits_.size(); ++k)
    if (guard(k).kind == GuardKind::gap && (strike.stops >> guard(k).contact & 1U) != 0) return k;
  std::size_t first = hits_.size() - 1;
  for (std::size_t stop = 0; stop < frame_.stops.size(); ++stop)
    if ((strike.stops >> stop & 1U) != 0) first = std::min(first, owner(frame_.stops[stop]));
  return first;
}

/// The guard that is a corner of the characteristic, or else the first that acts on its pair, as an impact that turns
/// the velocity round; without such guards the last one.
std::size_t Division::owner_of_piece(int characteristic) const {
  for (std::size_t k = 0; k < hits_.size(); ++k)
    if (mode::of_corner(guard(k).kind) && guard(k).contact == characteristic) return k;
  const auto& push = frame_.characteristics[static_cast<std::size_t>(characteristic)].push;
  for (std::size_t k = 0; k < hits_.size(); ++k)
    if (!passes_smoothly(model_, guard(k)) && !mode::of_corner(guard(k).kind) &&
        push[contact_of(frame_, guard(k)).own] != 0.0)
      return k;
  return hits_.size() - 1;
}

/// A stop that was struck together with an earlier one has no event of its own.
void Division::drop_hits_of_others() {
  for (std::size_t k = 1; k < hits_.size();) {
    const bool taken = guard(k).kind == GuardKind::gap && ranges::any_of(strikes_, [&](const Motion::Strike& strike) {
                         return (strike.stops >> guard(k).contact & 1U) != 0 && owner(strike) < k;
                       });
    if (taken)
      hits_.erase(hits_.begin() + static_cast<std::ptrdiff_t>(k));
    else
      ++k;
  }
}

/// The changes of contact states that belong to the k-th guard.
void Division::take_states(std::size_t k, ContactStates& states) const {
  const ContactStates& final = behind_.states();
  if (k + 1 == hits_.size()) {
    states = final;
    return;
  }
  const auto take = [&](auto& of, const auto& last, const std::vector<ContactRow>& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (owner(rows[i]) == k) of[i] = last[i];
  };
  take(states.stops, final.stops, frame_.stops);
  take(states.frictions, final.frictions, frame_.frictions);
  take(states.compliant, final.compliant, frame_.compliant);
  for (std::size_t i = 0; i < states.pieces.size(); ++i)
    if (owner_of_piece(static_cast<int>(i)) == k) states.pieces[i] = final.pieces[i];
}

std::vector<InstantPart> Division::parts() {
  std::vector<InstantPart> all;
  ContactStates states = before_.states();
  for (std::size_t k = 0; k < hits_.size(); ++k) {
    InstantPart part;
    part.guard = hits_[k];
    for (const Motion::Strike& strike : strikes_)
      if (owner(strike) == k) part.strikes.push_back(strike);
    take_states(k, states);
    part.after = states;
    all.push_back(std::move(part));
  }
  return all;
}

}  // namespace

std::vector<InstantPart> parts_of_instant(const Engine& engine, bool backward) {
  return Division(engine, backward).parts();
}

std::vector<Motion::Strike> separated_strikes(const mode::Frame& frame, std::span<const Motion::Strike> strikes) {
  std::vector<Motion::Strike> all;
  for (const Motion::Strike& strike : strikes)
    for (const Motion::Strike& part : separated(frame, strike)) all.push_back(part);
  return all;
}

bool passes_smoothly(const Model& model, const Guard& guard) {
  if (!mode::of_crossing(guard.kind)) return false;
  if (!mode::of_corner(guard.kind)) return true;
  const Characteristic& one_of = model.characteristics[guard.contact];  // a slider forgets how it was stretched
  return one_of.over != Characteristic::Over::zones && one_of.inner < 0;
}

bool share_mass(const mode::Frame& frame, const Guard& a, const Guard& b) {
  if (!mode::of_corner(b.kind)) return acts_on(frame, a, contact_of(frame, b));
  if (!mode::of_corner(a.kind)) return acts_on(frame, b, contact_of(frame, a));
  if (frame.slider(a.contact) != nullptr && frame.slider(b.contact) != nullptr) return false;  // each moves itself only
  const auto &push = frame.characteristics[a.contact].push, &other = frame.characteristics[b.contact].push;
  for (Eigen::Index i = 0; i < frame.d; ++i)
    if (push[i] != 0.0 && other[i] != 0.0) return true;
  return false;
}

}  // namespace slapstick::flow
