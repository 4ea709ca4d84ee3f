/// Campaign `balls`: every segment of random motions proved by a certificate, which slapstick-verify's rules check in balls of 256 bits.
#include <sstream>

#include "batches.hpp"
#include "check.hpp"
#include "near_graze.hpp"
#include "slapstick/base/text.hpp"
#include "slapstick/certify/certificate.hpp"

namespace campaign {
namespace {

using slapstick::Json;

struct Tally {
  long motions = 0, segments = 0, near_grazes = 0, guards = 0, steps = 0, events = 0, impacts = 0, touches = 0,
       chatters = 0;
  long refusals = 0;
  double jump = 0.0;  ///< largest, of what rounding is allowed from segment to segment
  std::vector<std::string> faults;

  void add(const Tally& o) {
    motions += o.motions, segments += o.segments, near_grazes += o.near_grazes, guards += o.guards, steps += o.steps;
    events += o.events, impacts += o.impacts, touches += o.touches, chatters += o.chatters, refusals += o.refusals;
    jump = std::max(jump, o.jump);
    for (const std::string& fault : o.faults)
      if (faults.size() < 20) faults.push_back(fault);
  }
};

std::string certificate(const Scene& scene, const Start& start) {
  std::string text;
  slapstick::certify::Certificate writer(scene.system(), start.state, [&](const std::string& lines) { text += lines; });
  writer.run(slapstick::Instant{}.plus(scene.duration() / scene.system().period()),
             [](slapstick::Instant) { return true; });
  writer.finish();
  return text;
}

void check(const std::string& text, Tally& tally) {
  std::istringstream in(text);
  const verify::Refuse refuse = [&](long line, const std::string& what) {
    ++tally.refusals;
    if (tally.faults.size() < 5) tally.faults.push_back("line " + std::to_string(line) + ": " + what);
  };
  verify::Reader reader(in);
  verify::Checker checker(reader.head(), reader.modes(), refuse);
  for (verify::Segment segment; reader.next(segment);) checker.segment(segment);
  const verify::Tally& t = checker.tally();
  tally.segments += t.segments, tally.guards += t.guards, tally.steps += t.steps, tally.events += t.events;
  tally.impacts += t.impacts, tally.touches += t.touches, tally.chatters += t.chatters;
  tally.jump = std::max(tally.jump, t.jump);
}

/// Every other motion begins with a near-graze.
Tally examine(Random random, long count) {
  Tally tally;
  Scene scene(random, Scene::Phase::zero);
  NearGrazes near_grazes(scene, random);
  while (tally.segments < count) {
    Start start = random_start(scene, random);
    bool near_graze = false;
    for (int i = 0; i < 16 && tally.motions % 2 == 0 && !near_graze; ++i) near_graze = near_grazes.next(start);
    if (!near_graze) start = random_start(scene, random);
    const long refusals = tally.refusals;
    check(certificate(scene, start), tally);
    if (tally.refusals > refusals) {
      std::string where = scene.system().model().name + ", start";
      for (const double x : start.state) where += " " + slapstick::shown(x);
      tally.faults.push_back(where);
    }
    ++tally.motions;
    tally.near_grazes += near_graze ? 1 : 0;
  }
  return tally;
}

}  // namespace

Report run_balls(const Options& options) {
  Batches<Tally> batches(options, 250, "segments");
  const Tally all = batches.run([&](long k, long n) { return examine(Random(options.seed, k), n); });
  Report report;
  report.done = all.segments;
  report.passed = all.refusals == 0 && all.near_grazes > 0;
  Json faults = Json::list();
  for (const std::string& fault : all.faults) faults.push(fault);
  report.figures.set("segments", all.segments).set("motions", all.motions).set("near_grazes", all.near_grazes);
  report.figures.set("events", all.events)
      .set("impacts", all.impacts)
      .set("guards", all.guards)
      .set("steps", all.steps);
  report.figures.set("touches", all.touches).set("chatter_limits", all.chatters).set("refusals", all.refusals);
  report.figures.set("largest_jump", all.jump).set("faults", faults);
  return report;
}

}  // namespace campaign
