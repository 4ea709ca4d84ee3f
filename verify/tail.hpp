#pragma once
/// The limit of a complete chatter: that infinitely many impacts follow, when they end, and in which state
/// (docs/certainty.md, section 8).
///
/// S is the state at rest on the stop, v the speed at which the pair leaves it, w the pair's velocity towards the stop.
/// An impact changes velocities by b dw, b the column of the inertia that belongs to the stop, divided by its own
/// entry. What is left of a mode's A without b times the row of w is N: Z - b w changes at the rate N Z, and jumps at
/// no impact.
#include "flight.hpp"

namespace verify {

class Limit {
 public:
  /// @param rise, back, closed  the flows of the modes in which the pair leaves the stop, returns to it, rests on it
  Limit(const Head& head, const Segment& segment, const Flow& rise, const Flow& back, const Flow& closed, Ball v,
        const Refuse& refuse);
  /// Everything but the guards of the modes. @param sizes  that the state's allowance is made of
  void check(const std::vector<double>& sizes);
  /// The guards of the mode of the flight away from the stop or back: positive, but for the gap and the velocity of the
  /// pair itself.
  /// @returns whether one of them is for this direction only
  bool guards(const Mode& mode, const Flow& flow, bool rising) const;
  /// In this mode friction would hold the pair off the stop: a force limit of it is exceeded.
  void holds_not(const Mode& mode, const Flow& flow) const;

 private:
  [[nodiscard]] Balls apply_N(const Balls& x) const;
  bool enclose();
  void acceleration(const Flow& flow, double least, double most, const char* name) const;
  void other_stops() const;
  void time() const;
  void state(const std::vector<double>& sizes) const;
  [[nodiscard]] bool follows_pair(const Entries& row) const;
  void refuse(const std::string& what) const { refuse_(segment_.tail.line, what); }

  const Head& head_;
  const Segment& segment_;
  const Tail& tail_;
  const Stop& stop_;
  const Flow &rise_, &back_, &closed_;
  Ball v_;
  const Refuse& refuse_;
  std::size_t p_, u_;        ///< numbers of the pair
  Balls b_, S_, size_;       ///< size_: |S|
  std::vector<Balls> N_;     ///< the greatest |N| of the three modes, entry by entry
  std::vector<Balls> more_;  ///< the greatest |N - A of the closed mode|: rounding
  Ball fastest_;             ///< |w| is no more
  Balls delta_;              ///< |Z - S| is no more
};

}  // namespace verify
