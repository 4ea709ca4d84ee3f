/// What is zero at the instant of an event, together with what ended the flight, and is made exactly so.
#include <algorithm>
#include <cmath>

#include "flow/engine.hpp"
#include "flow/impact_law.hpp"
#include "flow/mode_graph.hpp"

namespace slapstick::flow {

using mode::GuardKind;

namespace {

/// Of a slider that only touches its limit, in roundings: the choice of the mode looks at two on each side.
constexpr double clear = 4.0;

}  // namespace

/// Is it the end of a slider's slip, by the velocity that is zero at the other guard?
bool Engine::turns_with(const mode::Guard& corner, const mode::Guard& slip) const {
  if (slip.kind != GuardKind::slip) return false;
  const mode::SliderRow* slider = system_->frame().slider(corner.kind, corner.contact);
  return slider != nullptr && !slider->rests(here_->states().pieces) &&
         system_->frame().in_step(system_->frame().frictions[slip.contact].own, slider->pair.own);
}

/// The guard that tells of a pair's velocity: of a slider's slip that ends with that of its pair, the pair's.
int Engine::of_pair(int guard) const {
  const auto& guards = here_->guards();
  for (int g = 0; g < static_cast<int>(guards.size()); ++g)
    if (turns_with(guards[guard], guards[g]) && within_noise(g, arrived_x_)) return g;
  return guard;
}

bool Engine::of_one_pair(const mode::Guard& a, const mode::Guard& b) const {
  const auto coupled = [&](const mode::Guard& gap, const mode::Guard& slip) {
    return gap.kind == GuardKind::gap && slip.kind == GuardKind::slip &&
           system_->coupling(gap.contact, slip.contact).same_pair;
  };
  return coupled(a, b) || coupled(b, a) || turns_with(a, b) || turns_with(b, a);
}

/// Has another gap or velocity passed its zero before the event, by more than its bound? Its zero and the event's are
/// one instant then, as far as the clock can tell: of copies of a machine that have just been at rest.
bool Engine::has_passed(int guard) const {
  const mode::Guard& h = here_->guards()[guard];
  if (orders_[guard] < 0 || orders_[guard] == never || h.at(X_.data()) >= 0.0) return false;
  return h.kind == GuardKind::slip ||
         (h.kind == GuardKind::gap && approach_velocity(*system_, h.contact, X_.data()) > 0.0);
}

/// Other gaps, relative velocities and ways of sliders to their limits that are zero at this instant, as far as
/// rounding can tell, are made exactly zero: symmetric machines have their events in pairs.
void Engine::gather_ties(int guard) {
  const auto& guards = here_->guards();
  const mode::Frame& frame = system_->frame();
  for (int g = 0; g < static_cast<int>(guards.size()); ++g) {
    const int contact = guards[g].contact;
    if (g == guard || of_one_pair(guards[g], guards[guard])) continue;  // of one pair: see stop_touched_at_rest
    if (!within_noise(g, arrived_x_) && !has_passed(g)) continue;
    if (guards[g].kind == GuardKind::gap)
      set_gap_zero(frame.stops[contact]);
    else if (guards[g].kind == GuardKind::slip)
      set_velocity_zero(frame.frictions[contact]);
    else if (of_corner(guards[g].kind))
      set_crossing_guard(guards[g], 0.0);
    else
      set_gap_zero(frame.compliant[contact]);
    hits_.push_back(g);
  }
}

/// Is a slider just at its limit as its pair turns back? From the guard's zero on a_1 x + a_2 x^2 falls by no more than
/// rounding before it rises again. One that has come to rest there at this very instant is not asked.
bool Engine::only_touches(int guard, double rounding) const {
  const mode::Guard& limit = here_->guards()[guard];
  const mode::SliderRow* slider = system_->frame().slider(limit.kind, limit.contact);
  if (slider == nullptr || !slider->rests(here_->states().pieces)) return false;
  if (place_.windows == 0 && !place_.moved && orders_[guard] > 0) return false;
  event::Lane8 taylor, noise;
  here_->leading(guard, X_.data(), magnitude_.data(), taylor, noise);
  return taylor[1] >= 0.0 || (taylor[2] > 0.0 && taylor[1] * taylor[1] <= 4.0 * taylor[2] * rounding);
}

/// Is a slider at its limit where its pair hits a stop, up to rounding? There the pair turns back.
/// @returns the way that is left
std::optional<double> Engine::way_to_wall(int guard, double rounding) const {
  const mode::Guard& limit = here_->guards()[guard];
  const mode::Frame& frame = system_->frame();
  const mode::SliderRow* slider = frame.slider(limit.kind, limit.contact);
  if (slider == nullptr || !slider->rests(here_->states().pieces)) return std::nullopt;
  for (int s = 0; s < stops(); ++s) {
    const int own = frame.stops[s].own;
    if (!frame.in_step(own, slider->pair.own) || approach_velocity(*system_, s, X_.data()) <= 0.0) continue;
    if (const double way = std::abs(gap(*system_, s, X_.data())); way <= rounding) return way;
  }
  return std::nullopt;
}

/// A motion that settles may draw a slider along until the slider is just not drawn any more, at a turn or at a stop.
/// The limit would be touched in each cycle, and rounding would say each time whether the slider slips. So a slider
/// that only touches is drawn further, clear of what the search of roots and the choice of the mode take for zero; and
/// a touch is no event.
void Engine::leave_touched_limits() {
  for (std::size_t k = hits_.size(); k > 0; --k) {
    const int g = hits_[k - 1];
    const mode::Guard& limit = here_->guards()[g];
    const double rounding =
        std::max(noise_of(g, arrived_x_), rounding_of(here_->size(), limit.size(magnitude_.data())));
    const std::optional<double> way = only_touches(g, rounding) ? 0.0 : way_to_wall(g, rounding);
    if (!way) continue;
    set_crossing_guard(limit, *way + clear * rounding);
    hits_.erase(hits_.begin() + static_cast<std::ptrdiff_t>(k) - 1);
  }
}

/// The same of a start, which may be just before a pair turns back: the way on, a_0^2 / (2 |a_1|) of a speed
/// a_0 + a_1 x, is rounding. @returns whether there is such a slider
bool Engine::leave_limits_at_start() {
  const mode::Frame& frame = system_->frame();
  bool any = false;
  for (int g = 0; g < here_->guard_count(); ++g) {
    const mode::Guard& speed = here_->guards()[g];
    const mode::SliderRow* slider = frame.slider(speed.kind, speed.contact);
    if (slider == nullptr || slider->rests(here_->states().pieces)) continue;
    const bool high = here_->states().pieces[static_cast<std::size_t>(speed.contact)] == 2;
    const mode::RowVector& limit = frame.characteristics[speed.contact].corners[high ? 1 : 0];
    const double rounding = rounding_of(limit, magnitude_.data());
    event::Lane8 taylor, noise;
    here_->leading(g, X_.data(), magnitude_.data(), taylor, noise);
    const double way = here_->window() * taylor[0] * taylor[0];
    if (!(taylor[1] < 0.0 && way <= -2.0 * taylor[1] * rounding)) continue;
    X_.data()[slider->own] += (high ? clear : -clear) * rounding;
    any = true;
  }
  return any;
}

/// The stop of a pair that comes to rest just where its gap vanishes, within the gap's rounding bound; -1 if there is
/// no such stop. The gap's minimum and the zero of its rate are one instant, whichever of the two searches ends an ulp
/// earlier.
int Engine::stop_touched_at_rest(int friction) const {
  const mode::Mode& mode = *here_;
  for (int g = 0; g < mode.guard_count(); ++g) {
    const mode::Guard& guard = mode.guards()[g];
    if (guard.kind != GuardKind::gap || !system_->coupling(guard.contact, friction).same_pair) continue;
    if (gap(*system_, guard.contact, X_.data()) <= 0.0 || within_noise(g, arrived_x_)) return guard.contact;
  }
  return -1;
}

/// Sets the velocity of a contact, or the gap of a stop, to exactly zero in the stored state.
void Engine::set_velocity_zero(const mode::ContactRow& contact) {
  X_.data()[system_->frame().u(contact.own)] = 0.0;
  system_->frame().match_velocities(contact.own, X_.data());
}

void Engine::set_gap_zero(const mode::ContactRow& contact) {
  X_.data()[contact.own] = 0.0;
  system_->frame().match_displacements(contact.own, X_.data());
}

/// The force of a compliant stop has reached zero: made exactly so by the speed of its pair, so that it is not let go
/// twice. Where a weak damper would make more than rounding of that, the force's rounding is the displacement's, and
/// this one is moved.
void Engine::set_force_zero(int compliant) {
  constexpr double force_rounding = 0x1p-40;
  const CompliantStop& stop = system_->model().compliant_stops[compliant];
  const mode::ContactRow& row = system_->frame().compliant[compliant];
  double& u = X_.data()[system_->frame().u(row.own)];
  const double exact = -stop.stiffness / stop.damping * X_.data()[row.own];
  if (std::abs(exact - u) <= force_rounding * std::abs(u)) {
    u = exact;
    system_->frame().match_velocities(row.own, X_.data());
  } else {
    X_.data()[row.own] = -stop.damping / stop.stiffness * u;
    system_->frame().match_displacements(row.own, X_.data());
  }
}

/// Moves the largest term so that the guard has a value, up to the rounding of a sum: the displacement (velocity) of a
/// characteristic lies on its corner, or a force is zero. The term is not zero, and not of a pair that is held: a
/// displacement of a pair at a closed stop would open the stop by its rounding.
void Engine::set_crossing_guard(const mode::Guard& guard, double value) {
  const int d = system_->frame().d;
  const mode::Guard::Entry* most = nullptr;
  for (const mode::Guard::Entry& entry : guard.entries) {
    if (entry.column >= 2 * d || here_->steady(entry.column % d)) continue;
    if (entry.column < d && system_->frame().rate_follows(entry.column)) {  // a slider: no body moves with it
      most = &entry;
      break;
    }
    if (X_.data()[entry.column] == 0.0) continue;
    if (most == nullptr || std::abs(entry.value) > std::abs(most->value)) most = &entry;
  }
  if (most == nullptr) return;
  const int own = most->column % d;
  X_.data()[most->column] -= (guard.at(X_.data()) - value) / most->value;
  most->column < d ? system_->frame().match_displacements(own, X_.data())
                   : system_->frame().match_velocities(own, X_.data());
}

/// A holding force that is one number times a factor made exactly zero. Rounding derived from that number would hardly
/// be any near its zero, and what the motion has left of it would be taken for a force that holds.
void Engine::set_holding_guard_zero(const mode::Guard& guard) {
  if (guard.single < 0) return;
  const mode::Frame& frame = system_->frame();
  X_.data()[guard.single] = 0.0;
  guard.single < frame.d ? frame.match_displacements(guard.single, X_.data())
                         : frame.match_velocities(guard.single - frame.d, X_.data());
}

}  // namespace slapstick::flow
