#pragma once
/// The impact section: the sequence of impacts of a motion, each seen just before it happens. The sequence may be that
/// of some stops only, and a compliant stop takes part by its engagements (section/stop_choice.hpp): "impact" stands
/// for both here.
///
/// The impact section is the paper's Poincare section (eq. 8): y = b, w > 0. Between two of its points lie a *flight*
/// and, in it, the time in which the friction contact slips. The paper's t_f is called "sliding time" in its text and
/// is plotted as the flight.
///
///     |<------------- flight ------------->|
///     impact   slip-   stick   slip+   impact          time in forcing periods (units of 1 without forcing)
///              |-----|         |------|    sliding = sum of the two
///
/// The limit of a complete chatter counts as the end of its last flight: the impact after a chatter has a flight that
/// begins there. Events of stops that were not chosen end no flight.
/// Shapes, threads and cost are those of the Motion that a section carries.
#include <functional>
#include <limits>

#include "slapstick/section/stop_choice.hpp"

namespace slapstick {

struct SectionPoint {
  Instant time;
  double w = 0.0;  ///< v_a - v_b of the stop's pair just before the impact, > 0, in the model's unit of velocity
  /// Time since the impact (or chatter limit) before, in forcing periods; NaN if the motion has had none since its
  /// start.
  double flight = std::numeric_limits<double>::quiet_NaN();
  /// The part of `flight` in which a friction contact slips, in forcing periods; 0 without friction contacts, NaN where
  /// flight is.
  double sliding = std::numeric_limits<double>::quiet_NaN();
  double phase = 0.0;  ///< of the forcing, as a fraction of a period in [0, 1)
  int contact = 0;     ///< the stop that is hit: System::contact_name
  State state;         ///< just before the impact, user's coordinates
};

/// How often something else happened since the last point.
struct Between {
  long sticks = 0, reversals = 0, releases = 0, grazes = 0, chatters = 0;
};

/// Walks a Motion from impact to impact. A copy is an independent motion that goes on from the same instant with the
/// same bits.
class ImpactSection {
 public:
  /// Takes the motion over; its System must outlive the section.
  explicit ImpactSection(Motion motion, StopChoice stops = {})
      : motion_(std::move(motion)), stops_(stops), seen_(motion_.time()) {}

  /// Moves on to the next impact and writes it into `point`, or to `end` if none comes first.
  /// No allocation once `point.state` has its size. An impact exactly at `end` is a point.
  /// @returns false if `end` was reached; `point` is then unchanged and the motion stands at `end`
  /// @throws NumericalError as Motion::advance
  bool next(Instant end, SectionPoint& point);

  /// Other events, of any contact, since the last point (or, before the first, since the section was made).
  [[nodiscard]] const Between& between() const { return between_; }

  /// Called after every event, impacts included, while the motion stands there. Must not outlive what it refers to.
  void watch(std::function<void(const Motion&)> watcher) { watcher_ = std::move(watcher); }

  [[nodiscard]] const Motion& motion() const { return motion_; }

 private:
  void note(const Event& event);
  void begin_flight();

  Motion motion_;
  StopChoice stops_;
  std::function<void(const Motion&)> watcher_;
  Instant seen_;  ///< up to here sliding_ is summed
  Instant last_;  ///< the impact or chatter limit before
  bool has_last_ = false;
  bool point_given_ = false;
  double sliding_ = 0.0;
  Between between_;
};

}  // namespace slapstick
