#pragma once
/// A run written down as a certificate: the model in exact numbers, the start, every segment with its contacts and its
/// state, what happened at its end, and the end of the run.
///
/// docs/reference/certificate.md has the format. The program `slapstick-verify` checks it against the model, by
/// mechanics and arithmetic of its own: it shares no code with the library. Nothing here claims a proof.
///
/// Threads: one Certificate belongs to one thread at a time. Source: docs/reference/certificate.md.
#include <functional>
#include <memory>
#include <string>

#include "slapstick/flow/motion.hpp"

namespace slapstick::certify {

struct Tally {
  long segments = 0, impacts = 0;
  long chatters = 0;  ///< limits of complete chatter
  /// Pile-ups, which are rest after impacts without end at one instant, assumed and not proved; and limits of chatter
  /// whose impacts may move another friction contact to and fro through its rest, which the verifier refuses.
  long unproved = 0;
};

/// Refuses a model that certificates cannot hold, before anything is computed. @throws InputError saying what it has
void demand_stated(const Model& model);

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
