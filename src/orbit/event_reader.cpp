/// Reads the events of a motion as the ends of an orbit's legs.
#include "orbit/event_reader.hpp"

#include <bit>
#include <utility>

#include "base/ranges.hpp"
#include "flow/collision.hpp"
#include "flow/contact_state.hpp"
#include "flow/engine.hpp"
#include "flow/instant_parts.hpp"
#include "flow/saltation.hpp"
#include "orbit/kept.hpp"
#include "slapstick/orbit/special_point.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::VectorXd;

/// The events of an instant, as the ends of legs: guards that do not act on each other end one each. Where their order
/// matters they end one leg together, which has no derivative.
std::vector<flow::InstantPart> separate_parts(const flow::Engine& engine, bool differentiable) {
  std::vector<flow::InstantPart> all = flow::parts_of_instant(engine), apart;
  const flow::CompiledSystem& system = engine.system();
  const auto& guards = system.mode(engine.segment().mode).guards();
  for (flow::InstantPart& part : all) {
    const bool joins = !differentiable || ranges::any_of(apart, [&](const flow::InstantPart& other) {
      return flow::share_mass(system.frame(), guards[other.guard], guards[part.guard]);
    });
    if (apart.empty() || !joins) {
      apart.push_back(std::move(part));
      continue;
    }
    apart.back().strikes.insert(apart.back().strikes.end(), part.strikes.begin(), part.strikes.end());
    apart.back().after = std::move(part.after);
  }
  return apart;
}

/// The contact index of the first signal (System::contact_name).
int first_signal(const Model& model) {
  return static_cast<int>(model.stops.size() + model.frictions.size() + model.compliant_stops.size() +
                          model.characteristics.size());
}

/// The points of signals at one instant end a leg each. Those behind the first are tied.
/// Pulses come at their own ends, and between them no contact holds what the first has moved: the states are those
/// behind. Where stops bear them or are hit, all come at the last end: together they say which stops.
std::vector<Leg> ends_at_knots(const flow::Engine& engine, Leg leg) {
  const mode::Frame& frame = engine.system().frame();
  const Instant now = engine.event().time;
  const std::vector<int> behind = frame.lines_at(now);
  std::vector<Leg> all;
  std::vector<int> pulses;
  bool moved = false;
  leg.ending = Ending::knot;
  for (std::size_t k = 0; k < frame.signals.size(); ++k) {
    if (!frame.signals[k].has_knot(now)) continue;
    leg.contact = static_cast<int>(k);
    leg.event_contact = first_signal(engine.system().model()) + leg.contact;
    leg.pulses = {leg.contact};  // the signal may have no pulse at these values of the parameters
    pulses.push_back(leg.contact);
    moved = moved || frame.signals[k].pulse(now) != 0.0;
    all.push_back(leg);
    leg.lines[k] = behind[k];
    leg.tied = true;
  }
  const mode::ContactStates& after = engine.system().mode(engine.mode_id()).states();
  const bool together = !engine.strikes().empty();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (together) all[i].pulses.clear();
    if (moved && !together && i > 0) all[i].states = after;
  }
  if (together) all.back().pulses = std::move(pulses);
  all.back().strikes = flow::separated_strikes(frame, engine.strikes());
  // The last is called by what the points make happen, if that is more than the points themselves.
  const auto events = engine.events_of_instant();
  const auto more = ranges::find_if(events, [](const Event& event) { return event.kind != EventKind::knot; });
  if (more != events.end()) all.back().event = more->kind, all.back().event_contact = more->contact;
  return all;
}

/// Is it a limit of a body that friction holds? Where a motion settles it may have drawn such a one along until it is
/// just not drawn along any more: it touches its limit in each cycle, and rests on.
bool may_rest(const flow::CompiledSystem& system, const mode::Guard& guard) {
  const bool holds = guard.kind == mode::GuardKind::stick_above || guard.kind == mode::GuardKind::stick_below;
  return holds && may_be_drawn_along(system.model().frictions[static_cast<std::size_t>(guard.contact)]);
}

/// The limit of a complete chatter, or a pile-up by its first stop.
void end_by_chatter(const flow::Engine& engine, Leg& leg) {
  leg.ending = Ending::chatter;
  const std::uint32_t named = std::uint32_t{1} << static_cast<unsigned>(leg.contact);
  leg.chattering = engine.chattered() != 0 ? engine.chattered() : named;
  leg.contact = std::bit_width(leg.chattering) - 1;  // of the impacts before, each a leg, its is the last
  leg.strikes.assign(engine.strikes().begin(), engine.strikes().end());
}

/// What the end of a leg is called: by the event of its contact, else by the first of the instant.
void name_end(const Motion& motion, const mode::Guard& guard, Leg& leg) {
  const auto events = motion.engine().events_of_instant();
  const int contact = mode::contact_index(guard.kind, guard.contact, motion.system().model());
  const auto own = ranges::find(events, contact, &Event::contact);
  const Event& event = own != events.end() ? *own : motion.event();
  leg.event = event.kind;
  leg.event_contact = event.contact;
}

}  // namespace

/// What ended the last segment; nothing for a touch that changes nothing.
void EventReader::read() {
  const flow::Engine& engine = motion_.engine();
  const flow::CompiledSystem& system = engine.system();
  const mode::Mode& before = system.mode(motion_.segment().mode);
  Leg leg;
  leg.states = before.states();
  leg.lines = system.frame().lines_at(motion_.segment().start);
  leg.event = motion_.event().kind;
  leg.event_contact = leg.contact = motion_.event().contact;
  const double t = motion_.event().time.since({zero_, 0.0});
  const VectorXd last = flow::contact_state(motion_);
  if (leg.event == EventKind::chatter) {
    end_by_chatter(engine, leg);
    read_.push_back({leg, t, last});
    return;
  }
  if (leg.event == EventKind::knot) {
    const VectorXd X_before = Eigen::Map<const VectorXd>(engine.extended_before().data(), before.size());
    const VectorXd first = flow::contact_state(system.frame(), X_before);
    for (const Leg& end : ends_at_knots(engine, leg)) read_.push_back({end, t, first});
    read_.back().x = last;
    return;
  }
  const mode::Guard* hit = engine.hit_guard();
  if (hit != nullptr && leg.event == EventKind::graze && may_rest(system, *hit)) return;
  touched_ = hit == nullptr || leg.event == EventKind::graze;
  // A force that has come to zero up to rounding may come to zero again: what changes no mode is no event.
  if (touched_ || (motion_.segment().mode == motion_.mode_id() && motion_.strikes().empty())) return;
  leg.differentiable = flow::differentiable(engine);
  const std::vector<flow::InstantPart> parts = separate_parts(engine, leg.differentiable);
  VectorXd X = Eigen::Map<const VectorXd>(engine.extended_before().data(), before.size());
  const mode::Frame& frame = system.frame();
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const mode::Guard& guard = before.guards()[parts[k].guard];
    leg.kind = guard.kind;
    leg.contact = guard.contact;
    leg.strikes = parts[k].strikes;
    if (parts.size() > 1) name_end(motion_, guard, leg);
    for (const Motion::Strike& strike : leg.strikes) {
      const flow::Collision collision(system.model(), frame, strike, X);
      flow::push_along(frame, collision.rows, collision.factor, X.segment(frame.d, frame.d));
    }
    read_.push_back({leg, t, k + 1 == parts.size() ? last : flow::contact_state(frame, X)});
    leg.states = parts[k].after;
    leg.tied = true;
  }
}

std::optional<Seen> EventReader::next(Instant end) {
  const long seen = motion_.counters().segments;
  Instant stage = motion_.time();
  while (read_.empty() && !stopped(stop_)) {
    stage = next_stage(motion_.system(), stage, end);
    if (motion_.advance(stage) != Outcome::event) {
      if (stage >= end) return std::nullopt;
      continue;
    }
    if (motion_.counters().segments == seen) continue;  // a further event of the instant before
    read();
    if (touched_) return std::nullopt;
  }
  if (read_.empty()) return std::nullopt;
  Seen first = std::move(read_.front());
  read_.pop_front();
  return first;
}

}  // namespace slapstick::orbit
