#pragma once
/// Branches of periodic orbits: pseudo-arclength continuation in one parameter, with every point at which something changes.
///
/// An orbit is followed with its sequence of events fixed. Between two points of the branch each of these is watched for a change of sign, and the
/// change is refined on the branch until the parameter no longer changes (1e-13 of the range; by interpolation where the equations are singular):
///
///   LP  fold: the branch turns back in the parameter            PD  a multiplier -1: period doubling
///   NS  a pair of multipliers e^{+-2 pi i rho}                   BP  a multiplier +1 that is no fold: branches cross, a symmetry breaks
///   GR  a stop is touched, or an impact's speed has gone to zero    SL  stick is gained or lost
///   CH  a complete chatter begins or ends                       CO  two events meet
///
/// The last four change the sequence. There the sequence is built anew from what the motion does beyond, and the branch goes on: in the same
/// direction (*persistence*), or back (*non-smooth fold*). It ends where the motion makes a *jump* (from a stable orbit what it goes over to is
/// named), where the orbits beyond are *one of a family*, isolated no more, where it grows without bound, and where no orbit of the new sequence
/// was found whose branch comes from there (*none found*). Every point is checked by the certified simulator; one that is no motion has
/// `is_motion` false, and says why.
///
/// Source: Doedel, Keller and Kernevez (1991), Govaerts (2000) for the test functions; di Bernardo et al. (2008) for GR and SL.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "slapstick/orbit/periodic_orbit.hpp"

namespace slapstick::orbit {

enum class SpecialType : std::uint8_t { LP, PD, NS, BP, GR, SL, CH, CO };
[[nodiscard]] std::string_view name(SpecialType type);

/// The first coefficient beyond the linear terms: LP a, PD c, NS l1 (src/orbit/normal_form.hpp has formulas, units and what follows from it).
struct NormalForm {
  std::optional<double> coefficient;
  double error = 0.0;  ///< of it
  std::string what;    ///< "supercritical", "subcritical"; or why there is no coefficient
};

struct SpecialPoint {
  SpecialType type = SpecialType::LP;
  double value = 0.0;   ///< of the parameter
  double error = 0.0;   ///< of it: the last change of the refinement, or what rounding leaves
  Solution solution;    ///< the orbit there ..
  bool beside = false;  ///< .. or one beside it, where a motion dies out and its equations are singular
  std::string what;     ///< "the gap of stop touches zero in leg 2", "stick of block is lost"
  std::string outcome;  ///< of a change of events: "persistence", "non-smooth fold", "jump to 1-2-I", "none found", ..
  double rotation = 0.0;    ///< NS: rho in (0, 1/2)
  bool birth = false;       ///< PD: seen from the doubled orbit, whose branch begins there
  std::vector<Orbit> born;  ///< orbits from which other branches that begin here or cross can be followed
  std::size_t after = 0;    ///< it lies behind this point of the branch
  std::size_t test = 0;     ///< GR, SL, CH, CO: which of the orbit's margins is zero (src/orbit/margins.hpp)

  NormalForm normal_form;  ///< of LP, PD, NS
};

struct Branch {
  std::vector<Solution> points;
  std::vector<SpecialPoint> special;
  std::string
      ended;  ///< why it ends: "range", "closed", "1000 points each way, the most allowed", or what went wrong, with the last good value
  bool failed = false;  ///< what is beyond its end is not known: a step or change was not mastered, or it was stopped
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

/// Is an orbit one of the branch's, wherever it begins? By Newton's method from the points beside it to the branch's own orbit at its parameter.
[[nodiscard]] bool lies_on(const Problem& problem, const Branch& branch, const Orbit& orbit);
/// Is it the image of one: half a forcing period later, with all displacements reversed about a point or as they are? False without forcing.
[[nodiscard]] bool image_lies_on(const Problem& problem, const Branch& branch, const Orbit& orbit);

struct CurvePoint {
  std::vector<double> values;  ///< of the two parameters
  Solution solution;           ///< is_motion: no other margin than the point's own is used up
};

/// What else happens on a curve: a point of codimension two.
struct CurveEvent {
  std::string
      type;  ///< as of a special point, that of the other condition; "R1" to "R4" for the resonances 1:1 to 1:4; "turn" of the curve
  std::string
      what;  ///< "a multiplier passes -1", "the events change: ..", "the curve turns back in NAME"; several that are one point
  std::vector<double> values;
  std::size_t after = 0;
};

struct Curve {
  std::vector<CurvePoint> points;
  std::vector<CurveEvent> met;
  std::string ended;
  bool failed = false;
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

/// d value / d (each parameter of `full`, a family whose first parameters are those of the branch's), along which the special point persists.
[[nodiscard]] std::vector<double> sensitivity(const Family& full, const std::vector<double>& values,
                                              const SpecialPoint& point);

}  // namespace slapstick::orbit
