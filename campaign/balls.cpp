/// Campaign `balls`: every segment of random motions proved by a certificate, which slapstick-verify's rules check in
/// balls of 256 bits.
#include <cctype>
#include <map>
#include <sstream>

#include "base/text.hpp"
#include "batches.hpp"
#include "near_graze.hpp"
#include "slapstick/certify/certificate.hpp"
#include "verdict.hpp"

namespace campaign {
namespace {

using slapstick::Json;

struct Tally {
  long motions = 0, segments = 0, near_grazes = 0, conditions = 0, events = 0, impacts = 0, touches = 0, flats = 0,
       chatters = 0, pile_ups = 0, choices = 0, refusals = 0;
  double jump = 0.0;  ///< largest, of what rounding is allowed from segment to segment
  /// What was refused, without its numbers: how often, and a motion in which it was.
  struct Kind {
    long count = 0;
    std::string example;
  };
  std::map<std::string, Kind> kinds;

  void add(const Tally& o) {
    motions += o.motions, segments += o.segments, near_grazes += o.near_grazes, conditions += o.conditions;
    events += o.events, impacts += o.impacts, touches += o.touches, flats += o.flats, chatters += o.chatters;
    pile_ups += o.pile_ups, choices += o.choices, refusals += o.refusals;
    jump = std::max(jump, o.jump);
    for (const auto& [name, kind] : o.kinds) {
      Kind& mine = kinds[name];
      if (mine.count == 0) mine.example = kind.example;
      mine.count += kind.count;
    }
  }
};

/// A refusal without its numbers.
std::string kind_of(const std::string& what) {
  std::string kind;
  for (const char c : what.substr(what.find(',') + 2)) {
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    if (!digit) kind += c;
    if (digit && (kind.empty() || kind.back() != '#')) kind += '#';
  }
  return kind;
}

std::string certificate(const Scene& scene, const Start& start) {
  std::string text;
  slapstick::certify::Certificate writer(scene.system(), start.state, [&](const std::string& lines) { text += lines; });
  writer.run(slapstick::Instant{}.plus(scene.duration() / scene.system().period()),
             [](slapstick::Instant) { return true; });
  writer.finish();
  return text;
}

void check(const std::string& text, const std::string& where, Tally& tally) {
  std::istringstream in(text);
  const verify::Refuse refuse = [&](long, const std::string& what) {
    ++tally.refusals;
    Tally::Kind& kind = tally.kinds[kind_of(what)];
    if (kind.count++ == 0) kind.example = where + ": " + what;
  };
  const verify::Tally t = verify::check(in, refuse).tally;
  tally.segments += t.segments, tally.conditions += t.flight.conditions, tally.events += t.events;
  tally.impacts += t.impacts, tally.touches += t.open.undecided, tally.flats += t.flight.flats;
  tally.chatters += t.chatters, tally.pile_ups += t.open.pile_ups, tally.choices += t.open.choices;
  tally.jump = std::max(tally.jump, t.of_allowed);
}

/// Every other motion begins with a near-graze.
Tally examine(Random random, long batch, long count) {
  Tally tally;
  Scene scene(random, Scene::Phase::zero);
  NearGrazes near_grazes(scene, random);
  while (tally.segments < count) {
    Start start = random_start(scene, random);
    bool near_graze = false;
    for (int i = 0; i < 16 && tally.motions % 2 == 0 && !near_graze; ++i) near_graze = near_grazes.next(start);
    if (!near_graze) start = random_start(scene, random);
    std::string where = scene.system().model().name + " of batch " + std::to_string(batch) + ", start";
    for (const double x : start.state) where += " " + slapstick::shown(x);
    check(certificate(scene, start), where, tally);
    ++tally.motions;
    tally.near_grazes += near_graze ? 1 : 0;
  }
  return tally;
}

}  // namespace

Report run_balls(const Options& options) {
  Batches<Tally> batches(options, 250, "segments");
  const Tally all = batches.run([&](long k, long n) { return examine(Random(options.seed, k), k, n); });
  Report report;
  report.done = all.segments;
  report.passed = all.refusals == 0 && all.near_grazes > 0;
  Json refused = Json::object();
  for (const auto& [name, kind] : all.kinds)
    refused.set(name, Json::object().set("count", kind.count).set("example", kind.example));
  report.figures.set("segments", all.segments).set("motions", all.motions).set("near_grazes", all.near_grazes);
  report.figures.set("events", all.events).set("impacts", all.impacts).set("conditions", all.conditions);
  report.figures.set("undecided_signs", all.touches)
      .set("pile_ups", all.pile_ups)
      .set("choices", all.choices)
      .set("flat_zeros", all.flats)
      .set("chatter_limits", all.chatters)
      .set("refusals", all.refusals);
  report.figures.set("largest_jump", all.jump).set("refused", refused);
  return report;
}

}  // namespace campaign
