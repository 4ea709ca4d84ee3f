#pragma once
/// The events of a motion as the ends of an orbit's legs.
#include <Eigen/Core>
#include <atomic>
#include <cstdint>
#include <deque>
#include <optional>

#include "slapstick/flow/stage.hpp"
#include "slapstick/orbit/itinerary.hpp"

namespace slapstick::orbit {

/// An event as the end of a leg, and the contact state behind it.
struct Seen {
  Leg leg;
  double t;  ///< periods since the start of period `zero`
  Eigen::VectorXd x;
};

/// The events of a motion that end legs, one after the other. Of events at one instant that do not act on each other
/// each is told by itself.
class EventReader {
 public:
  /// @param motion  outlives the reader
  EventReader(Motion& motion, std::int64_t zero, const std::atomic<bool>* stop = nullptr)
      : motion_(motion), zero_(zero), stop_(stop) {}

  /// Runs on to the next event, or to `end`. @returns empty at the end, or after a graze
  [[nodiscard]] std::optional<Seen> next(Instant end);
  /// From here on instants count from the start of another period.
  void count_from(std::int64_t zero) {
    for (Seen& seen : read_) seen.t -= static_cast<double>(zero - zero_);
    zero_ = zero;
  }
  [[nodiscard]] bool touched() const { return touched_; }  ///< a graze has ended the reading

 private:
  void read();

  Motion& motion_;
  std::int64_t zero_;
  const std::atomic<bool>* stop_;
  std::deque<Seen> read_;  ///< of the last instant, and not told
  bool touched_ = false;
};

}  // namespace slapstick::orbit
