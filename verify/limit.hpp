#pragma once
/// The limit of a complete chatter: that infinitely many impacts follow, when they end, and in which state
/// (docs/developers/proofs.md, section 8).
///
/// S is the state at rest on the stop, v the speed at which the pair leaves it, w the pair's velocity towards the stop.
/// An impact changes velocities by b dw, b the column of the inertia that belongs to the stop, divided by its own
/// entry. What is left of a mode's A without b times the row of w is N: Z - b w changes at the rate N Z, and jumps at
/// no impact. The pair leaves the stop in the mode `rise` and returns in the mode `back`; without friction on the pair
/// they are one. In the mode `hold` friction would hold the pair off the stop.
#include "flight.hpp"

namespace verify {

class Limit {
 public:
  struct Modes {
    const FlownMode &rise, &back, &hold, &closed;
  };
  Limit(const Mechanics& mechanics, const Segment& segment, const Modes& modes, Balls S, Ball v, const Refuse& refuse);
  /// @param sizes  that the state's allowance is made of
  /// @returns by how much DURATION may be off, in time units
  double check(const std::vector<double>& sizes);

 private:
  struct Range {
    Ball least, most;
  };
  void set_quiet_part();
  bool enclose();
  [[nodiscard]] Range acceleration(const FlownMode& mode) const;
  void conditions(const FlownMode& mode, const char* way) const;
  void other_stops() const;
  double time() const;
  void state(const std::vector<double>& sizes) const;
  void holds_not() const;
  [[nodiscard]] bool of_pair(const Condition& condition) const;
  void refuse(const std::string& what) const { refuse_(segment_.end_line, what); }

  const Mechanics& m_;
  const Segment& segment_;
  Modes modes_;
  std::size_t stop_;
  Place place_;
  std::size_t u_;
  Ball v_;
  const Refuse& refuse_;
  Balls b_, S_, size_;  ///< size_: |S|
  Matrix N_;            ///< the greatest |N| of the modes, entry by entry
  Matrix more_;         ///< the greatest |N - A of the closed mode|
  Ball D_;              ///< the chatter lasts no longer
  Balls delta_;         ///< |Z - S| is no more
  Range rise_, back_;   ///< accelerations towards the stop
};

}  // namespace verify
