#pragma once
/// One segment flown in balls, from its start to its end, and all that is claimed of its guards on the way.
///
/// The segment is cut at every start of a step and at every limit. About each cut p the guards are Taylor series; a
/// step that starts at p is held against h(p) and h'(p), and each step that covers the piece from p to the next cut
/// against h'' there.
#include <functional>
#include <string>

#include "flow.hpp"

namespace verify {

/// Takes the line of the file and what is wrong.
using Refuse = std::function<void(long, const std::string&)>;

[[nodiscard]] std::string digits(double x);

/// What is counted, and the largest of what is allowed to be small. Times in forcing periods.
struct Tally {
  long segments = 0, guards = 0, steps = 0, rests = 0, touches = 0, chatters = 0, ties = 0, flats = 0, events = 0,
       impacts = 0;
  double delta = 0.0;  ///< DELTA
  double tie = 0.0;    ///< by what the LIMIT of a guard that vanishes together with another is shorter than DURATION
  double flat =
      0.0;  ///< DELTA, or what LIMIT is short by, of zeros that rounding leaves open for longer than an instant
  double jump = 0.0;  ///< in units of its allowance
};

class Flight {
 public:
  Flight(const Flow& flow, const Mode& mode, const Segment& segment, double period, Tally& tally, const Refuse& refuse);
  void fly();

  Balls X;                   ///< at the end
  std::vector<double> size;  ///< of what X was added up from: the most along the segment

 private:
  struct Proof {
    const Claim* claim = nullptr;
    std::size_t step = 0;
  };

  void collect();
  bool steps_follow(const Claim& claim);
  void limit_reaches(const Claim& claim);
  void note_flat(double length);
  [[nodiscard]] std::vector<double> cuts();
  void order(const Expansion& about, const Claim& claim);
  void piece(const Expansion& about, double from, double to);
  void at_rest(const Series& h, const Claim& claim, const Ball& t, double size_there);
  void step(const Expansion& about, Proof& proof, double from, double to);
  void lower_bound(const Series& f, const Claim& claim, const Step& step, double from, double to);
  void flat(const Series& h, const Claim& claim, const Ball& t, double allowed, const char* why);
  void end();
  [[nodiscard]] double size_of(std::size_t guard, const std::vector<double>& sizes) const;
  void refuse(long line, std::size_t guard, const std::string& what) const;

  const Flow& flow_;
  const Mode& mode_;
  const Segment& segment_;
  double period_;
  Tally& tally_;
  const Refuse& refuse_;
  std::vector<Proof> proofs_;  ///< by guard; those whose claim is consistent in itself
};

}  // namespace verify
