#pragma once
/// The event section: the events of one kind of a motion, each seen just before it happens. The section needs neither
/// stops nor forcing: it is the return map of autonomous systems, as of a mass that a belt drags along until it slips.
/// Shapes, threads and cost are those of the Motion that a section carries.
#include <limits>
#include <optional>

#include "slapstick/flow/stage.hpp"

namespace slapstick {

/// Which events are points: all of a kind, or those of one contact (System::contact_name).
struct EventChoice {
  EventKind kind = EventKind::stick;
  std::optional<int> contact;

  [[nodiscard]] bool takes(const Event& event) const {
    return event.kind == kind && (!contact || event.contact == *contact);
  }
};

/// Reads "stick", "release:belt". @throws InputError naming the kinds, or the model's contacts
[[nodiscard]] EventChoice parse_event_choice(const std::string& text, const System& system);

struct EventPoint {
  Instant time;
  int contact = 0;
  double w = 0.0;  ///< as Event::w
  /// Time since the point before, in time units; NaN for the first.
  double return_time = std::numeric_limits<double>::quiet_NaN();
  State state;  ///< just before the event, user's coordinates
};

class EventSection {
 public:
  /// Takes the motion over; its System must outlive the section.
  EventSection(Motion motion, EventChoice choice) : motion_(std::move(motion)), choice_(choice) {}

  /// Moves on to the next point, or to `end` if none comes first. No allocation once `point.state` has its size.
  /// @param stop  null: cannot be stopped
  /// @returns false if `end` was reached or `stop` was set; `point` is then unchanged
  /// @throws NumericalError as Motion::advance
  bool next(Instant end, EventPoint& point, const std::atomic<bool>* stop = nullptr);

  [[nodiscard]] const Motion& motion() const { return motion_; }

 private:
  Motion motion_;
  EventChoice choice_;
  std::optional<Instant> last_;
};

}  // namespace slapstick
