/// Campaign `lanes`: runs of a batch have the events of a motion, up to the first of these that depends on the motion's
/// windows.
#include <algorithm>
#include <utility>

#include "batches.hpp"
#include "mixed_machine.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/motion.hpp"
#include "slapstick/io/model_file.hpp"
#include "slapstick/sweep/batch.hpp"

namespace campaign {
namespace {

using namespace slapstick;

constexpr int periods = 20;
/// Of times, in periods: an event after up to 20 periods may be so far from the motion's, since errors grow along both.
/// A motion whose own windows move an event by more than the second is not stable, and proves nothing.
constexpr double same = 1e-8, stable = 1e-11;

/// Of the runs of one kind.
struct Share {
  long runs = 0, in_lanes = 0, agreed = 0, unstable = 0, differ = 0, failed = 0, lane_events = 0, motion_events = 0;
  double worst = 0.0;

  void add(const Share& other) {
    runs += other.runs, in_lanes += other.in_lanes, agreed += other.agreed, unstable += other.unstable;
    differ += other.differ, failed += other.failed;
    lane_events += other.lane_events, motion_events += other.motion_events;
    worst = std::max(worst, other.worst);
  }

  [[nodiscard]] bool sound() const {
    return differ == 0 && in_lanes > 0 && 20 * (unstable + failed) <= in_lanes && lane_events > in_lanes;
  }

  [[nodiscard]] Json figures() const {
    Json json = Json::object();
    json.set("runs", runs)
        .set("in_lanes", in_lanes)
        .set("agreed", agreed)
        .set("unstable", unstable)
        .set("differ", differ);
    json.set("failed", failed)
        .set("lane_events", lane_events)
        .set("motion_events", motion_events)
        .set("worst_time_in_periods", worst);
    return json;
  }
};

struct Tally {
  Share pixels, machines;
  std::vector<std::string> faults;

  void add(const Tally& other) {
    pixels.add(other.pixels);
    machines.add(other.machines);
    for (const std::string& fault : other.faults)
      if (faults.size() < 20) faults.push_back(fault);
  }
};

/// Without what no lane can run, except for contacts that depend on each other.
MixedMachine plainer(MixedMachine machine) {
  Model& model = machine.model;
  model.characteristics.clear();
  std::erase_if(model.forces, [](const Force& force) { return force.frequency != 0.0; });
  std::vector<std::pair<int, int>> pairs;
  std::erase_if(model.stops, [&](const Stop& stop) {
    const std::pair<int, int> pair = std::minmax({stop.a, stop.b});
    const bool again = std::find(pairs.begin(), pairs.end(), pair) != pairs.end();
    pairs.push_back(pair);
    return again;
  });
  for (Stop& stop : model.stops) stop.corners.clear();
  for (FrictionContact& contact : model.frictions) contact.normal.reset();
  for (CompliantStop& stop : model.compliant_stops) stop.bounded = false;
  return machine;
}

struct Drawn {
  MixedMachine machine;
  bool pixel = false;
};

/// Half of the runs are pixels: the paper's system at random frequencies and frictions. The others are mixed machines.
Drawn draw(Random& random) {
  static const ModelDefinition paper = load_model("vibro-impact");
  if (!random.one_in(2)) return {plainer(mixed_machine(random)), false};
  const double omega = random.uniform(0.4, 6.0), friction = random.uniform(0.05, 0.3);
  return {{paper.build({{"omega", omega}, {"friction", friction}}), {-0.5, 0.0, random.uniform(-0.1, 0.1), 0.0}}, true};
}

std::vector<Event> events_of(const MixedMachine& machine, double longest_window) {
  Motion motion(System(machine.model, {longest_window}), machine.start);
  std::vector<Event> events;
  while (motion.advance({periods, 0.0}) == Outcome::event) events.push_back(motion.event());
  return events;
}

/// How many events agree before the first that does not; how far the agreeing ones are apart.
std::size_t agreeing(const std::vector<Event>& a, const std::vector<Event>& b, double tolerance, double& worst) {
  std::size_t i = 0;
  for (; i < a.size() && i < b.size(); ++i) {
    const double apart = std::abs(a[i].time.since(b[i].time));
    if (a[i].kind != b[i].kind || a[i].contact != b[i].contact || apart > tolerance) break;
    worst = std::max(worst, apart);
  }
  return i;
}

/// How many of a motion's events, from the first on, are the same under the window caps of the failure catalogue:
/// twenty, from the natural length down to a 240th of it.
std::size_t stable_events(const MixedMachine& machine, const std::vector<Event>& expected) {
  std::size_t events = expected.size() + 1;  // also that there are no more
  double worst = 0.0, cap = 1.0 / System(machine.model).windows_per_period();
  for (int k = 0; k < 20; ++k, cap *= 0.75) {
    const std::vector<Event> other = events_of(machine, cap);
    const std::size_t agreed = agreeing(expected, other, stable, worst);
    if (agreed < expected.size() || agreed < other.size()) events = std::min(events, agreed);
  }
  return events;
}

/// @returns what differs, or nothing
std::string compare(const MixedMachine& machine, const BatchRun& run, Share& share) {
  const std::vector<Event> expected = events_of(machine, INFINITY);
  const std::size_t agreed = agreeing(expected, run.events, same, share.worst);
  if (agreed == expected.size() && agreed == run.events.size()) {
    ++share.agreed;
  } else if (stable_events(machine, expected) <= agreed) {
    ++share.unstable;
  } else {
    ++share.differ;
    return "event " + std::to_string(agreed) + " of " + machine.model.name + " " + run.failure;
  }
  return "";
}

Tally examine(const Options& options, long batch, long count) {
  Random random(options.seed, static_cast<std::uint64_t>(batch));
  std::vector<Drawn> drawn;
  for (long i = 0; i < count; ++i) drawn.push_back(draw(random));
  sweep::BatchProblem problem;
  problem.count = drawn.size();
  problem.model_at = [&](std::size_t i) { return drawn[i].machine.model; };
  problem.start_at = [&](std::size_t i) { return drawn[i].machine.start; };
  problem.plan = {.periods = periods, .events = true};
  problem.threads = 1;
  const sweep::Batch found = run_batch(problem);
  Tally tally;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const BatchRun& run = found.runs[i];
    Share& share = drawn[i].pixel ? tally.pixels : tally.machines;
    ++share.runs;
    share.in_lanes += run.in_lanes ? 1 : 0;
    share.lane_events += run.lane_events;
    share.motion_events += run.motion_events;
    if (!run.in_lanes) continue;
    try {
      const std::string fault = compare(drawn[i].machine, run, share);
      if (!fault.empty())
        tally.faults.push_back("batch " + std::to_string(batch) + ", run " + std::to_string(i) + ": " + fault);
    } catch (const NumericalError&) {
      ++share.failed;  // a motion's own
    }
  }
  return tally;
}

}  // namespace

Report run_lanes(const Options& options) {
  Batches<Tally> batches(options, 64, "runs");
  const Tally all = batches.run([&](long k, long n) { return examine(options, k, n); });
  Report out;
  out.done = batches.done();
  out.passed = all.pixels.sound() && all.machines.sound();
  Json faults = Json::list();
  for (const std::string& fault : all.faults) faults.push(fault);
  out.figures.set("pixels", all.pixels.figures()).set("machines", all.machines.figures()).set("faults", faults);
  return out;
}

}  // namespace campaign
