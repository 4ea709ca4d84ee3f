/// Campaign `lane-grazes`: starts of the campaign `segments` in the lanes of a batch. The first event is that of a
/// motion, and where they differ a certain search says that the guard's least value is within the noise.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "batches.hpp"
#include "flow/compiled_system.hpp"
#include "flow/engine.hpp"
#include "judge.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/sweep/batch.hpp"

namespace campaign {
namespace {

using namespace slapstick;

/// Of times, in periods: more is held against the search.
constexpr double same = 1e-11;
/// What a value of a guard can be wrong by in a lane, in units of its scale: rho (4 + z) exp(z) of section 11 of
/// docs/developers/proofs.md, for the longest window.
constexpr double lane_noise = 20.0 * 0x1p-53 * (4.0 + 3.875) * 48.2;

struct LaneTally {
  long scenes = 0, starts = 0, near_grazes = 0, in_lanes = 0, agreed = 0, in_noise = 0, unjudged = 0, differ = 0,
       failed = 0;
  long lane_events = 0, motion_events = 0;
  std::vector<std::string> faults;

  void add(const LaneTally& other) {
    scenes += other.scenes, starts += other.starts, near_grazes += other.near_grazes, in_lanes += other.in_lanes;
    agreed += other.agreed, in_noise += other.in_noise, unjudged += other.unjudged, differ += other.differ,
        failed += other.failed;
    lane_events += other.lane_events, motion_events += other.motion_events;
    for (const std::string& fault : other.faults)
      if (faults.size() < 20) faults.push_back(fault);
  }
};

/// The first event within a segment, and of a motion the guard whose zero it is.
struct First {
  std::optional<Event> event;
  int guard = -1;
};

First of_motion(Scene& scene, const Start& start, Instant end) {
  Motion motion(scene.system(), start.state);
  if (motion.advance(end) != Outcome::event) return {};
  return {motion.event(), motion.engine().hits().empty() ? -1 : motion.engine().hits().front()};
}

First of_lane(const BatchRun& run, Instant end) {
  if (run.events.empty() || end < run.events.front().time) return {};
  return {run.events.front()};
}

bool agree(const First& motion, const First& lane, double tolerance) {
  if (!motion.event || !lane.event) return !motion.event && !lane.event;
  return motion.event->kind == lane.event->kind && motion.event->contact == lane.event->contact &&
         std::abs(motion.event->time.since(lane.event->time)) <= tolerance;
}

/// What the search says of the guard in which the two differ.
class Difference {
 public:
  Difference(Scene& scene, const Start& start, const First& motion, const First& lane, const std::string& where,
             LaneTally& tally)
      : scene_(scene), start_(start), motion_(motion), lane_(lane), where_(where), tally_(tally) {}

  /// The guard that the start nearly grazes, and the one that the motion has hit: the rate of a gap has its zero where
  /// the gap has its minimum. Searched up to the earlier of the two events: there one of the two sees what the other
  /// does not, though the guard may have its certain zero later.
  void judge() {
    const Motion begun(scene_.system(), start_.state);
    const ExactFlow& flow = scene_.flow(begun.mode_id());
    const double* const X = begun.engine().extended_at_start().data();
    bool known = false;
    for (const int guard : {start_.guard, motion_.guard}) {
      const std::optional<int> order = guard >= 0 && guard < flow.guards() ? start_order(flow, guard, X) : std::nullopt;
      if (!order) continue;
      known = true;
      if (is_noise(first_zero(flow, guard, X, *order, up_to_the_earlier(flow), Method::quick)))
        return void(++tally_.in_noise);
    }
    if (!known) return void(++tally_.unjudged);
    ++tally_.differ;
    tally_.faults.push_back(where_ + scene_.system().model().name + ": " + text_of(motion_) + " | " + text_of(lane_));
  }

 private:
  /// In intervals of the grid, and one beyond: events are not known better than their noise.
  [[nodiscard]] int up_to_the_earlier(const ExactFlow& flow) const {
    double periods = INFINITY;
    for (const First* first : {&motion_, &lane_})
      if (first->event) periods = std::min(periods, first->event->time.since({}));
    return static_cast<int>(std::min(std::ceil(periods * scene_.system().period() / flow.spacing()) + 1.0,
                                     static_cast<double>(flow.count())));
  }

  [[nodiscard]] bool is_noise(const Truth& truth) const {
    return depth(truth) <= graze_depth ||
           agree(motion_, lane_, 2.0 * blur(truth, scene_.duration(), lane_noise) / scene_.system().period());
  }

  static std::string text_of(const First& first) {
    if (!first.event) return "none";
    char text[120];
    std::snprintf(text, sizeof text, "%s of %d at %.17g", std::string(name(first.event->kind)).c_str(),
                  first.event->contact, first.event->time.since({}));
    return text;
  }

  Scene& scene_;
  const Start& start_;
  const First &motion_, &lane_;
  const std::string& where_;
  LaneTally& tally_;
};

std::vector<Start> draw(Scene& scene, Random& random, long count, LaneTally& tally) {
  NearGrazes near_grazes(scene, random);
  std::vector<Start> starts;
  for (long i = 0; i < count; ++i) {
    Start start;
    bool near = false;
    for (int k = 0; k < 16 && !near; ++k) near = near_grazes.next(start);
    if (!near) start = random_start(scene, random);
    tally.near_grazes += near ? 1 : 0;
    starts.push_back(std::move(start));
  }
  return starts;
}

void examine_scene(Random& random, long count, const std::string& where, LaneTally& tally) {
  Scene scene(random, Scene::Phase::zero);
  const std::vector<Start> starts = draw(scene, random, count, tally);
  const Instant end = Instant{}.plus(scene.duration() / scene.system().period());
  sweep::BatchProblem problem;
  problem.count = starts.size();
  problem.model_at = [&](std::size_t) { return scene.system().model(); };
  problem.start_at = [&](std::size_t i) { return starts[i].state; };
  problem.plan = {.periods = static_cast<int>(end.period) + 1, .events = true};
  problem.threads = 1;
  const sweep::Batch found = run_batch(problem);
  ++tally.scenes;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    ++tally.starts;
    if (!found.runs[i].in_lanes) continue;
    ++tally.in_lanes;
    tally.lane_events += found.runs[i].lane_events;
    tally.motion_events += found.runs[i].motion_events;
    try {
      const First motion = of_motion(scene, starts[i], end), lane = of_lane(found.runs[i], end);
      if (agree(motion, lane, same))
        ++tally.agreed;
      else
        Difference(scene, starts[i], motion, lane, where + "start " + std::to_string(i) + ", ", tally).judge();
    } catch (const NumericalError&) {
      ++tally.failed;  // a motion's own
    }
  }
}

LaneTally examine(const Options& options, long batch, long count) {
  constexpr long starts_of_a_scene = 100;
  Random random(options.seed, static_cast<std::uint64_t>(batch));
  LaneTally tally;
  for (long done = 0; done < count; done += starts_of_a_scene) {
    const std::string where =
        "batch " + std::to_string(batch) + ", scene " + std::to_string(done / starts_of_a_scene) + ", ";
    examine_scene(random, std::min(count - done, starts_of_a_scene), where, tally);
  }
  return tally;
}

}  // namespace

Report run_lane_grazes(const Options& options) {
  Batches<LaneTally> batches(options, 1000, "starts");
  const LaneTally all = batches.run([&](long k, long n) { return examine(options, k, n); });
  Report out;
  out.done = batches.done();
  out.passed = all.differ == 0 && all.failed == 0 && 2 * all.near_grazes >= all.starts &&
               2 * all.in_lanes >= all.starts && all.lane_events > 0 && 20 * all.unjudged <= all.in_lanes &&
               2 * all.agreed >= all.in_lanes;
  Json faults = Json::list();
  for (const std::string& fault : all.faults) faults.push(fault);
  out.figures.set("systems", all.scenes)
      .set("starts", all.starts)
      .set("near_grazes", all.near_grazes)
      .set("in_lanes", all.in_lanes);
  out.figures.set("agreed", all.agreed).set("within_the_noise", all.in_noise).set("unjudged", all.unjudged);
  out.figures.set("differ", all.differ).set("failed", all.failed);
  out.figures.set("lane_events", all.lane_events).set("motion_events", all.motion_events).set("faults", faults);
  return out;
}

}  // namespace campaign
