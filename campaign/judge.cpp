/// Holds what the engine says of a motion against the truth, segment by segment.
#include "judge.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <span>
#include <vector>

#include "flow/compiled_system.hpp"
#include "flow/engine.hpp"
#include "slapstick/base/error.hpp"

namespace campaign {
namespace {

using slapstick::EventKind;
using slapstick::Motion;
using slapstick::Outcome;

/// How a segment ended.
struct End {
  int guard = -1;  ///< -1: no event
  bool graze = false;
  /// Of a relative velocity: its own graze is reported as a reversal or stick, and a graze is that of the gap whose
  /// rate it is.
  bool speed = false;
  double time = 0.0;
};

}  // namespace

double blur(const Truth& truth, double duration, double wrong_by) {
  const double value = wrong_by * truth.scale;
  return 0x1p-49 * duration + 2 * value / (truth.slope + std::sqrt(2 * value * truth.bend) + 1e-300);
}

double depth(const Truth& truth) {
  const double dip = truth.bend > 0.0 ? truth.slope * truth.slope / (2 * truth.bend) : INFINITY;
  return (truth.low ? std::abs(truth.least) : dip) / truth.scale;
}

std::optional<int> start_order(const ExactFlow& flow, int guard, const double* X) {
  double h = 0.0;
  for (int i = 0; i < flow.size(); ++i) h += flow.column(guard, i)[0] * X[i];
  if (h > 0x1p-30 * flow.scale(guard, X)) return 0;
  std::array<long double, 32> state{};
  std::array<long double, ExactFlow::terms> a{}, size{};
  std::copy_n(X, flow.size(), state.begin());
  flow.polynomial<long double>(guard, state.data(), a.data());
  flow.magnitudes(guard, X, size.data());
  for (int order = 0; order < 4; ++order) {
    if (a[order] > 0x1p-44L * size[order]) return order;
    if (a[order] != 0) return std::nullopt;
  }
  return std::nullopt;
}

namespace {

/// One segment and its guards.
class SegmentJudge {
 public:
  SegmentJudge(Scene& scene, const Motion& motion, const End& end, Method method, Verdicts& verdicts)
      : scene_(scene),
        segment_(motion.segment()),
        X_(motion.engine().extended_at_start().begin(), motion.engine().extended_at_start().end()),
        flow_(scene.flow(segment_.mode)),
        end_(end),
        method_(method),
        verdicts_(verdicts) {}

  void judge(int near_graze) {
    std::array<int, 64> orders{};
    for (int g = 0; g < flow_.guards(); ++g) {
      const std::optional<int> order = start_order(flow_, g, X_.data());
      if (!order) return void(++verdicts_.unjudged);
      orders[g] = *order;
    }
    ++verdicts_.segments;
    for (int g = 0; g < flow_.guards(); ++g) {
      const int last = std::min(static_cast<int>(end_.time / flow_.spacing()) + 2, flow_.count());
      const Truth truth = first_zero(flow_, g, X_.data(), orders[g], last, method_);
      if (g == near_graze && truth.low) note_depth(truth);
      if (g == end_.guard)
        judge_event(truth, orders[g]);
      else if (truth.kind == Kind::crossing && passed(truth))
        fault(verdicts_.missed, "missed", g, truth);
    }
    if (end_.guard < 0) ++verdicts_.misses;
  }

 private:
  /// Is the zero certainly before the segment's end? One that belongs to a graze lies up to slope / curvature before
  /// its minimum.
  [[nodiscard]] bool passed(const Truth& truth) const {
    const double dip = end_.graze && depth(truth) <= graze_depth ? 1.5 * truth.slope / truth.bend : 0.0;
    return truth.time + dip < end_.time - blur(truth, scene_.duration(), noise);
  }

  void judge_event(const Truth& truth, int order) {
    if (truth.kind == Kind::touch) ++verdicts_.undecided;
    if (end_.speed && depth(truth) <= graze_depth) return void(++verdicts_.rests_in_noise);
    if (end_.graze && !end_.speed) return judge_graze(truth, order);
    ++(end_.graze ? verdicts_.grazes : verdicts_.hits);
    if (truth.kind == Kind::touch) return;
    if (truth.kind == Kind::none)
      return fault(order > 0 ? verdicts_.doubled : verdicts_.wrong, "false", end_.guard, truth);
    const double off = (end_.time - truth.time) / blur(truth, scene_.duration(), noise);
    if (off > 1.0) return fault(verdicts_.missed, "late", end_.guard, truth);
    if (off < -1.0) return fault(order > 0 ? verdicts_.doubled : verdicts_.wrong, "early", end_.guard, truth);
    verdicts_.worst_time = std::max(verdicts_.worst_time, std::abs(off));
  }

  /// The least value must be within the noise.
  void judge_graze(const Truth& truth, int order) {
    ++verdicts_.grazes;
    if (!(depth(truth) <= graze_depth)) {
      if (truth.kind == Kind::crossing) return fault(verdicts_.missed, "taken for a graze", end_.guard, truth);
      return fault(order > 0 ? verdicts_.doubled : verdicts_.wrong, "false graze", end_.guard, truth);
    }
    if (end_.graze) verdicts_.deepest_graze = std::max(verdicts_.deepest_graze, depth(truth));
  }

  void note_depth(const Truth& truth) {
    const double share = std::abs(truth.least) / truth.scale;
    const int k = share > 0.0 ? -static_cast<int>(std::ceil(std::log2(share))) : 63;
    if (share > 0.5) return;
    ++verdicts_.adversarial;
    ++verdicts_.depths[std::clamp(k, 0, 63)];
  }

  /// Everything that a reproduction needs.
  void fault(long& count, const char* what, int guard, const Truth& truth) {
    ++count;
    if (verdicts_.faults.size() >= 5) return;
    char text[320];
    std::snprintf(text, sizeof text,
                  "%s: %s, mode %s, guard %d (event: guard %d%s at %.17g), truth kind %d at %.17g, least %g, scale %g, "
                  "window %.17g, omega %a, X",
                  what, scene_.system().model().name.c_str(), scene_.system().mode_name(segment_.mode).c_str(), guard,
                  end_.guard, end_.graze ? " graze" : "", end_.time, static_cast<int>(truth.kind), truth.time,
                  truth.least, truth.scale, scene_.system().compiled().mode(segment_.mode).window(),
                  scene_.system().model().omega);
    std::string line = text;
    for (int i = 0; i < flow_.size(); ++i) {
      std::snprintf(text, sizeof text, " %a", X_[static_cast<std::size_t>(i)]);
      line += text;
    }
    verdicts_.faults.push_back(line);
  }

  Scene& scene_;
  const Motion::Segment segment_;
  const std::vector<double> X_;  ///< the extended state at its start
  const ExactFlow& flow_;
  End end_;
  Method method_;
  Verdicts& verdicts_;
};

}  // namespace

void Verdicts::add(const Verdicts& o) {
  scenes += o.scenes, segments += o.segments, adversarial += o.adversarial, hits += o.hits, misses += o.misses,
      grazes += o.grazes, rests_in_noise += o.rests_in_noise;
  failed += o.failed, missed += o.missed, wrong += o.wrong, doubled += o.doubled, undecided += o.undecided,
      unjudged += o.unjudged;
  for (std::size_t k = 0; k < depths.size(); ++k) depths[k] += o.depths[k];
  deepest_graze = std::max(deepest_graze, o.deepest_graze);
  worst_time = std::max(worst_time, o.worst_time);
  for (const std::string& fault : o.faults)
    if (faults.size() < 20) faults.push_back(fault);
}

namespace {

void follow(Scene& scene, const Start& start, Method method, int most_segments, Verdicts& verdicts) {
  Motion motion(scene.system(), start.state, {0, start.phase});
  int near_graze = start.guard;
  for (int segment = 0; segment < most_segments;) {
    const double duration = scene.duration();
    const long before = motion.counters().segments;
    const Outcome outcome = motion.advance(motion.time().plus(duration / scene.system().period()));
    if (motion.counters().segments == before) continue;  // an event of the same instant
    const bool event = outcome == Outcome::event;
    if (event && motion.engine().hits().empty()) return void(++verdicts.unjudged);
    End end{-1, false, false, duration};
    if (event)
      end = {motion.engine().hits().front(), motion.event().kind == EventKind::graze,
             motion.engine().hit_guard()->kind == slapstick::mode::GuardKind::slip, motion.segment().duration};
    SegmentJudge(scene, motion, end, method, verdicts).judge(near_graze);
    if (!event) return;
    near_graze = -1;
    ++segment;
  }
}

}  // namespace

void judge_motion(Scene& scene, const Start& start, Method method, int most_segments, Verdicts& verdicts) {
  try {
    follow(scene, start, method, most_segments, verdicts);
  } catch (const slapstick::NumericalError& error) {
    ++verdicts.failed;
    if (verdicts.faults.size() < 5) verdicts.faults.push_back(scene.system().model().name + ": " + error.what());
  }
}

}  // namespace campaign
