/// Campaigns `segments` and `wide`: random segments, half of them adversarial near-grazes; none missed, none false,
/// none doubled.
#include "batches.hpp"
#include "judge.hpp"

namespace campaign {
namespace {

using slapstick::Json;

/// What follows an impact is examined too, except for two of three near-grazes, lest they fall below a half. A scene
/// whose near-grazes are rare (friction brings it to rest first) is left after a twentieth of the others' segments.
void examine_scene(Random& random, long count, Method method, Verdicts& verdicts) {
  Scene scene(random);
  NearGrazes near_grazes(scene, random);
  Start start;
  long attempts = 0, made = 0;
  const long before = verdicts.segments;
  while (verdicts.segments < before + count) {
    const bool wanted = 20 * verdicts.adversarial <= 11 * verdicts.segments;
    bool have = false;
    for (int i = 0; wanted && i < 16 && !have; ++i) {
      have = near_grazes.next(start);
      ++attempts;
    }
    if (!have) start = random_start(scene, random);
    const long reached = verdicts.adversarial;
    judge_motion(scene, start, method, wanted && !random.one_in(3) ? 1 : 2, verdicts);
    made += verdicts.adversarial - reached;
    if (attempts > 400 && 5 * made < attempts && verdicts.segments > before + count / 20) return;
  }
}

Verdicts examine(Random random, long count, Method method) {
  const long scene = std::max(count / 20, 1L);
  Verdicts verdicts;
  while (verdicts.segments < count) {
    examine_scene(random, std::min(scene, count - verdicts.segments), method, verdicts);
    ++verdicts.scenes;
  }
  return verdicts;
}

Json depths(const Verdicts& verdicts) {
  Json list = Json::list();
  for (const long count : verdicts.depths) list.push(count);
  return list;
}

Report report(const Verdicts& v, long done) {
  Report out;
  out.done = done;
  out.passed = v.sound() && 2 * v.adversarial >= v.segments && v.grazes > 0;
  Json faults = Json::list();
  for (const std::string& fault : v.faults) faults.push(fault);
  out.figures.set("segments", v.segments).set("adversarial", v.adversarial).set("systems", v.scenes);
  out.figures.set("hits", v.hits).set("misses", v.misses).set("grazes", v.grazes);
  out.figures.set("rests_in_noise", v.rests_in_noise);
  out.figures.set("missed", v.missed).set("false", v.wrong).set("doubled", v.doubled).set("failed", v.failed);
  out.figures.set("undecided_by_the_reference", v.undecided).set("unjudged", v.unjudged);
  out.figures.set("deepest_graze", v.deepest_graze).set("worst_time_in_noise", v.worst_time);
  out.figures.set("adversarial_by_depth", depths(v)).set("faults", faults);
  return out;
}

Report run(const Options& options, long batch, Method method) {
  Batches<Verdicts> batches(options, batch, "segments");
  const Verdicts all = batches.run([&](long k, long n) { return examine(Random(options.seed, k), n, method); });
  return report(all, batches.done());
}

}  // namespace

Report run_segments(const Options& options) { return run(options, 200'000, Method::quick); }
Report run_wide(const Options& options) { return run(options, 10'000, Method::wide); }

}  // namespace campaign
