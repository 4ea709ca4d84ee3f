#include "neutral/answer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.hpp"
#include "neutral/orbit_answer.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/tangent.hpp"
#include "slapstick/quantity/measure.hpp"
#include "slapstick/quantity/reader.hpp"

namespace slapstick::neutral {

using Kind = Quantity::Kind;

Named named(const Model& m, std::size_t coordinate) {
  for (const Spring& spring : m.springs)
    if (spring.inner == static_cast<int>(coordinate)) return {spring.name, false};
  for (const Characteristic& slider : m.characteristics)
    if (slider.inner == static_cast<int>(coordinate)) return {slider.name, false};
  return {m.coordinates[coordinate].name, true};
}

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
    case Kind::normal:
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
    case Kind::flight:
    case Kind::sliding:
    case Kind::parameter:
      return dim::pure;
  }
  return dim::pure;
}

namespace {

constexpr MotionOptions patience{.most_events_per_period = 20'000};
const ClassifyOptions short_search{
    .transient_periods = 100, .most_periods = 1000, .most_n = 32, .exponent_periods = 400};

/// Kinds share names ("energy", "power"); here each has its own.
std::string label(Kind kind) {
  return std::string(slapstick::name(kind)) + " (" + std::to_string(static_cast<int>(kind)) + ")";
}

/// The motions of the generator's machines stay below it.
constexpr double out_of_reach = 50.0;
/// Of the fastest: slower ones belong to a chatter. Less would compare counts that rounding makes.
constexpr double slow_impact = 1e-4;

bool odd(const Model& model, const Quantity& quantity) {
  return quantity.kind <= Kind::acceleration && named(model, static_cast<std::size_t>(quantity.index)).odd;
}

/// The coordinate, contact, spring or damper that a quantity is of.
std::string part_of(const System& system, const Quantity& quantity) {
  const Model& m = system.model();
  if (quantity.index < 0) return "";
  auto k = static_cast<std::size_t>(quantity.index);
  if (quantity.kind <= Kind::acceleration) return named(m, k).name;
  const std::size_t contacts =
      m.stops.size() + m.frictions.size() + m.compliant_stops.size() + m.characteristics.size();
  if (k < contacts) return system.contact_name(quantity.index);
  k -= contacts;
  return k < m.springs.size() ? m.springs[k].name : m.dampers[k - m.springs.size()].name;
}

/// The stops that can be reached and the friction contacts on a contact's pair, it included; none if it is alone.
std::vector<int> holding_together(const Model& m, int contact) {
  const auto stops = static_cast<int>(m.stops.size()), holders = stops + static_cast<int>(m.frictions.size());
  if (contact < 0 || contact >= holders) return {};
  const auto ends = [&](int c) {
    const auto k = static_cast<std::size_t>(c < stops ? c : c - stops);
    const int a = c < stops ? m.stops[k].a : m.frictions[k].a, b = c < stops ? m.stops[k].b : m.frictions[k].b;
    return std::minmax({a, b});
  };
  const auto far = [](double clearance) { return clearance > out_of_reach; };
  const auto acts = [&](int c) {
    if (c < stops) return !far(m.stops[static_cast<std::size_t>(c)].clearance);
    const auto& normal = m.frictions[static_cast<std::size_t>(c - stops)].normal;
    return !normal || normal->compliant_stop < 0 ||
           !far(m.compliant_stops[static_cast<std::size_t>(normal->compliant_stop)].clearance);
  };
  std::vector<int> found;
  for (int other = 0; other < holders; ++other)
    if (ends(other) == ends(contact) && acts(other)) found.push_back(other);
  return found.size() > 1 ? found : std::vector<int>{};
}

/// What the model can be asked for; parameters are no answer, and flights count what a period is.
std::vector<Quantity> asked(const Model& model, bool at_impacts) {
  std::vector<Quantity> all = quantities(model);
  std::erase_if(all, [&](const Quantity& q) {
    return q.kind == Kind::parameter || q.kind == Kind::flight || q.kind == Kind::sliding ||
           (q.at_impacts() && !at_impacts);
  });
  return all;
}

/// Of contacts on one pair that hold together one is told when they let go (docs/explanation/mode_graph.md). Each has a
/// sense of its own. The one with the shortest name stands for all. The sense of a slip is seen in its force.
Row told(const System& system, const Event& event) {
  const Model& m = system.model();
  Row row{event.kind, system.contact_name(event.contact), event.time.seconds(system.period()), event.w};
  const auto of_stop = [&](int contact) { return static_cast<std::size_t>(contact) < m.stops.size(); };
  if (event.kind == EventKind::impact) return row;
  if (event.kind == EventKind::stick && of_stop(event.contact)) row.kind = EventKind::chatter;
  if (event.kind == EventKind::slip_minus) row.kind = EventKind::slip_plus;
  const std::vector<int> together = holding_together(m, event.contact);
  row.held = event.kind == EventKind::release && std::ranges::any_of(together, of_stop);
  for (const int other : together)
    if (of_stop(other) == of_stop(event.contact))
      if (const std::string its = system.contact_name(other);
          std::pair(its.size(), its) < std::pair(row.contact.size(), row.contact))
        row.contact = its;
  return row;
}

/// A motion with its events, and its quantities at multiples of a grid.
class Sampler {
 public:
  Sampler(const System& system, const State& start, double grid)
      : system_(system),
        grid_(grid),
        reader_(system, asked(system.model(), false)),
        motion_(system, start, {}, patience) {}

  void run(int steps, Answer& answer) {
    const double T = system_.period();
    for (int k = 1; k <= steps; ++k) {
      for (ModeId here = motion_.mode_id(); motion_.advance(Instant{}.plus(k * grid_ / T)) == Outcome::event;
           here = motion_.mode_id()) {
        const Event& e = motion_.event();
        if (!(e.time == instant_)) before_ = here, instant_ = e.time;
        if (e.kind == EventKind::knot || touches_rest(e)) continue;
        answer.rows.push_back(told(system_, e));
      }
      sample(k, answer);
    }
  }

 private:
  /// A slip whose velocity is zero for an instant, and which goes on as it was: of several at once one is told.
  [[nodiscard]] bool touches_rest(const Event& event) const {
    if (event.kind != EventKind::slip_plus && event.kind != EventKind::slip_minus) return false;
    const auto k = static_cast<std::size_t>(event.contact) - system_.model().stops.size();
    return system_.states(before_).frictions[k] == system_.states(motion_.mode_id()).frictions[k];
  }

  void sample(int k, Answer& answer) {
    const State state = motion_.state();
    const auto& bodies = system_.model().coordinates;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const auto [name, odd] = named(system_.model(), i);
      answer.numbers.push_back({"x", name, state[2 * i], dim::length, odd, k, k * grid_});
      answer.numbers.push_back({"v", name, state[2 * i + 1], dim::speed, odd, k, k * grid_});
    }
    const std::vector<double>& read = reader_.now(motion_);
    for (std::size_t i = 0; i < read.size(); ++i) {
      const Quantity& q = reader_.of()[i];
      if (q.kind > Kind::velocity)
        answer.numbers.push_back({label(q.kind), part_of(system_, q), read[i], dimension(q.kind),
                                  odd(system_.model(), q), k, k * grid_, undetermined(system_.model(), q)});
    }
  }

  const System& system_;
  double grid_;
  Reader reader_;
  Motion motion_;
  ModeId before_ = motion_.mode_id();  ///< before the events of one instant
  Instant instant_;
};

void simulate(const ModelDefinition& definition, const Question& question, Answer& answer) {
  const System system(definition.build());
  Sampler(system, definition.start(), question.grid).run(question.steps, answer);
}

/// Rounding decides how many impacts a complete chatter has before its limit, and so what is summed over impacts.
void add_statistics(const Number& of_all, const Statistics& found, bool at_impacts, std::vector<Number>& numbers) {
  const auto add = [&](const char* what, double value, bool odd, Dimension d) {
    numbers.push_back(of_all);
    numbers.back().what += what, numbers.back().value = value, numbers.back().odd = odd, numbers.back().dimension = d;
  };
  const Dimension d = of_all.dimension;
  Dimension sum = d;
  if (!at_impacts) ++sum.time;
  add(" max", found.greatest, of_all.odd, d);
  if (at_impacts && !(found.least > slow_impact * found.greatest)) return;
  add(" min", found.least, of_all.odd, d);
  add(" mean", found.mean, of_all.odd, d);
  add(" rms", found.rms, false, d);
  add(" impulse", found.impulse, of_all.odd, sum);
}

/// From the start on, for as long as `simulate` looks.
void measure(const ModelDefinition& definition, const Question& question, Answer& answer) {
  const System system(definition.build());
  const std::vector<Quantity> of = asked(system.model(), true);
  const double until = question.grid * question.steps;
  const Measured found =
      slapstick::measure(Motion(system, definition.start(), {}, patience), Instant{}.plus(until / system.period()), of);
  for (std::size_t i = 0; i < of.size(); ++i) {
    const Number all{label(of[i].kind) + (of[i].at_impacts() ? " at impacts" : ""),
                     part_of(system, of[i]),
                     0.0,
                     dimension(of[i].kind),
                     odd(system.model(), of[i]),
                     -1,
                     until,
                     undetermined(system.model(), of[i])};
    add_statistics(all, found.of[i], of[i].at_impacts(), answer.numbers);
  }
}

void classify(const ModelDefinition& definition, Answer& answer) {
  const System system(definition.build());
  const Classification found = slapstick::classify(system, definition.start(), short_search);
  answer.periods_used = found.periods_used;
  answer.words = {{"attractor", std::string(slapstick::name(found.attractor))},
                  {"class", found.label},
                  {"doubt", std::string(slapstick::name(found.doubt))}};
  answer.multipliers = found.multipliers;
  answer.eigenvalues = found.eigenvalues;
  const bool settled = found.n > 0 || found.attractor == Attractor::equilibrium;
  if (!settled) return;
  answer.numbers.push_back({"n", "", static_cast<double>(found.n), dim::pure});
  answer.numbers.push_back({"family", "", static_cast<double>(found.family), dim::pure});
  answer.numbers.push_back({"period", "", found.period, dim::time});
  const bool by_time = found.n == 0 && !system.model().forced();  // of an equilibrium without a clock
  for (std::size_t i = 0; i < found.drift.size(); ++i)
    answer.numbers.push_back({"drift", named(system.model(), i).name, found.drift[i],
                              by_time ? dim::speed : dim::length, named(system.model(), i).odd});
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

/// Those of the sliding machine: which contacts a file has that an edit does not change, a verb does not know.
void modes(const ModelDefinition& definition, Answer& answer) {
  const System system(definition.build());
  for (const NaturalMode& mode : natural_modes(system, sliding_states(system, definition.start())))
    for (const std::complex<double>& lambda : eigenvalues(mode)) answer.eigenvalues.push_back(lambda);
}

std::string text_of_range(const Parameter& parameter) {
  const auto [from, to] = range_of(parameter.value);
  return shown(from) + ":" + shown(to);
}

}  // namespace

bool undetermined(const Model& model, const Quantity& q) {
  return (q.kind == Kind::force || q.kind == Kind::power || q.kind == Kind::loss) &&
         !holding_together(model, q.index).empty();
}

const char* name(Verb verb) {
  switch (verb) {
    case Verb::simulate:
      return "simulate";
    case Verb::measure:
      return "measure";
    case Verb::classify:
      return "classify";
    case Verb::modes:
      return "modes";
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
  if (definition.parameters().size() < parameters_of(verb))
    return {"refused", "too few parameters", {}, {}, {}, {}, {}};
  try {
    if (verb == Verb::simulate) simulate(definition, question, answer);
    if (verb == Verb::measure) measure(definition, question, answer);
    if (verb == Verb::classify) classify(definition, answer);
    if (verb == Verb::modes) modes(definition, answer);
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
  if (verb == Verb::measure)
    return "slapstick measure " + file + " --transient 0 --time " + time + " --of kinetic_energy";
  if (verb == Verb::classify)
    return "slapstick classify " + file + " --transient 100 --most-periods 1000 --most-n 32 --exponent-periods 400";
  if (verb == Verb::modes) return "slapstick modes " + file;
  if (verb == Verb::orbit) return "slapstick orbit " + file + " --transient 100";
  if (verb == Verb::branch)
    return "slapstick continue " + file + " --transient 100 --param " + parameters[0].name + " --range " + range(0);
  return "slapstick curve " + file + " --params " + parameters[0].name + "," + parameters[1].name + " --range " +
         parameters[0].name + "=" + range(0) + " --range " + parameters[1].name + "=" + range(1);
}

std::vector<std::complex<double>> eigenvalues(const NaturalMode& mode) {
  const std::complex<double> lambda(-mode.decay, 2.0 * std::numbers::pi * mode.cycles());
  if (!mode.oscillates()) return {lambda};
  return {lambda, std::conj(lambda)};
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
