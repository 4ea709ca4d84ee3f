#pragma once
/// A run written down as a certificate (docs/certificate.md): every segment with its state, the proofs of its guards, and what happened at
/// its end.
#include <functional>
#include <set>
#include <string>

#include "slapstick/certify/limit_proof.hpp"
#include "slapstick/certify/segment_proof.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::certify {

struct Tally {
  long segments = 0, guards = 0, steps = 0;
  long touches = 0;   ///< zeros that could not be decided with 256 bits
  long chatters = 0;  ///< limits of complete chatter
  long unproved = 0;  ///< guards whose steps do not reach their limit: the verifier will say so
};

/// Follows a motion of its own from `start` to `end`. Long flights are cut every `windows_per_piece` windows, which changes nothing.
class Certificate {
 public:
  /// @param write  takes the text, some lines at a time
  Certificate(const System& system, const State& start, std::function<void(const std::string&)> write);

  /// Runs to `end`, or until `go_on(now)`, asked some times per period, returns false. @throws NumericalError as Motion::advance
  void run(Instant end, const std::function<bool(Instant)>& go_on);
  /// The last line; nothing comes after it.
  void finish();

  [[nodiscard]] const Tally& tally() const { return tally_; }
  [[nodiscard]] Instant time() const { return motion_.time(); }

 private:
  static constexpr double windows_per_piece = 8.0;

  void head();
  void mode(ModeId id);
  void segment(bool ended_by_event);
  void guards(SegmentProof& proof, bool ended_by_event);
  GuardProof guard(SegmentProof& proof, int g, double limit);
  void print(int g, const GuardProof& proof);
  void hit(SegmentProof& proof);
  void blows();
  LimitProof limit() const;
  void end_chatter(const LimitProof& proof);
  void line(const char* word, const std::string& rest);

  const System& system_;
  Motion motion_;
  std::function<void(const std::string&)> write_;
  std::string text_;
  std::set<ModeId> shown_;
  std::vector<double> magnitude_;
  std::vector<double> begun_;  ///< the motion's extended state before it went on ..
  ModeId begun_in_ = 0;        ///< .. and the mode of its flight
  long seen_ = 0;              ///< segments of the motion
  Tally tally_;
};

}  // namespace slapstick::certify
