#include "neutral/laws.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/text.hpp"
#include "flow/compiled_system.hpp"
#include "flow/translations.hpp"
#include "neutral/spectrum.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/orbit/search.hpp"
#include "slapstick/quantity/measure.hpp"
#include "slapstick/quantity/reader.hpp"
#include "slapstick/quantity/span.hpp"
#include "slapstick/sweep/diagram.hpp"

namespace slapstick::neutral {
namespace {

using Kind = Quantity::Kind;

constexpr MotionOptions patience{.most_events_per_period = 20'000};
/// Of a mean, relative to the largest quantity of its dimension: some hundred roundings. Less would take two roundings
/// beside a zero for a slope.
constexpr double rounding = 0x1p-44;
/// Of integrals and balances, relative to the largest term.
constexpr double close = 1e-8;

std::string broken(const std::string& what, double one, double other) {
  return what + ": " + shown(one) + ", " + shown(other);
}

std::vector<Quantity> functions_of_time(const Model& model) {
  std::vector<Quantity> all = quantities(model);
  std::erase_if(all, [](const Quantity& q) { return q.at_impacts() || q.kind == Kind::parameter; });
  return all;
}

/// A motion's quantities by a quadrature of their values: Gauss's rule of four points on short steps between events.
std::vector<double> integrals(const System& system, Motion motion, const std::vector<Quantity>& of,
                              const Question& question) {
  constexpr std::array nodes{0.06943184420297371, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629};
  constexpr std::array weights{0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693};
  constexpr int cuts = 64;  // of a grid step
  Reader reader(system, of);
  std::vector<double> sums(of.size(), 0.0);
  for (int k = 1; k <= question.steps * cuts; ++k) {
    const Instant end = Instant{}.plus(k * question.grid / cuts / system.period());
    for (Outcome outcome = Outcome::event; outcome == Outcome::event;) {
      const Instant from = motion.time();
      outcome = motion.advance(end);
      if (motion.time() == from) continue;  // another event of one instant: the last segment is still that before it
      const double h = motion.segment().duration;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const std::vector<double>& read = reader.within(motion, nodes[i] * h);
        for (std::size_t q = 0; q < of.size(); ++q) sums[q] += weights[i] * h * read[q];
      }
    }
  }
  return sums;
}

/// The columns of a trajectory, integrated, and the means of `measure` without their impulses.
std::optional<std::string> columns_integrate(const ModelDefinition& definition, const Question& question) {
  const System system(definition.build());
  std::vector<Quantity> of = functions_of_time(system.model());
  // The parts of an undetermined sum have corners where one of them comes to its limit: no events, and no quadrature's.
  std::erase_if(of, [&](const Quantity& q) { return undetermined(system.model(), q); });
  const double time = question.grid * question.steps;
  const Motion motion(system, definition.start(), {}, patience);
  const Measured found = slapstick::measure(motion, Instant{}.plus(time / system.period()), of);
  const std::vector<double> sums = integrals(system, motion, of, question);
  for (std::size_t i = 0; i < of.size(); ++i) {
    const Statistics& s = found.of[i];
    const double smooth = s.mean * time - s.impulse,
                 size = time * (1e-3 + std::max(std::abs(s.least), std::abs(s.greatest)));
    if (!(std::abs(sums[i] - smooth) <= 1e-6 * size)) return broken("integral of " + of[i].name, sums[i], smooth);
  }
  return "";
}

/// Velocities are the integrals of accelerations, positions of velocities.
std::optional<std::string> accelerations_sum_up(const ModelDefinition& definition, const Question& question) {
  const System system(definition.build());
  std::vector<Quantity> of = functions_of_time(system.model());
  std::erase_if(of, [](const Quantity& q) { return q.kind != Kind::velocity && q.kind != Kind::acceleration; });
  const double time = question.grid * question.steps;
  const Instant end = Instant{}.plus(time / system.period());
  State start = definition.start();
  Motion motion(system, start, {}, patience);
  for (std::size_t i = 0; i < 2 * system.model().coordinates.size(); ++i)  // rates follow, and sliders may be drawn
    if (system.model().is_inner(static_cast<int>(i / 2))) start[i] = motion.state()[i];
  const Measured found = slapstick::measure(motion, end, of);
  while (motion.advance(end) == Outcome::event) {
  }
  const State last = motion.state();
  for (std::size_t i = 0; i < of.size(); ++i) {
    const auto at = 2 * static_cast<std::size_t>(of[i].index) + (of[i].kind == Kind::velocity ? 0 : 1);
    const Statistics& s = found.of[i];
    const double size = time * (1e-3 + std::max(std::abs(s.least), std::abs(s.greatest))) + std::abs(s.impulse);
    if (!(std::abs(last[at] - start[at] - s.mean * time) <= close * size))
      return broken("change by " + of[i].name, last[at] - start[at], s.mean * time);
  }
  return "";
}

/// What comes in is lost or stored.
std::optional<std::string> energy_balances(const ModelDefinition& definition, const Question& question) {
  const System system(definition.build());
  const std::vector<Quantity> of = functions_of_time(system.model());
  const double time = question.grid * question.steps;
  const Instant end = Instant{}.plus(time / system.period());
  Motion motion(system, definition.start(), {}, patience);
  const Measured found = slapstick::measure(motion, end, of);
  Reader reader(system, of);
  std::vector<double> before = reader.now(motion);
  if (motion.advance(end) == Outcome::event && motion.event().time == Instant{})
    before = reader.before(motion);  // a start that is struck
  while (motion.advance(end) == Outcome::event) {
  }
  const std::vector<double> after = reader.now(motion);
  const std::size_t links = system.model().stops.size() + system.model().frictions.size() +
                            system.model().compliant_stops.size() + system.model().characteristics.size();
  double in = 0.0, lost = 0.0, stored = 0.0, size = 1e-3;
  for (std::size_t i = 0; i < of.size(); ++i) {
    const double flow = found.of[i].mean * time;
    if (of[i].kind == Kind::input) in += flow;
    // The powers of dampers by name are parts of the power of all dampers.
    if (of[i].kind == Kind::damping || (of[i].kind == Kind::power && static_cast<std::size_t>(of[i].index) < links))
      lost += flow;
    if (of[i].kind == Kind::kinetic || of[i].kind == Kind::potential)
      stored += after[i] - before[i], size += std::abs(after[i]) + std::abs(before[i]);
    if (of[i].kind == Kind::input || of[i].kind == Kind::damping || of[i].kind == Kind::power)
      size +=
          time * std::max(std::abs(found.of[i].least), std::abs(found.of[i].greatest)) + std::abs(found.of[i].impulse);
  }
  return std::abs(in - lost - stored) <= close * size
             ? ""
             : broken("energy that comes in, and is lost or stored", in, lost + stored);
}

/// What the pulses of signals give each coordinate, up to a time.
std::vector<double> blows(const System& system, const State& start, Instant end) {
  const Model& model = system.model();
  std::vector<double> momentum(model.coordinates.size(), 0.0);
  Motion motion(system, start, {}, patience);
  for (Instant last{}; motion.advance(end) == Outcome::event;) {
    if (motion.event().kind != EventKind::knot || motion.event().time == last) continue;
    last = motion.event().time;
    for (const Force& force : model.forces)
      if (force.signal >= 0 && force.presses < 0)
        momentum[static_cast<std::size_t>(force.coordinate)] +=
            force.amplitude * system.compiled().frame().signals[static_cast<std::size_t>(force.signal)].pulse(last);
  }
  return momentum;
}

/// What jumps a coordinate's velocity is the sum of the impulses of stops at its ends, -F on a, +F on b, and of blows.
std::optional<std::string> momentum_balances(const ModelDefinition& definition, const Question& question) {
  const Model model = definition.build();
  if (!model.mass.empty() || model.stops.empty()) return std::nullopt;
  const System system(model);
  std::vector<Quantity> of = functions_of_time(model);
  std::erase_if(of, [&](const Quantity& q) {
    return q.kind != Kind::acceleration &&
           !(q.kind == Kind::force && static_cast<std::size_t>(q.index) < model.stops.size());
  });
  const Instant end = Instant{}.plus(question.grid * question.steps / system.period());
  const Measured found = slapstick::measure(Motion(system, definition.start(), {}, patience), end, of);
  std::vector<double> impulses = blows(system, definition.start(), end);
  double size = 1e-3;
  for (std::size_t i = 0; i < of.size(); ++i) {
    if (of[i].kind != Kind::force) continue;
    const Stop& stop = model.stops[static_cast<std::size_t>(of[i].index)];
    if (stop.a != ground) impulses[static_cast<std::size_t>(stop.a)] -= stop.ratio.a * found.of[i].impulse;
    if (stop.b != ground) impulses[static_cast<std::size_t>(stop.b)] += stop.ratio.b * found.of[i].impulse;
    size += std::abs(found.of[i].impulse);
  }
  for (std::size_t i = 0; i < of.size(); ++i) {
    if (of[i].kind != Kind::acceleration) continue;
    const auto k = static_cast<std::size_t>(of[i].index);
    const double jumps = model.coordinates[k].mass * found.of[i].impulse;
    if (!(std::abs(jumps - impulses[k]) <= close * size))
      return broken("jumps of " + model.coordinates[k].name + " and impulses", jumps, impulses[k]);
  }
  return "";
}

/// A value of a diagram begins after its transient, as a motion does.
std::optional<std::string> diagram_measures(const ModelDefinition& definition, const Question&) {
  constexpr int transient = 2, periods = 3;
  const Model model = definition.build();
  const State start = definition.start();
  sweep::DiagramProblem problem;
  problem.model_at = [&](double) { return model; };
  problem.start_at = [&](double) { return start; };
  problem.from = problem.to = 1.0, problem.count = 1;
  problem.transient_periods = transient, problem.measured_periods = periods;
  problem.of = functions_of_time(model);
  problem.threads = 1;
  const sweep::Diagram diagram = sweep::run_diagram(problem);
  const System system(model);
  Motion motion(system, start, {}, patience);
  while (motion.advance({transient, 0.0}) == Outcome::event) {
  }
  const Measured found = slapstick::measure(motion, {transient + periods, 0.0}, problem.of);
  if (diagram.points[0].of.size() != problem.of.size()) return "the diagram says: " + diagram.points[0].failure;
  for (std::size_t i = 0; i < problem.of.size(); ++i) {
    const Statistics &one = diagram.points[0].of[i], &other = found.of[i];
    const double size = 1e-3 + std::max(std::abs(other.least), std::abs(other.greatest)) + std::abs(other.impulse);
    if (!(std::abs(one.mean - other.mean) <= close * size))
      return broken("mean of " + problem.of[i].name, one.mean, other.mean);
  }
  return "";
}

/// The multipliers of `classify` and of the orbit's own equations, each set with the other's order.
std::optional<std::string> multipliers_agree(const ModelDefinition& definition, const Question&) {
  const System system(definition.build());
  if (!system.model().periodic()) return std::nullopt;
  const Classification found = slapstick::classify(
      system, definition.start(), {.transient_periods = 100, .most_periods = 500, .most_n = 16, .exponent_periods = 0});
  if (found.attractor != Attractor::periodic) return std::nullopt;
  const auto problem = orbit::pose(definition.family({}), {});
  const orbit::Settled settled =
      orbit::settle(*problem, system, definition.start(), {.transient = 100, .most_periods = 500, .most_n = 16});
  if (!settled.orbit) return std::nullopt;  // its equations are not solved, and orbit says it
  if (settled.orbit->label != found.label) return "classify names " + found.label + ", orbit " + settled.orbit->label;
  Spectrum others = settled.orbit->multipliers;
  if (others.size() != found.multipliers.size())
    return broken("number of multipliers", static_cast<double>(found.multipliers.size()),
                  static_cast<double>(others.size()));
  for (const auto& one : found.multipliers) {
    const std::complex<double> nearest = *take_nearest(others, one);
    const char* what = settled.orbit->chatter ? "multiplier with chatter" : "multiplier";
    if (std::abs(nearest - one) > 1e-5) return broken(what, std::abs(one), std::abs(nearest));
  }
  return "";
}

/// A motion may stay in one mode, at rest or on a cycle of period T without events. Its eigenvalues, or multipliers
/// exp(lambda T), are then those of the mode with the contacts held that it holds. Those of what is held, of
/// translations and of families (0, or 1) are left out. The two ways share A, the balance, and the eigenvalues of
/// Eigen.
std::optional<std::string> modes_agree(const ModelDefinition& definition, const Question&) {
  constexpr double nothing = 1e-6, close = 1e-6;  // a double eigenvalue is known to half of its digits
  const System system(definition.build());
  const Classification found = slapstick::classify(
      system, definition.start(), {.transient_periods = 100, .most_periods = 500, .most_n = 16, .exponent_periods = 0});
  const bool rests = found.attractor == Attractor::equilibrium;
  if (!rests && !(found.n > 0 && found.p == 0)) return std::nullopt;
  Motion motion(system, found.state);
  const double period = found.n * system.period();
  while (motion.advance({rests ? 1 : found.n, 0.0}) == Outcome::event)
    if (!rests)
      return std::nullopt;  // a rest may be told with a rounding of speed, by which a contact is about to stick
  const mode::ContactStates states = system.states(motion.mode_id());
  Spectrum all;
  for (const NaturalMode& mode : natural_modes(system, states))
    for (const auto& lambda : eigenvalues(mode)) all.push_back(rests ? lambda : std::exp(lambda * period));
  for (const auto& one : rests ? found.eigenvalues : found.multipliers) {
    if (std::abs(one) < nothing || (!rests && std::abs(one - 1.0) < nothing)) continue;
    const auto nearest = take_nearest(all, one);
    if (!nearest) return broken("a mode more than there are", std::abs(one), 0.0);
    if (std::abs(*nearest - one) > close * (1.0 + std::abs(one)))
      return broken(rests ? "eigenvalue" : "multiplier without events", std::abs(one), std::abs(*nearest));
  }
  return "";
}

/// Derivatives of the means over a cycle, and differences of two cycles beside it.
std::optional<std::string> sensitivities_are_differences(const ModelDefinition& definition, const Question&) {
  const System system(definition.build());
  if (!system.model().periodic() || definition.parameters().empty()) return std::nullopt;
  const SpanWish wish{.transient = 100, .instead = 1};
  const auto span = find_span(definition, {}, system, definition.start(), wish);
  if (!span->cycle || !span->cycle->isolated() || !span->cycle->stable()) return std::nullopt;
  std::vector<Quantity> of = functions_of_time(system.model());
  // A cycle that may be moved along has no place of its own.
  if (flow::translation_count(system.model(), system.compiled().frame()) > 0)
    std::erase_if(of, [](const Quantity& q) { return q.kind == Kind::displacement; });
  const Parameter& by = definition.parameters().front();
  const std::vector<Measured> rates = measure_rates(definition, {}, {by.name}, span->cycle->orbit, of);
  const Measured here = slapstick::measure(*span, of);
  std::map<Dimension, double> largest;
  for (std::size_t i = 0; i < of.size(); ++i) {
    const double greatest = std::max(std::abs(here.of[i].least), std::abs(here.of[i].greatest));
    double& size = largest[dimension(of[i].kind)];
    size = std::max(size, greatest);
    if (of[i].kind != Quantity::Kind::acceleration) continue;  // M x'': also where no part that moves x has a name
    double& force = largest[dim::force];
    force = std::max(force, greatest * system.model().coordinates[static_cast<std::size_t>(of[i].index)].mass);
  }
  const auto mean_beside = [&](double value) -> std::optional<Measured> {
    const Overrides other{{by.name, value}};
    const System there(definition.build(other));
    const auto cycle = find_span(definition, other, there, definition.start(other), wish);
    if (!cycle->cycle || cycle->cycle->label != span->cycle->label) return std::nullopt;
    return slapstick::measure(*cycle, of);
  };
  // Of a cycle that bends within a short range the longer step is off, of a mean of little change the shorter one.
  std::string said;
  for (const double step : {1e-5, 1e-6}) {
    const double h = step * std::max(1e-2, std::abs(by.value));
    const auto before = mean_beside(by.value - h), behind = mean_beside(by.value + h);
    if (!before || !behind) return said.empty() ? std::nullopt : std::optional(said);
    said = "";
    for (std::size_t i = 0; i < of.size() && said.empty(); ++i) {
      const double rate = rates[0].of[i].mean, slope = (behind->of[i].mean - before->of[i].mean) / (2.0 * h);
      const double size = std::abs(slope) + std::max(std::abs(here.of[i].least), std::abs(here.of[i].greatest)) /
                                                std::max(1e-2, std::abs(by.value));
      const double resolved = rounding * largest[dimension(of[i].kind)] / h;  // by the difference of two means
      if (!(std::abs(rate - slope) <= 1e-3 * size + resolved))
        said = broken("d mean(" + of[i].name + ") / d " + by.name + " and the difference", rate, slope);
    }
    if (said.empty()) break;
  }
  return said;
}

bool breaks(const Definition& file, const Law& law) {
  const auto found = check(law, read(file));
  return found && !found->empty();
}

}  // namespace

const std::vector<Law>& laws() {
  static const std::vector<Law> all = {
      {"columns-integrate", "columns of simulate integrate to the means of measure", columns_integrate},
      {"accelerations", "accelerations with their impulses sum up to velocities, velocities to positions",
       accelerations_sum_up},
      {"energy", "energy that comes in is lost or stored", energy_balances},
      {"momentum", "what impacts do to a coordinate is the sum of their impulses", momentum_balances},
      {"diagram", "a value of a diagram is that of measure", diagram_measures},
      {"multipliers", "multipliers of classify and of orbit agree", multipliers_agree},
      {"modes", "eigenvalues of rests, and multipliers without events, are those of modes", modes_agree},
      {"basins", "a start belongs to the basin of the attractor that classify finds", basins_classify},
      {"sensitivities", "sensitivities of measure are differences", sensitivities_are_differences},
  };
  return all;
}

std::optional<std::string> check(const Law& law, const ModelDefinition& definition) {
  try {
    return law.check(definition, {sample_grid(definition.build())});
  } catch (const NumericalError&) {
    return std::nullopt;
  } catch (const InputError&) {  // a neighbour of a parameter's value that the model does not allow
    return std::nullopt;
  }
}

Definition smallest(const Definition& file, const Law& law, int most_tries) {
  Definition best = file;
  for (bool smaller = true; smaller;) {
    smaller = false;
    for (const Definition& candidate : simpler(best)) {
      if (--most_tries < 0) return best;
      if (!breaks(candidate, law)) continue;
      best = read_definition(text(candidate), "random.toml");
      smaller = true;
      break;
    }
  }
  return best;
}

}  // namespace slapstick::neutral
