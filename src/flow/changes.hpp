#pragma once
/// What a choice of mode tells: the event that asked for the choice, and which other contacts have other states than
/// before. Motions and lanes tell by the same rules.
///
/// Rows of one kind are in the order of the contacts: which of several zeros at one instant comes first in a search is
/// rounding, and nobody sees it. Of the contacts on one pair one speaks: their state is that of the pair. A friction
/// contact that an impulse turns round is not told: the impact says it.
///
/// Cost: no allocation; a comparison for each contact. Source: docs/explanation/mode_graph.md.
#include <cstdint>
#include <optional>
#include <span>

#include "mode/frame.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::flow {

/// What has ended a mode.
struct Ended {
  std::optional<mode::GuardKind> kind;  ///< of the guard that was zero; none: the limit of a chatter, a knot
  int contact = -1;                     ///< of that guard, counted among those of its kind
  std::optional<EventKind> own;         ///< what the event itself is, unless told before: impact, graze, chatter, knot
  bool reversal = false;                ///< a velocity has come to zero, and none by an impulse
  std::uint32_t struck = 0;             ///< stops that got an impulse at this instant, bit by bit
  std::uint32_t rested = 0;             ///< friction contacts whose velocity came to zero too
  bool start = false;  ///< nothing: an impact at a motion's start, before which the forces were not asked
};

template <class Tell>
class Changes {
 public:
  /// @param tell  called as tell(kind, contact) for each row in order, the contact in the numbering of Event
  Changes(const Model& model, const mode::Frame& frame, const Ended& ended, const mode::ContactStates& old,
          const mode::ContactStates& now, Tell tell)
      : model_(model), frame_(frame), ended_(ended), old_(old), now_(now), tell_(tell) {}

  void tell() {
    const bool released = ended_.own == EventKind::release;
    if (released) of_releases();
    if (!ended_.start) {
      of_compliant_stops();
      of_characteristics();
      of_loads();
    }
    of_velocities();
    of_closings();
    if (!released) of_releases();
  }

 private:
  using Friction = mode::FrictionState;
  using Compliant = mode::CompliantState;

  void of_compliant_stops() {
    for (std::size_t i = 0; i < now_.compliant.size(); ++i) {
      const int contact = first_compliant() + static_cast<int>(i);
      if (is_own(i, of_compliant))
        tell_own(contact, old_.compliant[i] != now_.compliant[i]);
      else if (old_.compliant[i] != now_.compliant[i])
        tell_(kind_of(old_.compliant[i], now_.compliant[i]), contact);
    }
  }

  void of_characteristics() {
    const int first = first_compliant() + static_cast<int>(now_.compliant.size());
    for (std::size_t i = 0; i < now_.pieces.size(); ++i) {
      if (is_own(i, mode::of_corner))
        tell_own(first + static_cast<int>(i), old_.pieces[i] != now_.pieces[i]);
      else if (old_.pieces[i] != now_.pieces[i])
        tell_(EventKind::corner, first + static_cast<int>(i));
    }
  }

  /// One that held alone and is unloaded now has been released; one that holds at once sticks. Both are told below. A
  /// compliant stop that begins or ends to act speaks for what it presses.
  void of_loads() {
    for (std::size_t i = 0; i < now_.frictions.size(); ++i) {
      const bool free = now_.frictions[i] == Friction::unloaded, was_free = old_.frictions[i] == Friction::unloaded;
      if (is_own(i, mode::of_load)) tell_own(first_friction() + static_cast<int>(i));
      if (free == was_free || is_own(i, mode::of_load) || is_reversed(i)) continue;
      const bool told_below =
          (old_.frictions[i] == Friction::stick && !loses_its_share(i)) || now_.frictions[i] == Friction::stick;
      if (told_below || stop_changes(i)) continue;
      tell_(free ? EventKind::unload : EventKind::load, first_friction() + static_cast<int>(i));
    }
  }

  /// Stick, and what a velocity that came to zero goes on as.
  void of_velocities() {
    for (std::size_t i = 0; i < now_.frictions.size(); ++i) {
      const int contact = first_friction() + static_cast<int>(i);
      if (now_.frictions[i] == Friction::stick) {
        if (old_.frictions[i] != Friction::stick) tell_(EventKind::stick, contact);
      } else if (is_reversed(i)) {
        tell_(now_.frictions[i] == Friction::slip_plus    ? EventKind::slip_plus
              : now_.frictions[i] == Friction::slip_minus ? EventKind::slip_minus
                                                          : EventKind::unload,
              contact);
      }
    }
  }

  void of_closings() {
    for (std::size_t i = 0; i < now_.stops.size(); ++i) {
      const bool closes = now_.stops[i] == mode::StopState::closed && old_.stops[i] == mode::StopState::open;
      if (closes && !sticks_too(frame_.stops[i])) tell_(EventKind::stick, static_cast<int>(i));
    }
  }

  /// The event's own, and of contacts on other pairs: its change of force, or its impulse, has let them go. What lets
  /// go a contact of a pair that is struck is told by the impact.
  void of_releases() {
    for (std::size_t i = 0; i < now_.frictions.size(); ++i) {
      const bool released = old_.frictions[i] == Friction::stick && now_.frictions[i] != Friction::stick;
      const int contact = first_friction() + static_cast<int>(i);
      if (is_own(i, of_hold))
        tell_own(contact);
      else if (released && !loses_its_share(i) && !of_pair(frame_.frictions[i]) && !is_struck(frame_.frictions[i]) &&
               !another_speaks(i))
        tell_(EventKind::release, contact);
    }
    for (std::size_t i = 0; i < now_.stops.size(); ++i) {
      const bool released = old_.stops[i] == mode::StopState::closed && now_.stops[i] == mode::StopState::open;
      const bool struck = (ended_.struck >> i & 1U) != 0;  // its impact says it all
      if (is_own(i, of_press))
        tell_own(static_cast<int>(i));
      else if (released && !struck && !of_pair(frame_.stops[i]))
        tell_(EventKind::release, static_cast<int>(i));
    }
  }

  /// Is the release of a friction contact that of a stop of its pair, or of a contact before it? As in a pair whose
  /// own event it is.
  [[nodiscard]] bool another_speaks(std::size_t i) const {
    const int own = frame_.frictions[i].own;
    for (std::size_t k = 0; k < now_.stops.size(); ++k) {
      const bool released = old_.stops[k] == mode::StopState::closed && now_.stops[k] == mode::StopState::open;
      if (released && frame_.parallel(frame_.stops[k].own, own) != 0) return true;
    }
    for (std::size_t k = 0; k < i; ++k) {
      const bool released = old_.frictions[k] == Friction::stick && now_.frictions[k] != Friction::stick;
      if (released && frame_.parallel(frame_.frictions[k].own, own) != 0) return true;
    }
    return false;
  }

  static EventKind kind_of(Compliant old, Compliant now) {
    if (old == Compliant::off) return EventKind::engage;
    if (now == Compliant::off) return old == Compliant::detached ? EventKind::separate : EventKind::disengage;
    if (now == Compliant::detached) return EventKind::disengage;
    return old == Compliant::detached ? EventKind::engage : EventKind::corner;
  }

  static bool of_compliant(mode::GuardKind kind) {
    using mode::GuardKind;
    return kind == GuardKind::engage || kind == GuardKind::leave || kind == GuardKind::let_go ||
           kind == GuardKind::push || kind == GuardKind::bound || kind == GuardKind::beyond;
  }

  static bool of_hold(mode::GuardKind kind) {
    return kind == mode::GuardKind::stick_above || kind == mode::GuardKind::stick_below;
  }

  static bool of_press(mode::GuardKind kind) { return kind == mode::GuardKind::press; }

  /// @param changes  the state of its contact. One that an impact of the instant has turned back just there does not
  void tell_own(int contact, bool changes = true) {
    if (ended_.own && (changes || ended_.struck == 0)) tell_(*ended_.own, contact);
  }

  [[nodiscard]] bool is_own(std::size_t i, bool (*of)(mode::GuardKind)) const {
    return ended_.kind && of(*ended_.kind) && ended_.contact == static_cast<int>(i);
  }

  /// A velocity that was zero at this instant, and went on without sticking.
  [[nodiscard]] bool is_reversed(std::size_t i) const {
    if (now_.frictions[i] == Friction::stick) return false;
    if (ended_.reversal && ended_.kind == mode::GuardKind::slip && ended_.contact == static_cast<int>(i)) return true;
    const bool asked = ended_.reversal || (ended_.rested >> i & 1U) != 0;
    return asked && old_.frictions[i] != now_.frictions[i] && old_.frictions[i] != Friction::stick;
  }

  /// A contact that held its pair with others, or at a closed stop, has lost its normal force.
  [[nodiscard]] bool loses_its_share(std::size_t i) const {
    if (old_.frictions[i] != Friction::stick || now_.frictions[i] != Friction::unloaded) return false;
    for (std::size_t k = 0; k < now_.stops.size(); ++k)
      if (old_.stops[k] == mode::StopState::closed &&
          frame_.parallel(frame_.stops[k].own, frame_.frictions[i].own) != 0)
        return true;
    for (std::size_t k = 0; k < now_.frictions.size(); ++k)
      if (k != i && frame_.parallel(frame_.frictions[k].own, frame_.frictions[i].own) != 0) return true;
    return false;
  }

  [[nodiscard]] bool stop_changes(std::size_t friction) const {
    const int stop = model_.frictions[friction].normal->compliant_stop;
    return stop >= 0 &&
           old_.compliant[static_cast<std::size_t>(stop)] != now_.compliant[static_cast<std::size_t>(stop)];
  }

  /// Whether a friction contact of the pair sticks now.
  [[nodiscard]] bool sticks_too(const mode::ContactRow& stop) const {
    for (std::size_t i = 0; i < now_.frictions.size(); ++i) {
      const bool sticks = now_.frictions[i] == Friction::stick && old_.frictions[i] != Friction::stick;
      if (sticks && frame_.parallel(frame_.frictions[i].own, stop.own) != 0) return true;
    }
    return false;
  }

  /// Whether a stop of the contact's pair has got an impulse.
  [[nodiscard]] bool is_struck(const mode::ContactRow& contact) const {
    for (std::size_t k = 0; k < frame_.stops.size(); ++k)
      if ((ended_.struck >> k & 1U) != 0 && frame_.parallel(frame_.stops[k].own, contact.own) != 0) return true;
    return false;
  }

  /// Whether the event is one of the contact's pair.
  [[nodiscard]] bool of_pair(const mode::ContactRow& contact) const {
    if (!ended_.kind) return false;
    const bool on_stop = ended_.kind == mode::GuardKind::gap || ended_.kind == mode::GuardKind::press;
    if (!on_stop && !mode::of_friction(*ended_.kind) && !mode::of_load(*ended_.kind)) return false;
    const auto at = static_cast<std::size_t>(ended_.contact);
    const mode::ContactRow& own = on_stop ? frame_.stops[at] : frame_.frictions[at];
    return frame_.parallel(own.own, contact.own) != 0;
  }

  [[nodiscard]] int first_friction() const { return static_cast<int>(now_.stops.size()); }
  [[nodiscard]] int first_compliant() const { return first_friction() + static_cast<int>(now_.frictions.size()); }

  const Model& model_;
  const mode::Frame& frame_;
  const Ended& ended_;
  const mode::ContactStates &old_, &now_;
  Tell tell_;
};

}  // namespace slapstick::flow
