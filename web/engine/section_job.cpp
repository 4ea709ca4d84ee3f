/// Walks a motion from point to point of a section.
#include "section_job.hpp"

#include "slapstick/base/error.hpp"

namespace slapstick::web {
namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

}  // namespace

SectionJob::SectionJob(const Choice& choice, const SectionWish& wish)
    : wish_(wish), system_(choice.model()), motion_(Motion(system_, choice.start_at())) {
  width_ = static_cast<int>(4 + 2 * system_.model().coordinates.size());
  if (wish.at == "impacts" && stop_contacts(system_.model()).empty())
    throw InputError("the model has no stop, so there are no impacts: choose another section");
  if (wish.at != "impacts" && wish.at != "periods") event_ = parse_event_choice(wish.at, system_);
}

bool SectionJob::work(const Deadline& deadline) {
  const Instant begin{wish_.transient, 0.0};
  if (motion_ && motion_->time() < begin) {
    if (!run_until(*motion_, begin, deadline, [] {})) return false;
    open();
  }
  if (motion_ && wish_.transient == 0) open();
  const Instant end{begin.period + 50L * wish_.points, 0.0};
  for (int looks = 1; found_ < wish_.points; ++looks) {
    if (std::holds_alternative<std::monostate>(section_)) {
      if (!next_period(deadline)) return false;
    } else if (auto* const impacts = std::get_if<ImpactSection>(&section_)) {
      const Instant stage = next_stage(system_, impacts->motion().time(), end);
      if (impacts->next(stage, impact_))
        add(impact_);
      else if (!(stage < end))
        return true;
    } else {
      auto& events = std::get<EventSection>(section_);
      const Instant stage = next_stage(system_, events.motion().time(), end);
      if (events.next(stage, point_))
        add({point_.time, point_.w, not_there, not_there, point_.time.fraction, point_.contact, point_.state});
      else if (!(stage < end))
        return true;
    }
    if (looks % 16 == 0 && deadline.passed()) return false;
  }
  return true;
}

void SectionJob::open() {
  if (event_) {
    section_.emplace<EventSection>(std::move(*motion_), *event_);
    motion_.reset();
  } else if (wish_.at == "impacts") {
    section_.emplace<ImpactSection>(std::move(*motion_));
    motion_.reset();
  }
}

bool SectionJob::next_period(const Deadline& deadline) {
  const Instant now = motion_->time();
  const Instant due{now.period + (now.fraction < wish_.phase ? 0 : 1), wish_.phase};
  if (!run_until(*motion_, due, deadline, [] {})) return false;
  add({motion_->time(), not_there, not_there, not_there, wish_.phase, -1, motion_->state()});
  return true;
}

void SectionJob::add(const SectionPoint& point) {
  rows_.insert(rows_.end(), {point.phase, point.w, point.flight, static_cast<double>(point.contact)});
  rows_.insert(rows_.end(), point.state.begin(), point.state.end());
  ++found_;
}

}  // namespace slapstick::web
