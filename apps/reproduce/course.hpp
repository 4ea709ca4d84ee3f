#pragma once
/// The course of a run: parts, their times, progress, and the way out when it is cancelled.
#include <chrono>
#include <mutex>

#include "reproduce/reproduce.hpp"

namespace slapstick::paper {

/// Thrown inside the study when it is cancelled; `reproduce` catches it.
struct Interrupted {};

/// A part that will come, with its expected share of the time.
struct PlannedPart {
  std::string name;
  double weight;
};

class Course {
 public:
  Course(const Options& options, std::vector<PlannedPart> plan);

  /// Ends the part before and begins the next of the plan. @throws Interrupted
  void next();
  /// Within a part. From any thread.
  void step(int done, int total);
  /// Ends the last part.
  void finish();
  /// @throws Interrupted if the run was cancelled
  void check() const;

  [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
  [[nodiscard]] double elapsed() const;

 private:
  void end_part();

  const Options& options_;
  std::vector<PlannedPart> plan_;
  std::vector<Part> parts_;
  double total_weight_ = 0.0, weight_before_ = 0.0;
  int current_ = -1;
  std::chrono::steady_clock::time_point begin_, part_begin_;
  std::mutex report_;
};

}  // namespace slapstick::paper
