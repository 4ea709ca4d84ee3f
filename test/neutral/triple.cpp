#include "neutral/triple.hpp"

#include <cmath>

#include "base/text.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::neutral {
namespace {

/// Of a number of a trajectory, relative to the largest of its dimension: some hundred roundings, before growth.
constexpr double rounding = 0x1p-44;
/// Where rounding has grown to this, a trajectory is compared no further.
constexpr double horizon = 1e-6;
/// Newton's method closes cycles to 1e-10 of their size, and multipliers that meet lose half of their digits.
constexpr double of_attractors = 1e-5;

/// The start with every number changed by a part of itself, in a direction of its own; nothing where a stop forbids it.
std::optional<ModelDefinition> moved(const Definition& file, double part, std::uint64_t direction) {
  Definition other = file;
  other.start = whole_start(file);
  campaign::Random random(direction, 17);
  for (auto& [name, scalar] : other.start) scalar = number(value(file, scalar) * (1.0 + part * random.sign()));
  try {
    ModelDefinition definition = read(other);
    (void)definition.start();
    return definition;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

Judgement judge_trajectory(Asked& first, const Answer& answer, const Edited& second, Verb verb) {
  const auto differs = [&](double tolerance) { return difference(first.answer(verb), answer, second.rule, first.question().grid, tolerance); };
  auto found = differs(second.rule.bits ? 0.0 : 64 * rounding);
  if (!found) return {};
  if (second.rule.bits) return {Verdict::different, found->what};
  try {
    const double grown = rounding * growth(first.definition(), found->time);
    if (grown > horizon) {
      const bool early = verb == Verb::simulate && found->time < 0.25 * first.question().grid * first.question().steps;
      return early ? Judgement{Verdict::excused, "rounding grows beyond the horizon early"} : Judgement{};
    }
    found = differs(std::max(64 * rounding, 16 * grown));
    if (!found) return {};
  } catch (const NumericalError&) {
  }
  for (const Answer& beside : first.beside(verb)) {
    const auto noise = difference(first.answer(verb), beside, {}, first.question().grid, 1e-7);
    if (noise && noise->time <= found->time * (1.0 + 1e-6)) return {Verdict::excused, "an event within noise: " + noise->what};
  }
  return {Verdict::different, found->what};
}

Judgement judge_attractor(Asked& first, const Answer& answer, const Edited& second, Verb verb) {
  const auto found = difference(first.answer(verb), answer, second.rule, first.question().grid, second.rule.bits ? 0.0 : of_attractors);
  if (!found) return {};
  if (second.rule.bits) return {Verdict::different, found->what};
  for (const Answer& beside : first.beside(verb))
    if (const auto noise = difference(first.answer(verb), beside, {}, first.question().grid, of_attractors))
      return {Verdict::excused, "a start 1e-9 away: " + noise->what};
  return {Verdict::different, found->what};
}

}  // namespace

const char* name(Verdict verdict) {
  constexpr const char* names[] = {"agreed", "excluded", "excused", "waiting", "different"};
  return names[static_cast<std::size_t>(verdict)];
}

Asked::Asked(const Definition& file) : file_(file), definition_(read(file)), question_{sample_grid(definition_.build())} {}

const Answer& Asked::answer(Verb verb) {
  const auto found = answers_.find(verb);
  return found != answers_.end() ? found->second : answers_.emplace(verb, ask(verb, definition_, question_)).first->second;
}

const std::vector<Answer>& Asked::beside(Verb verb) {
  const auto found = beside_.find(verb);
  if (found != beside_.end()) return found->second;
  std::vector<Answer> answers;
  for (const std::uint64_t direction : {1u, 2u})
    if (const auto there = moved(file_, of_trajectory(verb) ? 1e-11 : 1e-9, direction)) answers.push_back(ask(verb, *there, question_));
  return beside_.emplace(verb, std::move(answers)).first->second;
}

Judgement judge(Asked& first, const Edit& edit, const Edited& second, Verb verb) {
  if (const std::string why = excluded(first.file(), edit, verb); !why.empty()) return {Verdict::excluded, why};
  Question question = first.question();
  question.grid *= second.rule.time;
  Answer answer;
  try {
    answer = ask(verb, read(second.file), question);
  } catch (const InputError& error) {
    return {Verdict::different, std::string("the second file is refused: ") + error.what()};
  }
  Judgement outcome = of_trajectory(verb) ? judge_trajectory(first, answer, second, verb) : judge_attractor(first, answer, second, verb);
  if (outcome.verdict != Verdict::different) return outcome;
  if (const std::string fault = waiting_for(first.file(), edit, verb); !fault.empty()) return {Verdict::waiting, fault + ": " + outcome.why};
  return outcome;
}

std::string both_commands(const Definition& first, const Edit& edit, Verb verb, std::uint64_t seed) {
  campaign::Random random(seed, 0);
  const auto second = edit.apply(first, random);
  Question question = Asked(first).question();
  std::string out = "cat > first.toml <<'END'\n" + text(first) + "END\n" + command(verb, read(first), "first.toml", question) + "\n";
  if (!second) return out;
  question.grid *= second->rule.time;
  return out + "cat > second.toml <<'END'\n" + text(second->file) + "END\n" + command(verb, read(second->file), "second.toml", question) + "\n";
}

}  // namespace slapstick::neutral
