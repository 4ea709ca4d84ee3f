#pragma once
/// The shape of a periodic orbit: which modes it passes, what ends each, and what happens there; and the orbit itself.
///
/// A cycle is cut at its events into *legs*. Leg i starts just after event i, in one mode, and its end is event i + 1;
/// the last leg ends at event 0, one cycle later. With the shape fixed, an orbit is a smooth function of the model's
/// parameters, also where it is no motion any more: past a graze, where it reaches beyond a stop, its equations go on.
/// So the points where shapes change are regular points. Plain data. Source: Dankowicz and Schilder (2013) for orbits
/// as sequences of segments.
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "slapstick/flow/motion.hpp"

namespace slapstick::orbit {

/// What ends a leg.
enum class Ending : std::uint8_t {
  guard,    ///< the zero of a guard of the leg's mode
  chatter,  ///< the limit of a complete chatter whose impacts after the leg's start are summed
  onset,    ///< the release with which such a chatter ends at its onset: the zero of a guard of the leg's mode
  knot,     ///< the end of a signal's piece: an instant of the clock
  cut       ///< nothing: an orbit without events, cut at phase 0
};

struct Leg {
  mode::ContactStates states;
  Ending ending = Ending::guard;
  mode::GuardKind kind = mode::GuardKind::gap;  ///< of the guard; its contact is
  int contact = 0;                              ///< .. this, or the stop that chatters, or the signal
  std::uint32_t chattering = 0;                 ///< the stops whose impacts the leg sums, bit by bit
  std::vector<int> lines;                       ///< of each signal: the straight line that it is on (mode/drive.hpp)
  std::vector<int> pulses;                      ///< of a knot: the signals whose pulses come at the end
  std::vector<Motion::Strike> strikes;          ///< the impacts at the end, in order
  EventKind event = EventKind::impact;          ///< what the end is called (the first of the events of its instant)
  int event_contact = 0;                        ///< System::contact_name
  /// Of several events at one instant that do not act on each other, as in two equal machines, each ends a leg of its
  /// own: this leg has no length, and is no leg that shrinks to nothing. `tied` is no part of the shape.
  bool tied = false;
  bool differentiable = true;  ///< false: several events of its end do act on each other, and their order matters
  friend bool operator==(const Leg& a, const Leg& b);
};

/// Do they end by the same event, whatever their modes?
[[nodiscard]] bool same_end(const Leg& a, const Leg& b);

struct Itinerary {
  std::vector<Leg> legs;
  int n = 0;  ///< forcing periods per cycle; 0 of a free motion, whose period is unknown
};

/// How often the rarest of its events happens in a cycle: what N counts for a free motion, which has no forcing
/// periods. Events are told apart by their kind, their contact and the mode before them. 0 without events.
[[nodiscard]] int returns(const Itinerary& shape);

/// A periodic orbit, or an approximation to one. A *contact state* is the first n of p and of u (flow/tangent.hpp).
struct Orbit {
  Itinerary shape;
  std::vector<double> values;  ///< of the family's parameters
  /// Contact state at the start of each leg; `at_phase_zero` and `events` (orbit/periodic_orbit.hpp) give states in the
  /// user's coordinates.
  std::vector<Eigen::VectorXd> x;
  std::vector<double> t;    ///< instants of events 0 .. k, in forcing periods (in time, without forcing): k + 1 numbers
  Eigen::VectorXd advance;  ///< along each of the model's rigid translations, per cycle

  /// The first parameter: on a branch the one that varies.
  [[nodiscard]] double parameter() const { return values.front(); }
  double& parameter() { return values.front(); }
  [[nodiscard]] std::size_t legs() const { return shape.legs.size(); }
  [[nodiscard]] bool tied(std::size_t leg) const { return shape.legs[leg].tied; }
  [[nodiscard]] double duration(std::size_t leg) const { return t[leg + 1] - t[leg]; }
};

/// Makes leg `first` the first one. Times stay in order; those of the legs before it move on by a cycle. Without
/// forcing they begin at 0 anew.
void rotate(Orbit& orbit, std::size_t first);

/// The legs that end at the instant at which a leg begins, and at which it ends: one, and those that are tied to it.
[[nodiscard]] std::vector<std::size_t> ended_at_start(const Itinerary& shape, std::size_t leg);
[[nodiscard]] std::vector<std::size_t> ended_at_end(const Itinerary& shape, std::size_t leg);

/// Has a return map with these legs a derivative? Not where contacts that act on each other meet their events at one
/// instant: what comes first decides.
[[nodiscard]] bool differentiable(const Itinerary& shape);

/// "impact wall, slip- pad, stick pad": for messages and tables.
[[nodiscard]] std::string describe(const Itinerary& shape, const System& system);

}  // namespace slapstick::orbit
