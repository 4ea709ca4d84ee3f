/// Edits of the machine as a whole: another one beside it, its mirror image, a later start.
#include <algorithm>
#include <array>

#include "neutral/edits.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/motion.hpp"
#include "slapstick/mode/contact_states.hpp"

namespace slapstick::neutral {
namespace {

/// Every matrix with rows and columns more.
void widen(Definition& file, std::size_t before, std::size_t after, bool copied) {
  for (auto& [key, matrix] : file.matrices) {
    std::vector<Scalar> entries(after * after, number(0));
    for (std::size_t i = 0; i < before; ++i)
      for (std::size_t j = 0; j < before; ++j) {
        entries[i * after + j] = matrix.entries[i * before + j];
        if (copied) entries[(i + before) * after + j + before] = matrix.entries[i * before + j];
      }
    matrix.entries = std::move(entries);
  }
}

void negate(Scalar& scalar) {
  if (scalar.expression || scalar.number != 0.0) multiply(scalar, -1.0);
}

/// Is nothing at rest in the mode, so that a start there is in the same mode?
bool all_moves(const System& system, ModeId id) {
  const auto states = system.states(id);
  return std::ranges::none_of(states.stops, [](auto s) { return s == mode::StopState::closed; }) &&
         std::ranges::none_of(states.frictions, [](auto s) { return s == mode::FrictionState::stick; }) &&
         std::ranges::none_of(states.compliant, [](auto s) { return s == mode::CompliantState::detached; });
}

/// Phase of a harmonic, or of a tone, `later` time units on.
void advance_phase(Definition& file, Part& term, double omega, double later) {
  Scalar* const tone = field(term, "frequency");
  const Scalar* const harmonic = field(term, "harmonic");
  const double order = harmonic == nullptr ? 1.0 : value(file, *harmonic);
  if (tone == nullptr && order == 0.0) return;
  if (field(term, "phase") == nullptr) term.fields["phase"] = number(0);
  add(*field(term, "phase"), tone != nullptr ? value(file, *tone) * later : omega * order * later);
}

}  // namespace

std::optional<Edited> machine_at_rest(const Definition& file, campaign::Random& random) {
  Edited edited{file, {}};
  Definition& after = edited.file;
  Part body, spring, damper;
  body.name = "other";
  body.fields = {{"mass", number(random.decades(-0.5, 0.5))}};
  spring.a = damper.a = coordinates(file);
  spring.fields = {{"stiffness", number(random.decades(-0.5, 0.5))}};
  damper.fields = {{"coefficient", number(random.uniform(0.2, 0.6))}};
  parts(after, "coordinate").push_back(body);
  parts(after, "spring").push_back(spring);
  parts(after, "damper").push_back(damper);
  widen(after, static_cast<std::size_t>(coordinates(file)), static_cast<std::size_t>(coordinates(after)), false);
  edited.rule.more_directions = 2;
  return edited;
}

std::optional<Edited> twin_machine(const Definition& file, campaign::Random&) {
  const std::string twin = "_twin";
  Edited edited{file, {}};
  edited.rule.twin = twin;
  Definition& after = edited.file;
  const int n = coordinates(file);
  for (const char* kind : {"coordinate", "spring", "damper", "maxwell", "jenkins", "force", "impulse", "friction",
                           "freewheel", "stop", "compliant_stop"})
    for (Part part : file.of(kind)) {
      const bool body = std::string(kind) == "coordinate";
      for (int* end : {&part.a, &part.b})
        if (!body && *end >= 0) *end += n;
      if (!part.name.empty()) part.name += twin;
      if (const auto name = part.texts.find("name"); name != part.texts.end()) name->second += twin;
      if (!part.load_stop.empty()) part.load_stop += twin;
      if (!part.presses.empty()) part.presses += twin;
      for (auto& [name, scalar] : part.load)
        if (name != "constant") name += twin;
      parts(after, kind).push_back(part);
    }
  widen(after, static_cast<std::size_t>(n), 2 * static_cast<std::size_t>(n), true);
  for (const auto& [name, scalar] : file.start) after.start.emplace_back(name + twin, scalar);
  return edited;
}

/// Twins move alike, so that the springs have no force until one moves beside the other. The multipliers of one machine
/// are those of moving alike, and there are as many others.
std::optional<Edited> joined_twin(const Definition& file, campaign::Random& random) {
  std::optional<Edited> edited = twin_machine(file, random);
  edited->rule.joined = true;
  edited->rule.more_directions = coordinates(file);     // of twins that are free only one translation is left
  const double stiffness = random.decades(-3.0, -2.0);  // such a spring hardly makes a stable motion unstable
  for (int i = 0; i < coordinates(file); ++i) {
    Part spring;
    spring.a = i, spring.b = coordinates(file) + i;
    spring.fields = {{"stiffness", number(stiffness)}};
    parts(edited->file, "spring").push_back(spring);
  }
  return edited;
}

/// x -> -x: every pair has its ends exchanged, so that its displacement and its forces are what they were.
std::optional<Edited> mirror(const Definition& file, campaign::Random&) {
  Edited edited{file, {}};
  edited.rule.mirrored = true;
  each_linked(edited.file, [&](Part& part) {
    std::swap(part.a, part.b);
    if (part.ratio) std::swap(part.ratio->a, part.ratio->b);
  });
  for (Part& force : parts(edited.file, "force"))  // a signal is mirrored itself, and what presses stays
    if (force.presses.empty() != force.texts.contains("signal")) negate(*field(force, "amplitude"));
  for (Part& impulse : parts(edited.file, "impulse")) negate(*field(impulse, "momentum"));
  for (Part& base : parts(edited.file, "base"))
    for (Part& harmonic : base.harmonics) negate(*field(harmonic, "amplitude"));
  for (Part& signal : parts(edited.file, "signal"))
    for (Point& point : signal.points) negate(point.force);
  for (Part& contact : parts(edited.file, "friction"))
    for (auto& [name, scalar] : contact.load)
      if (name != "constant") negate(scalar);
  for (auto& [name, scalar] : edited.file.start) negate(scalar);
  return edited;
}

/// x_j = s y: the mass is s^2 m, forces on y and what is linear in x_j are s times those of x_j, and links have ratios.
std::optional<Edited> lever(const Definition& file, campaign::Random& random) {
  const int j = random.below(coordinates(file));
  constexpr std::array ratios{2.0, -0.5, 3.0, -1.7};
  const double s = ratios[static_cast<std::size_t>(random.below(static_cast<int>(ratios.size())))];
  Edited edited{file, {}};
  const std::string name = file.of("coordinate")[static_cast<std::size_t>(j)].name;
  bool still = file.matrices.empty() && home(file, j) == ground;
  each_linked(edited.file, [&](Part& part) {
    if (part.a != j && part.b != j) return;
    for (const int end : {part.a, part.b})
      still = still && !is_base(end) && (end == ground || home(file, end) == ground);
    Ratio ratio = part.ratio.value_or(Ratio{});
    if (part.a == j) ratio.a *= s;
    if (part.b == j) ratio.b *= s;
    part.ratio = ratio;
  });
  if (!still) return std::nullopt;  // a ratio is between coordinates that stand still with the ground
  edited.rule.scaled = name;
  edited.rule.by = 1.0 / s;
  multiply(*field(parts(edited.file, "coordinate")[static_cast<std::size_t>(j)], "mass"), s * s);
  for (const char* kind : {"force", "impulse"})
    for (Part& load : parts(edited.file, kind)) {
      if (load.a != j) continue;
      for (const char* size : {"amplitude", "momentum"})
        if (Scalar* number = field(load, size)) multiply(*number, s);
      if (const auto rms = load.band.find("rms"); rms != load.band.end()) multiply(rms->second, std::abs(s));
      if (!load.band.empty() && s < 0.0) return std::nullopt;  // a band has no sign
    }
  for (Part& contact : parts(edited.file, "friction"))
    for (auto& [of, scalar] : contact.load)
      if (of == name || of == velocity_name(name)) multiply(scalar, s);
  for (auto& [of, scalar] : edited.file.start)
    if (of == name || of == velocity_name(name)) multiply(scalar, 1.0 / s);
  return edited;
}

std::optional<Edited> later_clock(const Definition& file, campaign::Random& random) {
  for (const Part& signal : file.of("signal"))
    if (signal.flag("repeats")) return std::nullopt;
  const auto once = [](const Part& impulse) {
    return impulse.fields.contains("time") && !impulse.fields.contains("period");
  };
  if (std::ranges::any_of(file.of("impulse"), once)) return std::nullopt;  // the impulse may be past then
  Edited edited{file, {}};
  const ModelDefinition definition = read(file);
  const System system(definition.build());
  edited.rule.steps = 1 + random.below(3);
  const double later = edited.rule.steps * sample_grid(system.model());
  Motion motion(system, definition.start(), {}, {.most_events_per_period = 20'000});
  try {
    while (motion.advance(Instant{}.plus(later / system.period())) == Outcome::event) {
    }
  } catch (const NumericalError&) {
    return std::nullopt;
  }
  if (!all_moves(system, motion.mode_id())) return std::nullopt;
  const double omega = system.model().omega;
  for (Part& impulse : parts(edited.file, "impulse")) {
    if (Scalar* phase = field(impulse, "phase")) add(*phase, -omega * later);
    if (Scalar* time = field(impulse, "time")) add(*time, -later);
  }
  for (Part& force : parts(edited.file, "force"))
    if (!force.texts.contains("signal")) advance_phase(edited.file, force, omega, later);
  for (Part& base : parts(edited.file, "base"))
    for (Part& harmonic : base.harmonics) advance_phase(edited.file, harmonic, omega, later);
  for (Part& signal : parts(edited.file, "signal"))
    for (Point& point : signal.points) add(point.at, -later);
  const auto names = state_names(system.model());
  const State state = motion.state();
  edited.file.start.clear();
  for (std::size_t i = 0; i < names.size(); ++i)
    if (i % 2 == 0 || !system.model().is_inner(static_cast<int>(i / 2)))
      edited.file.start.emplace_back(names[i], number(state[i]));
  return edited;
}

}  // namespace slapstick::neutral
