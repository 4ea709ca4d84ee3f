#pragma once
/// The proof that a guard has no zero along a segment, as numbers that anyone can check (docs/certificate.md).
///
/// A step claims h(s) >= h, h'(s) >= h1 and |h''| <= M on [s, s + d]; the parabola h + h1 t - M t^2 / 2 is then a lower
/// bound of the guard, and it is positive on [0, d]. Steps are found anew from A and the state at the segment's start:
/// nothing of the event kernel is used, so that the proof is a second opinion on it. They are looked for with a 64-bit
/// mantissa, and with 256 bits where that does not do.
#include <memory>
#include <vector>

#include "mode/mode.hpp"

namespace slapstick::certify {

struct Step {
  double s, h, h1, M, d;
};

struct GuardProof {
  int order = 0;        ///< of the guard's zero at the start
  double limit = 0.0;   ///< no zero on (0, limit] ..
  bool reached = true;  ///< .. or false: the steps end before, and prove it up to their end only
  std::vector<Step> steps;
  /// Lowers the limit to what the steps reach, as real numbers.
  void end_at_last_step();
};

/// The zero of a guard at the end of a segment.
struct Zero {
  bool certain = false;  ///< else whether there is one cannot be decided
  double delta = 0.0;    ///< certain: the guard is positive at duration - delta and negative at duration + delta
};

template <class Real>
class Expansion;

/// Proofs for one segment.
class SegmentProof {
 public:
  /// @param mode      must outlive the object
  /// @param X         extended state at the segment's start, at least mode.size() numbers
  /// @param duration  time units, >= 0
  SegmentProof(const mode::Mode& mode, const double* X, double duration);
  ~SegmentProof();
  SegmentProof(const SegmentProof&) = delete;
  SegmentProof& operator=(const SegmentProof&) = delete;

  /// No zero on (0, limit], for a guard with a zero of this order at the start.
  [[nodiscard]] GuardProof prove(int guard, int order, double limit);
  /// The greatest limit <= duration, but for some roundings, at which the guard is certainly positive.
  [[nodiscard]] double positive_until(int guard);
  [[nodiscard]] Zero zero_at_end(int guard);
  /// A bound of |h| on [s, duration].
  [[nodiscard]] double size_from(int guard, double s);

 private:
  struct Narrow;
  struct Wide;
  auto& wide();

  const mode::Mode& mode_;
  std::vector<double> X_;
  double duration_;
  std::unique_ptr<Narrow> narrow_;
  std::unique_ptr<Wide> wide_;  ///< made when it is needed, which is rare
};

}  // namespace slapstick::certify
