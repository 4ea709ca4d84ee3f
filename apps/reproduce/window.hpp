#pragma once
/// Windows of one kind of motion along omega, and their edges, enclosed in 5e-5 where nothing hides them.
///
/// An edge is found from inside: the attractor is carried step by step until its class is no longer the wanted one.
/// From the last place inside it goes on in steps of a third as long, until the step is below the tolerance. So an edge
/// is where *this* attractor ends or changes; if another one coexists there, the edges of both are found, each from its
/// own side.
///
/// Near a loss of stability attraction is weak: a class is denied somewhat before the cycle loses its stability. How
/// far before, the multipliers tell to first order (`Edge::hidden`).
#include "reproduce/study.hpp"

namespace slapstick::paper {

using Wanted = std::function<bool(const Classification&)>;

/// A multiplier as near the unit circle as this makes attraction weak.
inline constexpr double weakly_attracting = 0.98;

/// The end of a window. The class changes between `inside` and `outside`, as far as can be told.
struct Edge {
  Found inside, outside;
  Found beyond;         ///< a little further on, after a long transient: what the motion becomes
  bool found = false;   ///< false: the class holds up to the limit of the search (inside.omega)
  double hidden = 0.0;  ///< so far beyond `inside` the multipliers reach the unit circle; 0 if they are not near
  [[nodiscard]] double omega() const { return found ? 0.5 * (inside.omega + outside.omega) : inside.omega; }
  /// So far from omega() the true edge may be; 0 if no edge was found. Not half the step from `inside` to `outside` but
  /// the whole: near a grazing a cycle's basin becomes as small as what a step changes, and the motion may leave it too
  /// early. Twice `hidden`, because the modulus of a multiplier does not grow evenly (at a fold by a square root).
  [[nodiscard]] double within() const;
};

struct Window {
  bool found = false;
  Edge lower, upper;
  [[nodiscard]] double width() const { return upper.omega() - lower.omega(); }
};

struct Search {
  double step = 0.01;
  double tolerance = 5e-5;  ///< |outside - inside| at the end; the edge is its middle
  double beyond = 1e-3;     ///< how far outside `Edge::beyond` lies
};

/// Follows the attractor from `seed`, which is wanted, towards `limit`.
[[nodiscard]] Edge follow(const Study& study, const Overrides& with, const Found& seed, double limit,
                          const Wanted& wanted, const Search& search = {});

/// Both edges of the window around `seed`, within [from, to]. Not found if the seed is not wanted.
[[nodiscard]] Window around(const Study& study, const Overrides& with, const Found& seed, double from, double to,
                            const Wanted& wanted, const Search& search = {});

/// n forcing periods, p impacts, not more.
[[nodiscard]] Wanted cycle(int n, long p);
/// The same with (II) or without (I) a stick phase.
[[nodiscard]] Wanted cycle(int n, long p, bool sticking);

/// Classes along omega, each attractor carried on to the next value, up or down. [from, to] in steps of `step`. Not
/// parallel.
[[nodiscard]] std::vector<Found> survey(const Study& study, const Overrides& with, double from, double to, double step,
                                        bool up);

/// Neighbours of a survey with the same label, as one.
struct Run {
  std::string label;
  Attractor attractor;
  double from, to;
  int count;
};
[[nodiscard]] std::vector<Run> runs(const std::vector<Found>& survey);

}  // namespace slapstick::paper
