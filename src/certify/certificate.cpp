/// Writes certificates: the lines of docs/certificate.md, segment by segment.
#include "slapstick/certify/certificate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>
#include <vector>

#include "certify/limit_proof.hpp"
#include "certify/segment_proof.hpp"
#include "flow/engine.hpp"
#include "flow/mode_graph.hpp"

namespace slapstick::certify {
namespace {

std::string hex(double x) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), " %a", x);
  return text.data();
}

std::string number(long long k) { return " " + std::to_string(k); }

/// " n j v j v ..": what is not zero in a row.
std::string entries(const mode::RowVector& row) {
  std::string text;
  long count = 0;
  for (Eigen::Index j = 0; j < row.size(); ++j) {
    if (row[j] == 0.0) continue;
    text += number(j) + hex(row[j]);
    ++count;
  }
  return number(count) + text;
}

}  // namespace

class Certificate::Writer {
 public:
  Writer(const System& system, const State& start, std::function<void(const std::string&)> write);
  void run(Instant end, const std::function<bool(Instant)>& go_on);
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
  [[nodiscard]] LimitProof limit() const;
  void end_chatter(const LimitProof& proof);
  void line(const char* word, const std::string& rest);

  Motion motion_;
  const flow::CompiledSystem& system_;
  const flow::Engine& engine_;
  std::function<void(const std::string&)> write_;
  std::string text_;
  std::set<ModeId> shown_;
  std::vector<double> magnitude_;
  std::vector<double> begun_;  ///< the motion's extended state before it went on ..
  ModeId begun_in_ = 0;        ///< .. and the mode of its flight
  long seen_ = 0;              ///< segments of the motion
  Tally tally_;
};

Certificate::Writer::Writer(const System& system, const State& start, std::function<void(const std::string&)> write)
    : motion_(system, start),
      system_(motion_.system().compiled()),
      engine_(motion_.engine()),
      write_(std::move(write)) {
  magnitude_.assign(static_cast<std::size_t>(system_.frame().size()), 0.0);
  head();
}

void Certificate::Writer::line(const char* word, const std::string& rest) { text_ += word + rest + "\n"; }

void Certificate::Writer::head() {
  const mode::Frame& frame = system_.frame();
  line("slapstick-certificate", number(1));
  line("model", " " + system_.model().name);
  line("sizes", number(frame.size()) + number(frame.d));
  line("period", hex(system_.period()));
  for (std::size_t k = 0; k < frame.stops.size(); ++k) {
    const Stop& stop = system_.model().stops[k];
    line("stop", number(static_cast<long>(k)) + number(frame.stops[k].own) + hex(frame.stops[k].sign) +
                     hex(stop.restitution) + " " + stop.name);
  }
  for (int i = 0; i < frame.d; ++i) {
    std::string row = number(i);
    for (int j = 0; j < frame.d; ++j) row += hex(frame.mass_inverse(i, j));
    line("inertia", row);
  }
}

void Certificate::Writer::mode(ModeId id) {
  if (!shown_.insert(id).second) return;
  const mode::Mode& mode = system_.mode(id);
  line("mode", number(id) + " " + system_.mode_name(id));
  for (Eigen::Index i = 0; i < mode.system().rows(); ++i) {
    if (!mode.system().row(i).isZero(0.0)) line("row", number(i) + entries(mode.system().row(i)));
  }
  for (int g = 0; g < mode.guard_count(); ++g)
    line("guard", number(g) + " " + std::string(name(mode.guards()[g].kind)) + entries(mode.guards()[g].row));
}

void Certificate::Writer::run(Instant end, const std::function<bool(Instant)>& go_on) {
  for (;;) {
    const double piece = windows_per_piece * system_.mode(motion_.mode_id()).window_in_periods();
    const Instant stage = std::min(end, motion_.time().plus(piece));
    begun_.assign(engine_.extended().begin(), engine_.extended().end());
    begun_in_ = motion_.mode_id();
    const Outcome outcome = motion_.advance(stage);
    if (motion_.counters().segments != seen_) segment(outcome == Outcome::event);
    seen_ = motion_.counters().segments;
    if (outcome == Outcome::event) {
      const Event& event = motion_.event();
      line("event", " " + std::string(name(event.kind)) + " " + system_.contact_name(event.contact) + hex(event.w));
    }
    write_(text_);
    text_.clear();
    if (!go_on(motion_.time()) || (outcome == Outcome::reached_end && stage == end)) return;
  }
}

/// The segment that the motion has just flown. A chatter's segment begins at rest at its stop: the last impact's end
/// says so.
void Certificate::Writer::segment(bool ended_by_event) {
  const Motion::Segment segment = motion_.segment();
  const bool chatter = ended_by_event && motion_.event().kind == EventKind::chatter && engine_.hits().empty();
  LimitProof limit;
  if (chatter) {
    limit = this->limit();
    line("blow", number(1) + number(motion_.event().contact));
    for (const ModeId id : {limit.rise, limit.back, limit.hold}) mode(id);
  }
  mode(segment.mode);
  line("segment", number(tally_.segments++) + number(segment.mode) + number(segment.start.period) +
                      hex(segment.start.fraction) + hex(segment.duration));
  std::string state;
  for (int i = 0; i < system_.frame().size(); ++i) state += hex(engine_.extended_at_start()[i]);
  line("state", state);
  SegmentProof proof(system_.mode(segment.mode), engine_.extended_at_start().data(), segment.duration);
  const bool zero = ended_by_event && !engine_.hits().empty();
  guards(proof, ended_by_event);
  if (zero)
    hit(proof);
  else if (chatter)
    end_chatter(limit);
  else
    line("end cut", "");
  tally_.chatters += chatter ? 1 : 0;
  blows();
}

/// All guards but the one whose zero ends the segment. Others that vanish with it are proved up to some roundings
/// before.
void Certificate::Writer::guards(SegmentProof& proof, bool ended_by_event) {
  const Motion::Segment segment = motion_.segment();
  const auto mechanical = 2 * static_cast<std::size_t>(system_.frame().d);
  for (std::size_t i = 0; i < magnitude_.size(); ++i)
    magnitude_[i] = i < mechanical ? std::abs(engine_.extended_at_start()[i]) : 1.0;  // as Motion measures rounding
  if (segment.duration == 0.0) return;
  for (int g = 0; g < system_.mode(segment.mode).guard_count(); ++g) {
    if (ended_by_event && !engine_.hits().empty() && engine_.hits().front() == g) continue;
    print(g, guard(proof, g, ended_by_event ? proof.positive_until(g) : segment.duration));
  }
}

GuardProof Certificate::Writer::guard(SegmentProof& proof, int g, double limit) {
  const Motion::Segment segment = motion_.segment();
  const int order = flow::start_order(system_.mode(segment.mode), g, engine_.extended_at_start().data(), magnitude_.data());
  if (order == flow::never) return {flow::never, limit, true, {}};
  if (order == flow::negative) return {0, limit, false, {}};  // nothing can be proved; the verifier says so
  return proof.prove(g, order, limit);
}

void Certificate::Writer::print(int g, const GuardProof& proof) {
  ++tally_.guards;
  if (!proof.reached) ++tally_.unproved;
  if (proof.order == flow::never) return line("rest", number(g));
  line("prove", number(g) + number(proof.order) + hex(proof.limit));
  for (const Step& step : proof.steps)
    line("step", hex(step.s) + hex(step.h) + hex(step.h1) + hex(step.M) + hex(step.d));
  tally_.steps += static_cast<long>(proof.steps.size());
}

/// The guard whose zero ends the segment. Where 256 bits cannot tell a zero from a touch, the proof ends where they
/// cannot.
void Certificate::Writer::hit(SegmentProof& proof) {
  const double duration = motion_.segment().duration;
  const int g = engine_.hits().front();
  if (duration == 0.0) return line("end zero", number(g) + hex(0.0));
  const Zero zero = proof.zero_at_end(g);
  GuardProof found = guard(proof, g, zero.certain ? duration - zero.delta : duration);
  if (!zero.certain && !found.reached) found.end_at_last_step();
  print(g, found);
  if (zero.certain) return line("end zero", number(g) + hex(zero.delta));
  ++tally_.touches;
  line("end touch", number(g) + hex(proof.size_from(g, found.limit)));
}

/// The flight of the chatter was to begin at the last impact.
LimitProof Certificate::Writer::limit() const {
  const int stop = motion_.event().contact;
  const Motion::Segment segment = motion_.segment();
  const double v = -flow::approach_velocity(system_, stop, begun_.data());
  return prove_limit(system_, stop, begun_in_, segment.mode, engine_.extended_at_start().data(), v, segment.duration);
}

void Certificate::Writer::end_chatter(const LimitProof& proof) {
  line("tail", number(proof.rise) + number(proof.back) + number(proof.hold) + hex(proof.longest) +
                   hex(proof.rise_least) + hex(proof.rise_most) + hex(proof.fall_least) + hex(proof.fall_most));
  line("end chatter", number(motion_.event().contact) + hex(proof.error));
}

void Certificate::Writer::blows() {
  for (const Motion::Strike& strike : motion_.strikes()) {
    std::string stops = number(strike.to_rest ? 1 : 0);
    for (int stop = 0; stop < static_cast<int>(system_.frame().stops.size()); ++stop)
      if ((strike.stops >> stop & 1U) != 0) stops += number(stop);
    line("blow", stops);
  }
}

void Certificate::Writer::finish() {
  line("done", number(tally_.segments));
  write_(text_);
  text_.clear();
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
