#pragma once
/// One segment flown in balls, and the proof that no condition of its mode fails on the way.
///
/// The segment is cut into pieces of about a radian. In each piece a condition h is a Taylor series with |h''| <= M,
/// and h + h' t - M t^2 / 2 a parabola below it: from a place where h > 0 one step leads to where the parabola
/// vanishes. A condition that vanishes up to rounding at the start is led by the first of its derivatives that does
/// not.
/// Where a condition is no more than rounding the parabola leads nowhere. Such a *band* is allowed at the segment's end
/// (there the condition ends it) and, counted as a touch, where the condition is positive again behind it.
#include <algorithm>
#include <functional>
#include <string>

#include "flow.hpp"
#include "mechanics.hpp"

namespace verify {

/// Takes the line of the file and what is wrong.
using Refuse = std::function<void(long, const std::string&)>;

[[nodiscard]] std::string digits(double x);

inline constexpr double rounding = 0x1p-40;        ///< of sums, in units of the sizes of what is added
inline constexpr double start_rounding = 0x1p-44;  ///< the same, of a zero at the start
inline constexpr double instant = 0x1p-30;         ///< events within it, in periods, are at one instant

/// A mode with what its conditions are flown by.
struct FlownMode {
  const Mechanics& mechanics;
  const Mode& mode;
  Flow flow;
  Flow in_coordinates;  ///< of (q, q', phases, 1)
  FlownMode(const Mechanics& mechanics, const Mode& mode);
};

/// The order of a condition's zero at X: the first derivative that is no rounding.
/// If as many derivatives vanish as a state has numbers, all do (Cayley and Hamilton): the condition rests.
struct Order {
  int order = 0;
  bool rests = false;
  bool rises = true;    ///< that derivative is positive; else it is negative, and `value` says what
  bool certain = true;  ///< false: one before is positive, if only by rounding, and is `order`
  double value = 0.0;
};
/// @param h  with `terms_at_start` terms at least
[[nodiscard]] Order order_at(const Flow& flow, std::size_t condition, const Series& h,
                             const std::vector<double>& sizes);

[[nodiscard]] inline std::size_t terms_at_start(const Balls& X) { return std::max<std::size_t>(X.size(), 8) + 8; }

struct FlightTally {
  long conditions = 0, rests = 0, touches = 0, flats = 0;
  double band = 0.0;  ///< the longest one, in periods
};

class Flight {
 public:
  Flight(const FlownMode& flown, const Segment& segment, Balls X, double period, FlightTally& tally,
         const Refuse& refuse);
  void fly();
  [[nodiscard]] bool failed() const { return failed_; }
  /// At the end the condition has not been certainly positive since it last was no more than rounding.
  [[nodiscard]] bool in_band(std::size_t condition) const { return proofs_[condition].in_band; }

  Balls X;                          ///< at the end
  std::vector<double> size;         ///< of what X was added up from: the most along the segment
  std::vector<double> coordinates;  ///< the same of q and q'
  std::vector<std::size_t> zeros;   ///< conditions that are zero at the end, up to rounding

 private:
  /// How far a condition has been proved.
  struct Proof {
    bool rests = false, in_band = false;
    double band_begin = 0.0;
  };
  /// One condition on one piece: h = f t^drop.
  struct Piece {
    std::size_t condition;
    const Series& f;
    ulong drop;
    double begin, length, allowed;
    Ball M;
  };

  void start(const Expansion& about);
  void piece(const Expansion& about, double from, double to, bool first);
  void walk(const Piece& piece);
  double through_band(const Piece& piece, double t);
  void leave_band(Proof& proof, double at);
  void grow_sizes(double L);
  void end();
  void refuse(std::size_t condition, const std::string& what) const;

  const FlownMode& flown_;
  const Segment& segment_;
  double period_;
  FlightTally& tally_;
  const Refuse& refuse_;
  std::vector<Proof> proofs_;
  std::vector<ulong> drops_;
  bool failed_ = false;
};

}  // namespace verify
