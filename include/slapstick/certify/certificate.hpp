#pragma once
/// A run written down as a certificate: every segment with its state, the proofs of its guards, and what happened at
/// its end.
///
/// docs/certificate.md has the format. The program `slapstick-verify` checks it, and shares no code with the library.
/// The proofs are found anew from the modes and the states; the event kernel that drives the motion is not used, so
/// that they are a second opinion on it.
///
/// Threads: one Certificate belongs to one thread at a time. Source: docs/certainty.md.
#include <functional>
#include <memory>
#include <string>

#include "slapstick/flow/motion.hpp"

namespace slapstick::certify {

struct Tally {
  long segments = 0, guards = 0, steps = 0;
  long touches = 0;   ///< zeros that could not be decided with 256 bits
  long chatters = 0;  ///< limits of complete chatter
  long unproved = 0;  ///< guards whose steps do not reach their limit: the verifier will say so
};

/// Follows a motion of its own from `start` at phase 0. What was moved from may only be destroyed.
class Certificate {
 public:
  /// @param write  takes the text, some lines at a time
  /// @throws InputError as Motion; what `write` throws goes through here and below
  Certificate(const System& system, const State& start, std::function<void(const std::string&)> write);
  Certificate(Certificate&& other) noexcept;
  ~Certificate();

  /// Runs to `end`, or until `go_on(now)`, asked some times per period, returns false. Long flights are cut into
  /// pieces, which changes no event. @throws NumericalError as Motion::advance
  void run(Instant end, const std::function<bool(Instant)>& go_on);
  /// The last line; nothing comes after it.
  void finish();

  [[nodiscard]] const Tally& tally() const;
  [[nodiscard]] Instant time() const;

 private:
  class Writer;
  std::unique_ptr<Writer> writer_;
};

}  // namespace slapstick::certify
