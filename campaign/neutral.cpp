/// Campaign `neutral`: edits of random model files that change nothing, and every verb's answer of both files.
#include "batches.hpp"
#include "neutral/laws.hpp"
#include "property/random_file.hpp"
#include "slapstick/base/error.hpp"

namespace campaign {
namespace {

using namespace slapstick;
using namespace slapstick::neutral;

constexpr long triples_of_a_file = 30;  // of the first four verbs
/// A dearer verb is asked about a few edits of some files. Beside 1e5 triples of the others these are 5000, 500 and 50.
struct Dearer {
  Verb verb;
  long every;
  int edits;
};
constexpr Dearer dearer[] = {{Verb::orbit, 2, 3}, {Verb::branch, 7, 1}, {Verb::curve, 67, 1}};

struct Counts {
  long by_verdict[5] = {};
  void add(const Counts& other) {
    for (std::size_t i = 0; i < 5; ++i) by_verdict[i] += other.by_verdict[i];
  }
  [[nodiscard]] long of(Verdict verdict) const { return by_verdict[static_cast<std::size_t>(verdict)]; }
  [[nodiscard]] Json figures() const {
    Json json = Json::object();
    for (std::size_t i = 0; i < 5; ++i) json.set(neutral::name(static_cast<Verdict>(i)), by_verdict[i]);
    return json;
  }
};

struct Tally {
  std::map<std::string, Counts> edits, verbs, laws;
  std::map<std::string, long> reasons;
  std::vector<std::string> failures;
  void add(const Tally& other) {
    for (const auto& [name, counts] : other.edits) edits[name].add(counts);
    for (const auto& [name, counts] : other.verbs) verbs[name].add(counts);
    for (const auto& [name, counts] : other.laws) laws[name].add(counts);
    for (const auto& [reason, count] : other.reasons) reasons[reason] += count;
    for (const std::string& failure : other.failures)
      if (failures.size() < 50) failures.push_back(failure);
  }
};

/// What stands before the values.
std::string reason(const std::string& why) { return why.substr(0, why.find(':')); }

void count(const Judgement& outcome, Asked& first, const Edit& edit, Verb verb, std::uint64_t seed, Tally& tally) {
  const auto k = static_cast<std::size_t>(outcome.verdict);
  ++tally.edits[edit.name].by_verdict[k];
  ++tally.verbs[neutral::name(verb)].by_verdict[k];
  if (outcome.verdict == Verdict::excused || outcome.verdict == Verdict::waiting) ++tally.reasons[reason(outcome.why)];
  if (outcome.verdict != Verdict::different) return;
  const int most_tries = verb == Verb::branch || verb == Verb::curve ? 20 : 400;  // a branch takes seconds
  const Definition small = smallest(first.file(), edit, verb, seed, outcome.why, most_tries);
  tally.failures.push_back("# " + std::string(edit.name) + ", file " + std::to_string(seed) + ": " + outcome.why +
                           "\n" + both_commands(small, edit, verb, seed));
}

/// Draws an edit that the file admits.
std::pair<const Edit*, Edited> draw(const Definition& file, std::uint64_t seed, Random& order) {
  for (;;) {
    const Edit& edit = edits()[static_cast<std::size_t>(order.below(static_cast<int>(edits().size())))];
    Random random(seed, 0);
    if (auto second = edit.apply(file, random)) return {&edit, std::move(*second)};
  }
}

void examine_laws(const Definition& file, std::uint64_t seed, Tally& tally) {
  for (const Law& law : laws()) {
    const auto broken = check(law, read(file));
    Counts& counts = tally.laws[law.name];
    if (!broken) continue;
    ++counts.by_verdict[static_cast<std::size_t>(broken->empty() ? Verdict::agreed : Verdict::different)];
    if (broken->empty()) continue;
    constexpr int most_tries = 400;
    tally.failures.push_back("# law " + std::string(law.name) + ", file " + std::to_string(seed) + ": " + *broken +
                             "\n" + text(smallest(file, law, most_tries)));
  }
}

/// A batch is a file: edits are drawn until there are enough triples.
Tally one_file(long number, long triples, const Options& options) {
  Tally tally;
  const std::uint64_t seed = (options.seed << 24) + static_cast<std::uint64_t>(number);
  Asked first(test::random_file(seed));
  Random order(seed, 1);
  for (long done = 0; done < triples && !options.stopped();) {
    const auto [edit, second] = draw(first.file(), seed, order);
    for (const Verb verb : {Verb::simulate, Verb::measure, Verb::classify, Verb::modes})
      if (done++ < triples) count(judge(first, *edit, second, verb), first, *edit, verb, seed, tally);
  }
  for (const auto& [verb, every, times] : dearer)
    for (int k = 0; k < times && number % every == 0 && first.definition().parameters().size() >= parameters_of(verb) &&
                    !options.stopped();
         ++k) {
      const auto [edit, second] = draw(first.file(), seed, order);
      count(judge(first, *edit, second, verb), first, *edit, verb, seed, tally);
    }
  examine_laws(first.file(), seed, tally);
  return tally;
}

}  // namespace

Report run_neutral(const Options& options) {
  Batches<Tally> batches(options, triples_of_a_file, "triples");
  const Tally all = batches.run([&](long k, long n) { return one_file(k, n, options); });
  Report report;
  report.done = batches.done();
  Json verbs = Json::object(), between = Json::object(), edits = Json::object(), reasons = Json::object(),
       failures = Json::list();
  long agreed = 0, excused = 0;
  for (const auto& [name, counts] : all.verbs) {
    verbs.set(name, counts.figures());
    agreed += counts.of(Verdict::agreed), excused += counts.of(Verdict::excused);
  }
  for (const auto& [name, counts] : all.edits) edits.set(name, counts.figures());
  for (const auto& [name, counts] : all.laws) between.set(name, counts.figures());
  for (const auto& [why, number] : all.reasons) reasons.set(why, number);
  for (const std::string& failure : all.failures) failures.push(failure);
  report.figures.set("verbs", verbs)
      .set("edits", edits)
      .set("laws", between)
      .set("reasons", reasons)
      .set("failures", failures);
  report.passed = all.failures.empty() && agreed > 0 && 50 * excused <= agreed + excused;
  return report;
}

}  // namespace campaign
