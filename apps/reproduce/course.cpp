/// Times the parts of a run, shows progress, and leaves when the run is cancelled.
#include "reproduce/course.hpp"

namespace slapstick::paper {
namespace {

double seconds_since(std::chrono::steady_clock::time_point then) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

}  // namespace

Course::Course(const Options& options, std::vector<PlannedPart> plan)
    : options_(options), plan_(std::move(plan)), begin_(std::chrono::steady_clock::now()), part_begin_(begin_) {
  for (const PlannedPart& part : plan_) total_weight_ += part.weight;
}

void Course::next() {
  end_part();
  check();
  ++current_;
  part_begin_ = std::chrono::steady_clock::now();
  step(0, 1);
}

void Course::step(int done, int total) {
  if (!options_.progress) return;
  const std::scoped_lock lock(report_);
  const PlannedPart& part = plan_.at(static_cast<std::size_t>(current_));
  Progress progress{part.name, 0.0, elapsed(), 0.0};
  progress.fraction = (weight_before_ + part.weight * done / total) / total_weight_;
  if (progress.fraction > 0.0) progress.left_s = progress.elapsed_s * (1.0 / progress.fraction - 1.0);
  options_.progress(progress);
}

void Course::finish() { end_part(); }

void Course::check() const {
  if (options_.cancel != nullptr && options_.cancel->load(std::memory_order_relaxed)) throw Interrupted{};
}

double Course::elapsed() const { return seconds_since(begin_); }

void Course::end_part() {
  if (current_ < 0) return;
  const std::scoped_lock lock(report_);
  const PlannedPart& part = plan_.at(static_cast<std::size_t>(current_));
  parts_.push_back({part.name, seconds_since(part_begin_)});
  weight_before_ += part.weight;
  if (options_.part_finished) options_.part_finished(parts_.back());
}

}  // namespace slapstick::paper
