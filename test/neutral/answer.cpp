#include "neutral/answer.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "neutral/orbit_answer.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/tangent.hpp"
#include "slapstick/quantity/measure.hpp"
#include "slapstick/quantity/reader.hpp"

namespace slapstick::neutral {
namespace {

using Kind = Quantity::Kind;

constexpr MotionOptions patience{.most_events_per_period = 20'000};
const ClassifyOptions short_search{.transient_periods = 100, .most_periods = 1000, .most_n = 32, .exponent_periods = 400};

Dimension dimension(Kind kind) {
  switch (kind) {
    case Kind::displacement:
    case Kind::gap:
      return dim::length;
    case Kind::velocity:
    case Kind::relative:
    case Kind::speed:
      return dim::speed;
    case Kind::acceleration:
      return dim::acceleration;
    case Kind::force:
      return dim::force;
    case Kind::power:
    case Kind::damping:
    case Kind::input:
      return dim::power;
    case Kind::kinetic:
    case Kind::potential:
    case Kind::loss:
      return dim::energy;
    case Kind::impulse:
      return dim::impulse;
    default:
      return dim::pure;
  }
}

/// Kinds share names ("energy", "power"); here each has its own.
std::string label(Kind kind) { return std::string(slapstick::name(kind)) + " (" + std::to_string(static_cast<int>(kind)) + ")"; }

bool odd(Kind kind) { return kind == Kind::displacement || kind == Kind::velocity || kind == Kind::acceleration; }

/// The coordinate, contact, spring or damper that a quantity is of.
std::string part_of(const System& system, const Quantity& quantity) {
  const Model& m = system.model();
  if (quantity.index < 0) return "";
  auto k = static_cast<std::size_t>(quantity.index);
  if (quantity.kind <= Kind::acceleration) return m.coordinates[k].name;
  const std::size_t contacts = m.stops.size() + m.frictions.size() + m.compliant_stops.size() + m.characteristics.size();
  if (k < contacts) return system.contact_name(quantity.index);
  k -= contacts;
  return k < m.springs.size() ? m.springs[k].name : m.dampers[k - m.springs.size()].name;
}

/// What the model can be asked for; parameters are no answer, and flights count what a period is.
std::vector<Quantity> asked(const Model& model, bool at_impacts) {
  std::vector<Quantity> all = quantities(model);
  std::erase_if(all, [&](const Quantity& q) {
    return q.kind == Kind::parameter || q.kind == Kind::flight || q.kind == Kind::sliding || (q.at_impacts() && !at_impacts);
  });
  return all;
}

/// A motion with its events, and its quantities at multiples of a grid.
class Sampler {
 public:
  Sampler(const System& system, const State& start, double grid)
      : system_(system), grid_(grid), reader_(system, asked(system.model(), false)), motion_(system, start, {}, patience) {}

  void run(int steps, Answer& answer) {
    const double T = system_.period();
    for (int k = 1; k <= steps; ++k) {
      while (motion_.advance(Instant{}.plus(k * grid_ / T)) == Outcome::event) {
        const Event& e = motion_.event();
        if (e.kind != EventKind::knot) answer.rows.push_back({e.kind, system_.contact_name(e.contact), e.time.seconds(T), e.w});
      }
      sample(k, answer);
    }
  }

 private:
  void sample(int k, Answer& answer) {
    const State state = motion_.state();
    const auto& bodies = system_.model().coordinates;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      answer.numbers.push_back({"x", bodies[i].name, state[2 * i], dim::length, true, k, k * grid_});
      answer.numbers.push_back({"v", bodies[i].name, state[2 * i + 1], dim::speed, true, k, k * grid_});
    }
    const std::vector<double>& read = reader_.now(motion_);
    for (std::size_t i = 0; i < read.size(); ++i) {
      const Quantity& q = reader_.of()[i];
      if (q.kind > Kind::velocity)
        answer.numbers.push_back({label(q.kind), part_of(system_, q), read[i], dimension(q.kind), odd(q.kind), k, k * grid_});
    }
  }

  const System& system_;
  double grid_;
  Reader reader_;
  Motion motion_;
};

void simulate(const ModelDefinition& definition, const Question& question, Answer& answer) {
  const System system(definition.build());
  Sampler(system, definition.start(), question.grid).run(question.steps, answer);
}

void add_statistics(const std::string& what, const std::string& of, const Statistics& found, Dimension d, bool is_odd, bool at_impacts, double until,
                    std::vector<Number>& numbers) {
  Dimension sum = d;
  if (!at_impacts) ++sum.time;
  numbers.push_back({what + " mean", of, found.mean, d, is_odd, -1, until});
  numbers.push_back({what + " rms", of, found.rms, d, false, -1, until});
  numbers.push_back({what + " min", of, found.least, d, is_odd, -1, until});
  numbers.push_back({what + " max", of, found.greatest, d, is_odd, -1, until});
  numbers.push_back({what + " impulse", of, found.impulse, sum, is_odd, -1, until});
}

/// From the start on, for as long as `simulate` looks.
void measure(const ModelDefinition& definition, const Question& question, Answer& answer) {
  const System system(definition.build());
  const std::vector<Quantity> of = asked(system.model(), true);
  const double until = question.grid * question.steps;
  const Measured found = slapstick::measure(Motion(system, definition.start(), {}, patience), Instant{}.plus(until / system.period()), of);
  for (std::size_t i = 0; i < of.size(); ++i)
    add_statistics(label(of[i].kind) + (of[i].at_impacts() ? " at impacts" : ""), part_of(system, of[i]), found.of[i], dimension(of[i].kind),
                   odd(of[i].kind), of[i].at_impacts(), until, answer.numbers);
}

void classify(const ModelDefinition& definition, Answer& answer) {
  const System system(definition.build());
  const Classification found = slapstick::classify(system, definition.start(), short_search);
  answer.words = {{"attractor", std::string(slapstick::name(found.attractor))}, {"class", found.label}, {"doubt", std::string(slapstick::name(found.doubt))}};
  answer.multipliers = found.multipliers;
  answer.eigenvalues = found.eigenvalues;
  const bool settled = found.n > 0 || found.attractor == Attractor::equilibrium;
  if (!settled) return;
  answer.numbers.push_back({"n", "", static_cast<double>(found.n), dim::pure});
  answer.numbers.push_back({"family", "", static_cast<double>(found.family), dim::pure});
  answer.numbers.push_back({"period", "", found.period, dim::time});
  for (std::size_t i = 0; i < found.drift.size(); ++i)
    answer.numbers.push_back({"drift", system.model().coordinates[i].name, found.drift[i], dim::length, true});
  if (found.chatter == Chatter::complete) return;
  answer.numbers.push_back({"p", "", static_cast<double>(found.p), dim::pure});
  std::map<std::string, std::vector<double>> speeds;
  for (const CycleImpact& impact : found.impacts) speeds[system.contact_name(impact.contact)].push_back(impact.w);
  for (auto& [contact, all] : speeds) {
    std::ranges::sort(all);
    for (std::size_t i = 0; i < all.size(); ++i)
      answer.numbers.push_back({"speed of impact", contact, all[i], dim::speed, false, static_cast<int>(i)});
  }
}

std::string text_of_range(const Parameter& parameter) {
  const auto [from, to] = range_of(parameter.value);
  return shown(from) + ":" + shown(to);
}

}  // namespace

const char* name(Verb verb) {
  switch (verb) {
    case Verb::simulate:
      return "simulate";
    case Verb::measure:
      return "measure";
    case Verb::classify:
      return "classify";
    case Verb::orbit:
      return "orbit";
    case Verb::branch:
      return "continue";
    case Verb::curve:
      return "curve";
  }
  return "";
}

std::size_t parameters_of(Verb verb) { return verb == Verb::curve ? 2 : verb == Verb::branch ? 1 : 0; }

bool of_trajectory(Verb verb) { return verb == Verb::simulate || verb == Verb::measure; }

Answer ask(Verb verb, const ModelDefinition& definition, const Question& question) {
  Answer answer;
  if (definition.parameters().size() < parameters_of(verb)) return {"refused", "too few parameters", {}, {}, {}, {}, {}};
  try {
    if (verb == Verb::simulate) simulate(definition, question, answer);
    if (verb == Verb::measure) measure(definition, question, answer);
    if (verb == Verb::classify) classify(definition, answer);
    if (verb == Verb::orbit) answer_orbit(definition, answer);
    if (verb == Verb::branch) answer_branch(definition, answer);
    if (verb == Verb::curve) answer_curve(definition, answer);
  } catch (const InputError& error) {
    answer = {"refused", error.what(), {}, {}, {}, {}, {}};
  } catch (const NumericalError& error) {
    answer = {"failed", error.what(), {}, {}, {}, {}, {}};
  }
  return answer;
}

std::string command(Verb verb, const ModelDefinition& definition, const std::string& file, const Question& question) {
  const std::string time = shown(question.grid * question.steps);
  const auto& parameters = definition.parameters();
  const auto range = [&](std::size_t k) { return text_of_range(parameters[k]); };
  if (verb == Verb::simulate) return "slapstick simulate " + file + " --time " + time + " --events events.csv";
  if (verb == Verb::measure) return "slapstick measure " + file + " --transient 0 --time " + time + " --of kinetic_energy";
  if (verb == Verb::classify) return "slapstick classify " + file + " --transient 100 --most-periods 1000 --most-n 32 --exponent-periods 400";
  if (verb == Verb::orbit) return "slapstick orbit " + file + " --transient 100";
  if (verb == Verb::branch) return "slapstick continue " + file + " --transient 100 --param " + parameters[0].name + " --range " + range(0);
  return "slapstick curve " + file + " --params " + parameters[0].name + "," + parameters[1].name + " --range " + parameters[0].name + "=" + range(0) +
         " --range " + parameters[1].name + "=" + range(1);
}

double growth(const ModelDefinition& definition, double until) {
  const System system(definition.build());
  const auto n = 2 * static_cast<Eigen::Index>(system.model().coordinates.size());
  TangentMotion motion(system, definition.start(), Eigen::MatrixXd::Identity(n, n), {}, patience);
  double most = 1.0;
  const Instant end = Instant{}.plus(until / system.period());
  while (motion.advance(end) == Outcome::event) most = std::max(most, motion.tangents().cwiseAbs().maxCoeff());
  return std::max(most, motion.tangents().cwiseAbs().maxCoeff());
}

}  // namespace slapstick::neutral
