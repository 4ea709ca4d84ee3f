#pragma once
/// Branches of periodic orbits: pseudo-arclength continuation in one parameter, with every point at which something
/// changes.
///
/// An orbit is followed with its sequence of events fixed. Between two points of the branch each of the following is
/// watched for a change of sign. The change is refined on the branch until the parameter no longer changes (1e-13 of
/// the range; by interpolation where the equations are singular).
///
///   LP  fold: the branch turns back in the parameter            PD  a multiplier -1: period doubling
///   NS  a pair of multipliers e^{+-2 pi i rho}                   BP  a multiplier +1, no fold: a symmetry breaks
///   GR  a stop is touched, an impact's speed goes to zero        SL  stick is gained or lost
///   CH  a complete chatter begins or ends                       CO  two events meet
///
/// The last four change the sequence. There the sequence is built anew from what the motion does beyond, and the branch
/// goes on: in the same direction (*persistence*), or back (*non-smooth fold*). The branch ends where the motion makes
/// a *jump* (from a stable orbit what it goes over to is named), and where the orbit grows without bound. Further ends:
/// the orbits beyond are *one of a family*, isolated no more; no orbit of the new sequence was found whose branch comes
/// from there (*none found*). Every point is checked by the certified simulator; one that is no motion has `is_motion`
/// false, and says why.
///
/// Source: Doedel, Keller and Kernevez (1991), Govaerts (2000) for the test functions; di Bernardo et al. (2008) for GR
/// and SL.
/// Cost: some orbits solved, one System and one cycle of the simulator a point; a change of events runs many motions.
/// Threads: functions may be called at once; `stop`, if it is not null and becomes true, ends one early, `progress` is
/// called by the thread that called it.
#include <atomic>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "slapstick/orbit/special_point.hpp"

namespace slapstick::orbit {

/// Why one way along a branch ends.
struct BranchEnd {
  enum class Kind : std::uint8_t {
    range,            ///< the parameter has come to the end of its range
    closed,           ///< the branch has come round to its first orbit
    no_model,         ///< the model has no meaning beyond; `detail` says why
    special,          ///< at a special point: its passage says why
    over_itself,      ///< the branch runs over itself
    unbounded,        ///< the orbit grows without bound as the parameter hardly moves
    most_points,      ///< as many points as are allowed
    stopped,          ///< the caller's wish
    led_back,         ///< failed: what was found beyond the last change of events leads back over the branch
    too_many_events,  ///< failed: a cycle of more events than are followed
    no_step,          ///< failed: no step leads on; `detail` says why
    no_change,        ///< failed: the motion has other events than the orbit, and no change was found; `detail`: which
    refused           ///< failed: an error, in `detail`
  };
  Kind kind = Kind::range;
  bool failed = false;  ///< what is beyond is not known: a step or change was not mastered, or the branch was stopped
  double value = 0.0;   ///< of the parameter there
  std::optional<std::size_t> special = {};  ///< kind special: which of the branch's points
  long limit = 0;                           ///< kind most_points, too_many_events: the most allowed
  std::string detail = {};                  ///< an error's own text
};
[[nodiscard]] std::string_view name(BranchEnd::Kind kind);

struct Branch {
  std::string parameter;  ///< its name
  std::vector<Solution> points;
  std::vector<SpecialPoint> special;
  BranchEnd down, up;  ///< before the first point and after the last; both `closed` for a closed branch

  [[nodiscard]] bool failed() const { return down.failed || up.failed; }
};

struct ContinuationOptions {
  double from = 0.0, to = 0.0;  ///< range of the parameter; the branch is followed both ways from the first orbit
  int most_points = 1000;       ///< each way
  double step = 0.01;           ///< first and
  double longest_step = 0.02;  ///< .. largest arclength; 1 is the whole range, or a change of the orbit by its own size
  double shortest_step = 1e-8;
  bool through_changes = true;  ///< go on with a new sequence of events
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double value, long points)> progress = {};
};

/// Follows the branch through `start`, an orbit that solves its equations, in the family's first parameter.
/// @throws InputError if `start` is outside the range
[[nodiscard]] Branch follow(const Problem& posed, const Orbit& start, const ContinuationOptions& options);

/// Changes that gather at the onset of a complete chatter, each with `impacts` impacts more than the one before.
struct Cascade {
  std::size_t onset = 0;  ///< index of the CH among the branch's special points
  /// the special points on the way to it, between the first change and the last, both included
  std::size_t first = 0, last = 0;
  long changes = 0;  ///< of events, among these
  long impacts = 0;  ///< that each adds
};
/// At least three changes each, on either side of an onset.
[[nodiscard]] std::vector<Cascade> cascades(const Branch& branch);

/// Is an orbit one of the branch's, wherever it begins? By Newton's method from the points beside it to the branch's
/// own orbit at its parameter.
[[nodiscard]] bool lies_on(const Problem& problem, const Branch& branch, const Orbit& orbit);
/// Is it the image of one: half a forcing period later, with all displacements reversed about a point or as they are?
/// False without forcing.
[[nodiscard]] bool image_lies_on(const Problem& problem, const Branch& branch, const Orbit& orbit);

/// Follows the branch through an orbit, one of SpecialPoint::born. Adds this branch to the branches, unless it is one
/// of these, the image of one, or outside the range of `options`.
/// @param images  the branch whose image it is, if it is one, is added
/// @returns true if there is a branch more
bool follow_born(const Problem& problem, std::vector<Branch>& branches, const Orbit& born,
                 const ContinuationOptions& options, std::vector<std::size_t>& images);

struct CurvePoint {
  std::vector<double> values;  ///< of the two parameters
  Solution solution;           ///< is_motion: no other margin than the point's own is used up
};

/// One condition more that holds at a point of a curve: a point of codimension two.
struct Meeting {
  enum class Kind : std::uint8_t {
    multiplier,    ///< as at a special point of type LP, PD, NS
    resonance,     ///< 1:1 to 1:4: `order`
    end_of_torus,  ///< the resonance at which an NS curve ends: both multipliers are 1 (`order` 1) or -1 (2)
    margin,        ///< another margin is used up: the events change
    turn           ///< the curve turns back in parameter `parameter`
  };
  Kind kind = Kind::margin;
  SpecialType type = SpecialType::GR;  ///< kind multiplier, margin
  int order = 0;
  std::size_t parameter = 0;
  UsedMargin margin = {};
  friend bool operator==(const Meeting& a, const Meeting& b);
};
/// "PD", "R2", "turn": as of a special point, that of the condition.
[[nodiscard]] std::string name(const Meeting& meeting);

/// A point of codimension two on a curve; several conditions that come to hold at one place stand together.
struct CurveEvent {
  std::vector<Meeting> met;  ///< the first names it
  std::vector<double> values;
  std::size_t after = 0;
};

/// Why one way along a curve ends.
struct CurveEnd {
  enum class Kind : std::uint8_t {
    range,
    most_points,
    stopped,
    end_of_torus,  ///< a resonance 1:1 or 1:2, beyond which two multipliers are real: the last event of the curve
    no_step        ///< failed: no step leads on
  };
  Kind kind = Kind::range;
  bool failed = false;
  std::vector<double> values = {};   ///< of the parameters there
  std::optional<Meeting> near = {};  ///< kind no_step: what comes near zero and may be the cause
  bool infinite_multiplier = false;  ///< .. or a multiplier that grows without bound
};
[[nodiscard]] std::string_view name(CurveEnd::Kind kind);

struct Curve {
  std::vector<std::string> parameters;  ///< the names of both
  Itinerary shape;                      ///< the events along it
  std::vector<CurvePoint> points;
  std::vector<CurveEvent> met;
  CurveEnd down, up;

  [[nodiscard]] bool failed() const { return down.failed || up.failed; }
};

struct CurveOptions {
  double from = 0.0, to = 0.0;                ///< range of the first
  double second_from = 0.0, second_to = 0.0;  ///< .. and the second parameter
  double longest_step = 0.01;                 ///< arclength in units of both ranges and the orbit's size
  int most_points = 500;                      ///< each way
  const std::atomic<bool>* stop = nullptr;
  std::function<void(long points)> progress = {};
};

/// The locus of a special point, found in the family's first parameter, when the second varies too.
[[nodiscard]] Curve locus(const Problem& problem, const SpecialPoint& point, const CurveOptions& options);

/// How a sensitivity is known.
enum class Known : std::uint8_t {
  from_both_sides,
  from_one_side,  ///< the parameter is at a bound: there is no model, or no orbit, beyond
  unsettled,      ///< not known: differences over ever shorter steps do not agree, or two ways to it
  not_solved      ///< not known: no point was found beside this one
};
/// "from_both_sides", "from_one_side", "unsettled", "not_solved".
[[nodiscard]] std::string_view name(Known known);
struct Sensitivity {
  double value;  ///< not a number where it is not known
  Known known;
};

/// d value / d (each parameter of `full`, a family whose first parameters are those of the branch's), along which the
/// special point persists.
/// @param range  that the branch was followed over, the unit of its parameter; 0: the size of the parameter's value
[[nodiscard]] std::vector<Sensitivity> sensitivities(const Family& full, const std::vector<double>& values,
                                                     const SpecialPoint& point, double range = 0.0);
/// Their values only.
[[nodiscard]] std::vector<double> sensitivity(const Family& full, const std::vector<double>& values,
                                              const SpecialPoint& point, double range = 0.0);

}  // namespace slapstick::orbit
