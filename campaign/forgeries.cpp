/// Campaign `forgeries`: certificates of short motions of all built-in models and of random machines that mix all
/// features are forged, one claim at a time, and shown to slapstick-verify's rules. What they accept must be true all
/// the same.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>

#include "base/text.hpp"
#include "batches.hpp"
#include "certify/stated_model.hpp"
#include "forger.hpp"
#include "mixed_machine.hpp"
#include "retold.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/certify/certificate.hpp"
#include "slapstick/io/model_file.hpp"
#include "verdict.hpp"

namespace campaign {
namespace {

using namespace slapstick;

/// Chatter that shakes another contact is not proved: of true certificates at most one in 100, as far as n of them tell
/// (three standard deviations of a count whose mean is n / 100).
bool too_many(long unproved, long n) {
  const double mean = 0.01 * static_cast<double>(n);
  return static_cast<double>(unproved) > mean + 3.0 * std::sqrt(mean);
}

struct Kind {
  long forged = 0, unreadable = 0, refused = 0, harmless = 0, accepted = 0;
  std::string example;  ///< of one that was accepted and is false
};

struct Tally {
  long certificates = 0, unproved = 0;         ///< true ones, and those of them that were refused
  std::map<std::string, std::string> refused;  ///< examples of these, by what was said without its numbers
  std::map<std::string, Kind> kinds;

  void add(const Tally& o) {
    certificates += o.certificates;
    unproved += o.unproved;
    refused.insert(o.refused.begin(), o.refused.end());
    for (const auto& [name, kind] : o.kinds) {
      Kind& mine = kinds[name];
      mine.forged += kind.forged, mine.unreadable += kind.unreadable, mine.refused += kind.refused;
      mine.harmless += kind.harmless, mine.accepted += kind.accepted;
      if (mine.example.empty()) mine.example = kind.example;
    }
  }
};

std::string without_numbers(const std::string& what) {
  std::string kind;
  for (const char c : what)
    if (!(c >= '0' && c <= '9')) kind += c;
  return kind;
}

struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The first refusal, or nothing. @throws verify::Unreadable
std::optional<std::string> refusal(const std::string& text) {
  std::istringstream in(text);
  try {
    (void)verify::check(
        in, [](long line, const std::string& what) { throw Refused("line " + std::to_string(line) + ": " + what); });
  } catch (const Refused& refused) {
    return refused.what();
  }
  return std::nullopt;
}

std::string certificate(const System& system, const State& start, double periods) {
  std::string text;
  certify::Certificate writer(system, start, [&](const std::string& lines) { text += lines; });
  writer.run(Instant{}.plus(periods), [](Instant) { return true; });
  writer.finish();
  return text;
}

/// Of a random machine: every other motion. One that cannot be followed is drawn again.
std::string of_mixed_machine(Random& random) {
  for (;;) {
    const MixedMachine machine = mixed_machine(random);
    try {
      return certificate(System(machine.model), machine.start, 1.5);
    } catch (const NumericalError&) {  // impacts without end, no mode that fits
    } catch (const InputError&) {      // time scales too far apart
    }
  }
}

/// The other motions are of the built-in models in turn.
std::string original(Random& random, long batch) {
  if (batch % 2 == 1) return of_mixed_machine(random);
  std::vector<std::string> models = builtin_models();
  std::erase_if(models, [](const std::string& name) { return !certify::not_stated(load_model(name).build()).empty(); });
  const ModelDefinition definition = load_model(models[static_cast<std::size_t>(batch / 2) % models.size()]);
  const Model model = definition.build();
  State start = definition.start();
  for (double& x : start) x += random.one_in(2) ? 0.0 : random.uniform(-0.25, 0.25);
  try {
    validate(model, start);
  } catch (const InputError&) {
    start = definition.start();
  }
  return certificate(System(model), start, random.uniform(0.5, 2.0));
}

void examine(const Forgery& forgery, Kind& kind) {
  ++kind.forged;
  try {
    if (refusal(forgery.text)) return void(++kind.refused);
  } catch (const verify::Unreadable&) {
    return void(++kind.unreadable);
  }
  const std::string otherwise = told_otherwise(forgery.text);
  if (otherwise.empty()) return void(++kind.harmless);
  ++kind.accepted;
  if (kind.example.empty()) kind.example = otherwise + "\n" + forgery.text;
}

Tally forge(Random random, long batch, long count) {
  Tally tally;
  const std::string text = original(random, batch);
  ++tally.certificates;
  if (const auto why = refusal(text)) {
    ++tally.unproved;
    tally.refused.emplace(without_numbers(*why), *why + "\n" + text);
    return tally;
  }
  const Forger forger(text);
  const int kinds = static_cast<int>(Forger::kinds().size());
  for (long n = 0, tried = 0; n < count && tried < 20 * count; ++tried) {
    const Forgery forgery = forger.make(random.below(kinds), random);
    if (forgery.text.empty() || forgery.text == text) continue;
    examine(forgery, tally.kinds[forgery.kind]);
    ++n;
  }
  return tally;
}

}  // namespace

Report run_forgeries(const Options& options) {
  Batches<Tally> batches(options, 25, "forgeries");
  const Tally all = batches.run([&](long k, long n) { return forge(Random(options.seed, k), k, n); });
  Report report;
  Json kinds = Json::object(), examples = Json::object();
  long accepted = 0;
  for (const auto& [name, kind] : all.kinds) {
    report.done += kind.forged;
    accepted += kind.accepted;
    kinds.set(name, Json::object()
                        .set("forged", kind.forged)
                        .set("unreadable", kind.unreadable)
                        .set("refused", kind.refused)
                        .set("harmless", kind.harmless)
                        .set("accepted", kind.accepted));
    if (!kind.example.empty()) examples.set(name, kind.example);
  }
  report.passed = accepted == 0 && !too_many(all.unproved, all.certificates) && report.done > 0;
  report.figures.set("certificates", all.certificates).set("unproved", all.unproved);
  Json refused = Json::object();
  for (const auto& [what, example] : all.refused) refused.set(what, example);
  report.figures.set("unproved_examples", refused);
  report.figures.set("forgeries", report.done).set("accepted", accepted).set("kinds", kinds).set("examples", examples);
  return report;
}

}  // namespace campaign
