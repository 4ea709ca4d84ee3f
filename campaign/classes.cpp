/// Campaign `classes`: what classify says of random models, parameters and starts, a fifth of them right beside special
/// points of a branch, against three judges: the orbit's own equations, the motion followed on, and 50 digits.
#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "batches.hpp"
#include "oracle/oracle.hpp"
#include "random.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/continuation/branch.hpp"
#include "slapstick/io/model_file.hpp"
#include "slapstick/orbit/search.hpp"

namespace campaign {
namespace {

using namespace slapstick;

constexpr int quick_periods = 2000;

/// What is classified.
struct Question {
  std::string model;
  Overrides values;
  State start;
  double beside = 0.0;                 ///< a special point: how far, relative to the range; 0: none
  std::optional<orbit::Orbit> branch;  ///< the special point's orbit
};

struct Counts {
  long all = 0, undecided = 0;
  void add(const Counts& o) { all += o.all, undecided += o.undecided; }
};

struct Tally {
  long cases = 0, failed = 0, wrong = 0, contradictions = 0, cycles = 0, curves = 0, chaotic = 0, families = 0,
       by_oracle = 0, transients = 0, longer = 0;
  Counts away, beside, close;  ///< of special points: none; 1e-3 to 1e-6; nearer
  std::vector<std::string> notes;
  void add(const Tally& o) {
    cases += o.cases, failed += o.failed, wrong += o.wrong, contradictions += o.contradictions;
    cycles += o.cycles, curves += o.curves, chaotic += o.chaotic, families += o.families, by_oracle += o.by_oracle;
    transients += o.transients, longer += o.longer;
    away.add(o.away), beside.add(o.beside), close.add(o.close);
    notes.insert(notes.end(), o.notes.begin(), o.notes.end());
  }
};

std::vector<std::string> forced_models() {
  std::vector<std::string> names;
  for (const std::string& name : builtin_models())
    if (load_model(name).build().forced()) names.push_back(name);
  return names;
}

/// Up to a factor 1.2 from the model's own values, and any frequency from half to twice its own.
Overrides random_values(const ModelDefinition& definition, Random& random) {
  Overrides values;
  for (const Parameter& parameter : definition.parameters()) {
    const double reach = parameter.name == "omega" ? 1.0 : 0.263;
    const double value = parameter.value * std::exp2(random.uniform(-reach, reach));
    if (parameter.expression.empty() && parameter.admits(value)) values[parameter.name] = value;
  }
  return values;
}

State moved(State state, Random& random, double share) {
  double size = 0.0;
  for (const double x : state) size = std::max(size, std::abs(x));
  for (double& x : state) x += share * (size > 0.0 ? size : 1.0) * random.uniform(-1.0, 1.0);
  return state;
}

/// A start that the stops admit, as near to `wanted` as the first of some tries.
State admissible(const Model& model, const State& own, Random& random, double share) {
  for (int attempt = 0; attempt < 8; ++attempt) {
    const State start = moved(own, random, share);
    try {
      validate(model, start);
      return start;
    } catch (const InputError&) {
    }
  }
  return own;
}

Question anywhere(const std::string& name, Random& random) {
  const ModelDefinition definition = load_model(name);
  Question question{name, random_values(definition, random), {}, 0.0, {}};
  const Model model = definition.build(question.values);
  question.start = admissible(model, definition.start(question.values), random, 0.5);
  return question;
}

/// 1e-3 to 1e-9 of the followed range from a special point of the branch through what the motion settles on.
std::optional<Question> beside_special_point(const std::string& name, Random& random, const Options& options) {
  constexpr double reach = 0.1;
  Question question = anywhere(name, random);
  const ModelDefinition definition = load_model(name);
  const auto values = definition.values(question.values);
  if (!values.contains("omega")) return std::nullopt;
  const double omega = values.at("omega");
  const auto problem = orbit::pose(definition.family({"omega"}, question.values), {omega});
  const auto first = orbit::settle(*problem, System(definition.build(question.values)), question.start,
                                   {.transient = 200, .most_periods = 2000, .stop = options.stop});
  if (!first.orbit || !first.orbit->isolated()) return std::nullopt;
  const double range = 2.0 * reach * omega;
  const orbit::Branch branch = orbit::follow(*problem, first.orbit->orbit,
                                             {.from = omega - 0.5 * range,
                                              .to = omega + 0.5 * range,
                                              .most_points = 60,
                                              .longest_step = 0.05,
                                              .stop = options.stop});
  std::vector<const orbit::SpecialPoint*> usable;
  for (const orbit::SpecialPoint& point : branch.special)
    if (point.type != orbit::SpecialType::CH && point.error < 1e-11 * range) usable.push_back(&point);
  if (usable.empty()) return std::nullopt;
  const orbit::SpecialPoint& point = *usable[static_cast<std::size_t>(random.below(static_cast<int>(usable.size())))];
  question.beside = random.decades(-9.0, -3.0);
  question.values["omega"] = point.value + random.sign() * question.beside * range;
  question.branch = point.solution.orbit;
  question.start =
      admissible(definition.build(question.values), orbit::at_phase_zero(*problem, point.solution.orbit), random, 1e-3);
  return question;
}

std::string described(const Question& question) {
  std::string text = question.model;
  for (const auto& [name, value] : question.values) text += " --set " + name + "=" + shown(value);
  text += " --state ";
  const std::vector<std::string> names = state_names(load_model(question.model).build());
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : ",") + names[i] + "=" + shown(question.start[i]);
  return text;
}

/// Judges what was said of one question.
class Judge {
 public:
  Judge(const Question& question, const Options& options)
      : options_(options),
        question_(question),
        definition_(load_model(question.model)),
        system_(definition_.build(question.values)),
        problem_(orbit::pose(definition_.family({}, question.values), {})) {}

  /// Why the class is wrong; empty if nothing speaks against it.
  std::string objection(const Classification& found, Tally& tally) const {
    if (found.n > 0) return against_cycle(found, tally);
    if (found.attractor == Attractor::undecided) return {};
    return against_no_cycle(found, tally);
  }

  [[nodiscard]] const System& system() const { return system_; }

 private:
  /// The orbit's own equations (its multipliers by other formulas than classify's), and their shortest cycle.
  std::string against_cycle(const Classification& found, Tally& tally) const {
    const auto orbit = orbit::orbit_near(*problem_, Motion(system_, found.state), 0, found.n, options_.stop);
    if (orbit && orbit->orbit.shape.n != found.n)
      return "the orbit there has n = " + std::to_string(orbit->orbit.shape.n);
    if (orbit && orbit->label != found.label) return "the orbit there is " + orbit->label;
    if (orbit && found.family == 0 && !orbit->stable()) return "the orbit there is not stable";
    if (std::string why = against_approach(found); !why.empty()) return why;
    return against_return(found, tally);
  }

  /// The motion itself, followed on: it may not leave what it is said to settle on.
  std::string against_approach(const Classification& found) const {
    constexpr long further = 5'000;
    constexpr double drawn = 0.05;  // of the motion's size
    if (!found.drift.empty()) return {};
    Motion motion(system_, question_.start);
    const Instant end{found.n * ((found.periods_used + further) / found.n + 1), 0.0};
    while (motion.advance(end) == Outcome::event)
      if (options_.stopped()) return {};
    double size = 0.0, nearest = INFINITY;
    Motion cycle(system_, found.state);
    for (int k = 0; k < found.n; ++k) {
      const State there = cycle.state(), here = motion.state();
      double away = 0.0;
      for (std::size_t i = 0; i < here.size(); ++i) {
        size = std::max({size, std::abs(there[i]), std::abs(here[i])});
        away = std::max(away, std::abs(there[i] - here[i]));
      }
      nearest = std::min(nearest, away);
      while (cycle.advance({k + 1, 0.0}) == Outcome::event) {
      }
    }
    return nearest <= drawn * size ? "" : "the motion is " + shown(nearest / size) + " away after 5000 more periods";
  }

  static bool oracle_knows(const Model& model) {
    return model.stops.size() <= 1 && model.frictions.size() <= 1 && model.compliant_stops.empty() &&
           model.characteristics.empty() &&
           std::ranges::none_of(model.frictions, [](const FrictionContact& one) { return one.normal.has_value(); }) &&
           std::ranges::all_of(model.stops, [](const Stop& stop) { return stop.corners.empty(); });
  }

  /// 50 digits by a program of its own: the cycle closes, with as many impacts.
  std::string against_return(const Classification& found, Tally& tally) const {
    constexpr int longest = 4;
    constexpr double closes = 1e-7;
    const Model& model = system_.model();
    if (!oracle_knows(model) || found.n > longest || found.chatter == Chatter::complete || !found.drift.empty())
      return {};
    ++tally.by_oracle;
    oracle::Oracle oracle(model, found.state);
    long impacts = 0;
    for (const oracle::OracleEvent& event : oracle.run(found.n * oracle.period())) impacts += event.kind == "impact";
    const oracle::Vector end = oracle.state();
    double size = 0.0, away = 0.0;
    for (std::size_t i = 0; i < end.size(); ++i) {
      size = std::max(size, std::abs(found.state[i]));
      away = std::max(away, std::abs(static_cast<double>(end[i]) - found.state[i]));
    }
    if (impacts != found.p) return "50 digits count " + std::to_string(impacts) + " impacts";
    return away <= closes * size ? "" : "50 digits miss the return by " + shown(away / size);
  }

  /// The motion followed on comes to a cycle. Chaos may be a long transient: that is counted by itself.
  std::string against_no_cycle(const Classification& found, Tally& tally) const {
    constexpr long further = 20'000;
    constexpr double returned = 1e-9;
    ClassifyOptions cycles_only{.transient_periods = static_cast<int>(found.periods_used + further),
                                .most_periods = 500,
                                .exponent_periods = 0,
                                .cancel = options_.stop};
    const Classification later = classify(system_, question_.start, cycles_only);
    if (later.attractor != Attractor::periodic || later.approach > returned) return {};
    const std::string why = "after 20000 more periods the motion is the cycle " + later.label;
    if (found.attractor != Attractor::chaotic) return why;
    ++tally.transients;
    tally.notes.push_back("a chaotic transient: " + described(question_) + ": " + why);
    return {};
  }

  const Options& options_;
  const Question& question_;
  ModelDefinition definition_;
  System system_;
  std::shared_ptr<const orbit::Problem> problem_;
};

void examine(const Question& question, const Options& options, Tally& tally) {
  const Judge judge(question, options);
  constexpr int longest_cycle = 1024;
  Classification found = classify(judge.system(), question.start, {.cancel = options.stop});
  const Classification quick =
      classify_quickly(judge.system(), question.start, quick_periods, {.cancel = options.stop});
  if (options.stopped()) return;
  bool undecided = found.attractor == Attractor::undecided;
  if (undecided && found.doubt == Doubt::long_cycle) {  // the answer names the option that decides
    found = classify(judge.system(), question.start, {.most_n = longest_cycle, .cancel = options.stop});
    undecided = found.attractor == Attractor::undecided;
    ++tally.longer;
  }
  Counts& counts = question.beside == 0.0 ? tally.away : question.beside > 1e-6 ? tally.beside : tally.close;
  counts.add({1, undecided ? 1 : 0});
  tally.cycles += found.attractor == Attractor::periodic;
  tally.curves += found.attractor == Attractor::quasi_periodic;
  tally.chaotic += found.attractor == Attractor::chaotic;
  tally.families += found.attractor == Attractor::family;
  const std::string what = described(question) + ": " + found.label;
  if (undecided) tally.notes.push_back("undecided: " + what + ", " + std::string(name(found.doubt)));
  if (quick.attractor != Attractor::undecided && !undecided && quick.label != found.label) {
    ++tally.contradictions;
    tally.notes.push_back("contradiction: " + what + ", quickly " + quick.label);
  }
  const Classification& decided = undecided ? quick : found;
  if (const std::string why = judge.objection(decided, tally); !why.empty()) {
    ++tally.wrong;
    tally.notes.push_back("wrong: " + what + (undecided ? ", quickly " + decided.label : "") + ": " + why);
  }
}

Tally one_case(const std::vector<std::string>& models, long number, const Options& options) {
  constexpr int share = 5;        // one of this many cases lies beside a special point
  constexpr int most_tries = 20;  // for a branch with a special point
  Random random(options.seed, static_cast<std::uint64_t>(number));
  const auto any_model = [&] {
    return models[static_cast<std::size_t>(random.below(static_cast<int>(models.size())))];
  };
  Tally tally;
  tally.cases = 1;
  std::string name;
  std::optional<Question> question;
  for (int i = 0; i < most_tries && !question && !options.stopped(); ++i) {
    name = any_model();
    try {
      question = number % share == 0 ? beside_special_point(name, random, options) : anywhere(name, random);
    } catch (const std::runtime_error&) {  // random values may contradict one another, or lead to no motion
    }
  }
  try {
    if (question) examine(*question, options, tally);
    tally.failed += question ? 0 : 1;
  } catch (const std::runtime_error& error) {
    ++tally.failed;
    tally.notes.push_back(name + ": " + error.what());
  }
  return tally;
}

Json counted(const Counts& counts) {
  return Json::object().set("cases", counts.all).set("undecided", counts.undecided);
}

}  // namespace

Report run_classes(const Options& options) {
  const std::vector<std::string> models = forced_models();
  Batches<Tally> batches(options, 1, "cases");
  const Tally all = batches.run([&](long k, long) { return one_case(models, k, options); });
  Report report;
  report.done = batches.done();
  report.figures.set("cases", all.cases).set("no_model_or_motion", all.failed).set("wrong", all.wrong);
  report.figures.set("quick_contradicts_full", all.contradictions).set("checked_by_50_digits", all.by_oracle);
  report.figures.set("cycles", all.cycles).set("quasi_periodic", all.curves).set("chaotic", all.chaotic);
  report.figures.set("chaotic_transients_that_ended", all.transients).set("cycles_longer_than_64_periods", all.longer);
  report.figures.set("one_of_a_family", all.families).set("away", counted(all.away));
  report.figures.set("beside_1e-3_to_1e-6", counted(all.beside)).set("beside_1e-6_to_1e-9", counted(all.close));
  Json notes = Json::list();
  for (const std::string& note : all.notes) notes.push(note);
  report.figures.set("notes", notes);
  const auto share = [](const Counts& counts) {
    return static_cast<double>(counts.undecided) / static_cast<double>(std::max(1L, counts.all));
  };
  report.passed = all.wrong == 0 && all.contradictions == 0 && share(all.away) <= 0.02 && share(all.close) <= 0.3;
  return report;
}

}  // namespace campaign
