#pragma once
/// The limit of a complete chatter: that infinitely many impacts follow, when they end, and in which state
/// (docs/developers/proofs.md, section 8).
///
/// Several stops that the inertia does not couple may chatter from one instant on, as in equal machines.
///
/// S is the state at rest on the stops, v the speed at which a pair leaves its stop, w the pair's velocity towards it.
/// An impact changes velocities by b dw, b the column of the inertia that belongs to the stop, divided by its own
/// entry. What is left of a mode's A without b times the row of w, of each stop, is N: Z - sum of b w changes at the
/// rate N Z, and jumps at no impact. A pair leaves its stop in a mode `leaves` and returns in `returns`, which are one
/// without friction on it; at its limit it `rests`. A *way* is a mode with each of them in one of these courses.
#include "flight.hpp"

namespace verify {

class Limit {
 public:
  enum class Course { leaves, returns, rests };
  struct Way {
    const FlownMode* mode;
    std::vector<Course> courses;  ///< of each stop that chatters
  };
  /// A way with friction holding one pair, the k-th, off its stop.
  struct Hold {
    const FlownMode* mode;
    std::size_t k;
  };
  struct Modes {
    std::vector<Way> ways;
    std::vector<Hold> holds;
    const FlownMode& closed;
  };
  Limit(const Mechanics& mechanics, const Segment& segment, Modes modes, Balls S, const Balls& v, const Refuse& refuse);
  /// @param sizes  that the state's allowance is made of
  /// @returns by how much DURATION may be off, in time units
  double check(const std::vector<double>& sizes);

 private:
  struct Range {
    Ball least, most;
  };
  struct Stop {
    std::size_t stop;
    Place place;
    std::size_t u;
    Ball v;
    Balls b;
    Range rise = {}, back = {};  ///< accelerations towards the stop
    [[nodiscard]] Ball faster() const { return back.most / rise.least; }
  };
  [[nodiscard]] bool uncoupled() const;
  void set_quiet_part();
  [[nodiscard]] Balls jump(const std::vector<Ball>& ratios) const;
  bool enclose();
  void accelerations();
  void conditions() const;
  void other_stops() const;
  [[nodiscard]] double time(const Stop& stop) const;
  void state(const std::vector<double>& sizes) const;
  void holds_not() const;
  [[nodiscard]] bool chatters(std::size_t stop) const;
  [[nodiscard]] bool in_a_way(const Condition& condition) const;
  void refuse(const std::string& what) const { refuse_(segment_.end_line, what); }

  const Mechanics& m_;
  const Segment& segment_;
  Modes modes_;
  const Refuse& refuse_;
  std::vector<Stop> stops_;
  Balls S_, size_;  ///< size_: |S|
  Matrix N_;        ///< the greatest |N| of the modes, entry by entry
  Matrix more_;     ///< the greatest |N - A of the closed mode|
  Ball D_;          ///< the chatter lasts no longer
  Balls delta_;     ///< |Z - S| is no more
};

}  // namespace verify
