#include "catalogue/run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "catalogue/watch.hpp"
#include "io/expression.hpp"
#include "library/notes.hpp"

namespace slapstick::catalogue {
namespace {

using library::number;

/// An expectation of every event of a kind, its expressions read once.
struct Each {
  std::string kind;
  Expression value, is, within, last;
  long n = 0;
};

Expression expression(const Entry& json) {
  return Expression(json.is_string() ? json.get<std::string>() : json.dump());
}

std::vector<Each> read_each(const Entry& entry) {
  std::vector<Each> all;
  for (const Entry& one : entry.value("each", Entry::array()))
    all.push_back({one.at("kind").get<std::string>(), expression(one.at("value")), expression(one.at("is")),
                   expression(one.value("within", Entry(0))), expression(one.value("last", Entry(1e18)))});
  return all;
}

/// What is noted while a motion goes on.
class Notes {
 public:
  Notes(const Member& member, const library::Setup& setup, const Motion& motion)
      : setup_(setup), each_(read_each(member.entry)), now_(setup.values), start_(motion.time()), last_(start_) {
    record.values = setup.values;
    library::start_counts(record.values);
    for (const char* name : {"events", "grazes", "most_at_once", "most_evaluations", "phase_drift"})
      record.values[name] = 0.0;
    record.values["least_step"] = std::numeric_limits<double>::max();
    library::note_state(record.values, setup.system, motion.state(), "_start");
    record.start_mode = setup.system.mode_name(motion.mode_id());
    for (const Entry& kind : member.entry.value("watch", Entry::array()))
      watches_.push_back(make_watch(kind.get<std::string>(), setup.system));
  }

  void event(const Motion& motion) {
    Values& values = record.values;
    const Event& event = motion.event();
    library::count(motion, values);
    note_by_name(motion);
    note_times(motion);
    check_each(motion);
    for (const auto& watch : watches_) watch->event(motion, values);
    if (record.events.size() >= most_kept) return;
    Seen seen{std::string(name(event.kind)),
              setup_.system.contact_name(event.contact),
              {event.time.period - start_.period, event.time.fraction},
              {}};
    library::note_state(seen.after, setup_.system, motion.state(), "");
    record.events.push_back(std::move(seen));
  }

  void end(const Motion& motion) {
    Values& values = record.values;
    if (values["events"] > 0) library::note_event(values, motion, "_last");
    library::note_state(values, setup_.system, motion.state(), "");
    values["time"] = motion.time().seconds(setup_.system.period());
    values["windows"] = static_cast<double>(motion.counters().windows);
    values["windows_per_period"] = setup_.system.windows_per_period();
    record.mode = setup_.system.mode_name(motion.mode_id());
  }

  Record record;

 private:
  static constexpr std::size_t most_kept = 100'000, most_named = 40;

  void note_by_name(const Motion& motion) {
    Values& values = record.values;
    const auto n = static_cast<std::size_t>(++values["events"]);
    if (n <= most_named) library::note_event(values, motion, "_at" + std::to_string(n));
    std::string kind(name(motion.event().kind));
    if (const auto sign = kind.find_first_of("+-"); sign != std::string::npos)
      kind = kind.substr(0, sign) + (kind[sign] == '+' ? "_plus" : "_minus");
    if (values.count("t_" + kind) != 0) return;
    library::note_event(values, motion, "_" + kind);
    values["error_" + kind] = motion.event().error;
  }

  void note_times(const Motion& motion) {
    Values& values = record.values;
    const Event& event = motion.event();
    values["grazes"] += event.kind == EventKind::graze;
    EXPECT_GE(event.time, last_) << "an event before the one before";
    at_once_ = event.time == last_ ? at_once_ + 1 : 1;
    values["most_at_once"] = std::max(values["most_at_once"], static_cast<double>(at_once_));
    if (event.time > last_ && values["events"] > 1)
      values["least_step"] = std::min(values["least_step"], event.time.since(last_) * setup_.system.period());
    last_ = event.time;
    const auto evaluations = static_cast<double>(motion.counters().evaluations);
    values["most_evaluations"] = std::max(values["most_evaluations"], evaluations - evaluations_);
    evaluations_ = evaluations;
    if (event.kind != EventKind::impact) return;
    if (first_phase_ < 0.0) first_phase_ = event.time.fraction;
    values["phase_drift"] = std::max(values["phase_drift"], std::abs(event.time.fraction - first_phase_));
  }

  void check_each(const Motion& motion) {
    for (Each& each : each_) {
      if (!library::is(motion.event(), each.kind, setup_.system)) continue;
      library::note_event(now_, motion, "");
      now_["n"] = static_cast<double>(++each.n);
      if (now_["n"] > each.last.evaluate(now_)) continue;
      EXPECT_NEAR(each.value.evaluate(now_), each.is.evaluate(now_), each.within.evaluate(now_))
          << each.value.text() << " of " << each.kind << " " << each.n;
    }
  }

  const library::Setup& setup_;
  std::vector<Each> each_;
  std::vector<std::unique_ptr<Watch>> watches_;
  Values now_;
  Instant start_, last_;
  long at_once_ = 0;
  double evaluations_ = 0.0, first_phase_ = -1.0;
};

MotionOptions options_of(const Entry& entry) {
  MotionOptions options;
  const Entry given = entry.value("options", Entry::object());
  options.chatter_tolerance = given.value("chatter_tolerance", options.chatter_tolerance);
  options.most_events_per_period = given.value("most_events_per_period", options.most_events_per_period);
  return options;
}

/// A duration in time units, or {"periods": n} exactly.
double periods_of(const Entry& duration, const library::Setup& setup) {
  return duration.is_object() ? number(duration.at("periods"), setup.values)
                              : number(duration, setup.values) / setup.system.period();
}

}  // namespace

Record run(const Member& member, const Way& way) {
  const Entry& entry = member.entry;
  const library::Setup setup(entry, {}, member.given, way.options);
  Motion motion(setup.system, setup.start, setup.begin, options_of(entry));
  if (entry.contains("settle")) {
    const Instant end = motion.time().plus(periods_of(entry["settle"], setup));
    while (motion.advance(end) == Outcome::event) {
    }
  }
  Notes notes(member, setup, motion);
  const Instant start = motion.time(), end = motion.time().plus(periods_of(entry.at("run"), setup));
  long left = entry.value("most_events", std::numeric_limits<long>::max());
  for (long piece = 1; left > 0 && motion.time() < end; ++piece) {
    const double periods = static_cast<double>(piece) * way.piece / setup.system.period();
    const Instant next = way.piece > 0.0 ? std::min(end, start.plus(periods)) : end;
    for (; left > 0 && motion.advance(next) == Outcome::event; --left) notes.event(motion);
  }
  notes.end(motion);
  return notes.record;
}

std::string kinds(const Record& record) {
  std::string all;
  for (const Seen& event : record.events) all += (all.empty() ? "" : " ") + event.kind;
  return all;
}

}  // namespace slapstick::catalogue
