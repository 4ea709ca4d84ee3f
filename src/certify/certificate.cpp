/// Writes certificates: the lines of docs/reference/certificate.md, segment by segment.
#include "slapstick/certify/certificate.hpp"

#include <utility>
#include <vector>

#include "base/set_bits.hpp"
#include "certify/stated_model.hpp"
#include "flow/engine.hpp"
#include "flow/mode_graph.hpp"

namespace slapstick::certify {

class Certificate::Writer {
 public:
  Writer(const System& system, const State& start, std::function<void(const std::string&)> write);
  void run(Instant end, const std::function<bool(Instant)>& go_on);
  void finish();
  [[nodiscard]] const Tally& tally() const { return tally_; }
  [[nodiscard]] Instant time() const { return motion_.time(); }

 private:
  static constexpr double windows_per_piece = 8.0;

  void segment(bool ended_by_event);
  [[nodiscard]] static std::string stops_of(std::uint32_t set);
  void blows();
  void line(const char* word, const std::string& rest) { text_ += word + rest + "\n"; }
  void hand_over();
  [[nodiscard]] static std::string clock(Instant at) { return number(at.period) + hex(at.fraction); }
  [[nodiscard]] std::string mechanical(std::span<const double> X) const;

  Motion motion_;
  const flow::CompiledSystem& system_;
  const flow::Engine& engine_;
  std::function<void(const std::string&)> write_;
  std::string text_;
  long seen_ = 0;    ///< segments of the motion
  long shaken_ = 0;  ///< limits of chatter that shake another contact
  Tally tally_;
};

Certificate::Writer::Writer(const System& system, const State& start, std::function<void(const std::string&)> write)
    : motion_(system, start),
      system_(motion_.system().compiled()),
      engine_(motion_.engine()),
      write_(std::move(write)),
      text_(stated_model(system_)) {
  std::string state;
  for (const double x : start) state += hex(x);
  line("start", clock(motion_.time()) + state);
}

void Certificate::Writer::hand_over() {
  write_(text_);
  text_.clear();
}

/// Displacements and velocities of an extended state.
std::string Certificate::Writer::mechanical(std::span<const double> X) const {
  std::string text;
  for (int i = 0; i < 2 * system_.frame().d; ++i) text += hex(X[static_cast<std::size_t>(i)]);
  return text;
}

void Certificate::Writer::run(Instant end, const std::function<bool(Instant)>& go_on) {
  for (;;) {
    const double piece = windows_per_piece * system_.mode(motion_.mode_id()).window_in_periods();
    const Instant stage = std::min(end, motion_.time().plus(piece));
    const Outcome outcome = motion_.advance(stage);
    if (motion_.counters().segments != seen_) segment(outcome == Outcome::event);
    seen_ = motion_.counters().segments;
    if (outcome == Outcome::event && motion_.event().kind == EventKind::impact) {
      line("impact", number(motion_.event().contact) + hex(motion_.event().w));
      ++tally_.impacts;
    }
    hand_over();
    if (!go_on(motion_.time()) || (outcome == Outcome::reached_end && stage == end)) return;
  }
}

/// The segment that the motion has just flown. A chatter's segment begins at rest at its stop: what happened at the end
/// of the segment before says it.
void Certificate::Writer::segment(bool ended_by_event) {
  const Motion::Segment segment = motion_.segment();
  const std::string chatter = stops_of(engine_.chattered());
  if (!chatter.empty()) line("chatter", chatter);
  line("segment", number(tally_.segments++) + clock(segment.start) + hex(segment.duration) +
                      stated_contacts(system_.states(segment.mode)));
  line("state", mechanical(engine_.extended_at_start()));
  if (!chatter.empty())
    line("end chatter", chatter);
  else
    line(ended_by_event && !engine_.hits().empty() ? "end event" : "end cut", "");
  tally_.chatters += chatter.empty() ? 0 : 1;
  tally_.unproved += motion_.counters().shaken - shaken_;
  shaken_ = motion_.counters().shaken;
  blows();
}

std::string Certificate::Writer::stops_of(std::uint32_t set) {
  std::string text;
  for (const int stop : set_bits(set)) text += number(stop);
  return text;
}

void Certificate::Writer::blows() {
  for (const Motion::Strike& strike : motion_.strikes()) {
    line(strike.to_rest ? "pile-up" : "blow", stops_of(strike.stops));
    tally_.unproved += strike.to_rest ? 1 : 0;
  }
}

void Certificate::Writer::finish() {
  line("done", number(tally_.segments) + clock(motion_.time()) + mechanical(engine_.extended()));
  hand_over();
}

Certificate::Certificate(const System& system, const State& start, std::function<void(const std::string&)> write)
    : writer_(std::make_unique<Writer>(system, start, std::move(write))) {}
Certificate::Certificate(Certificate&& other) noexcept = default;
Certificate::~Certificate() = default;

void Certificate::run(Instant end, const std::function<bool(Instant)>& go_on) { writer_->run(end, go_on); }
void Certificate::finish() { writer_->finish(); }
const Tally& Certificate::tally() const { return writer_->tally(); }
Instant Certificate::time() const { return writer_->time(); }

}  // namespace slapstick::certify
