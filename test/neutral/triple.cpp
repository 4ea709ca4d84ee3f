#include "neutral/triple.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::neutral {
namespace {

/// Of a number of a trajectory, relative to the largest of its dimension: some hundred roundings, before growth.
constexpr double own_rounding = 0x1p-44;
/// Of the farthest stop's clearance: some roundings of it.
constexpr double far_rounding = 0x1p-49;
/// Of each limit of a chatter, from then on: its last impacts are replaced by their sum.
constexpr double after_chatter = 1e-7;
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
  const auto& rows = first.answer(Verb::simulate).rows;
  const auto differs = [&](double tolerance) {
    return difference(first.answer(verb), answer, second.rule, first.question().grid, tolerance);
  };
  const double rounding = std::max(own_rounding, far_rounding * second.rule.farthest);
  auto found = differs(second.rule.bits ? 0.0 : 64 * rounding);
  if (!found) return {};
  if (second.rule.bits) return {Verdict::different, found->what};
  try {
    // What differs more than rounding has grown to by then is looked at again if it comes later: rounding grows on.
    for (double seen = -1.0; found->time > seen;) {
      seen = found->time;
      const double grown = rounding * growth(first.definition(), seen);
      if (grown > horizon) {
        if (verb == Verb::measure) return {Verdict::excluded, "beyond the horizon"};
        const bool early = seen < 0.25 * first.question().grid * first.question().steps;
        return early ? Judgement{Verdict::excused, "rounding grows beyond the horizon early"} : Judgement{};
      }
      const auto limits = std::ranges::count_if(
          rows, [&](const Row& row) { return row.kind == EventKind::chatter && row.time <= seen; });
      found = differs(std::max({64 * rounding, 16 * grown, after_chatter * static_cast<double>(limits)}));
      if (!found) return {};
    }
  } catch (const NumericalError&) {
  }
  for (const Answer& beside : first.beside(verb)) {
    const auto noise = difference(first.answer(verb), beside, {}, first.question().grid, 1e-7);
    if (noise && noise->time <= found->time * (1.0 + 1e-6))
      return {Verdict::excused, "an event within noise: " + noise->what};
  }
  return {Verdict::different, found->what};
}

bool chaotic(const Answer& answer) {
  const auto word = answer.words.find("attractor");
  return word != answer.words.end() && word->second == name(Attractor::chaotic);
}

/// Does the motion settle at another time from starts 1e-9 away? A decay of its own would come within few periods.
/// A chaotic transient ends by chance, perhaps after all periods that are asked for.
bool ends_by_chance(Asked& first, Verb verb) {
  constexpr long few = 8;
  return std::ranges::any_of(first.beside(verb), [&](const Answer& beside) {
    return std::abs(beside.periods_used - first.answer(verb).periods_used) > few;
  });
}

Judgement judge_attractor(Asked& first, const Answer& answer, const Edited& second, Verb verb) {
  // Eigenvalues are found to rounding in any units.
  const bool bits = second.rule.bits && second.rule.length == 1.0 && second.rule.time == 1.0 && second.rule.mass == 1.0;
  const auto found =
      difference(first.answer(verb), answer, second.rule, first.question().grid, bits ? 0.0 : of_attractors);
  if (!found) return {};
  if (bits) return {Verdict::different, found->what};
  for (const Answer* one : {&first.answer(verb), &answer})
    if (const auto word = one->words.find("attractor");
        word != one->words.end() && word->second == name(Attractor::undecided))
      return {Verdict::excused, "undecided"};
  if (chaotic(first.answer(verb)) != chaotic(answer) && ends_by_chance(first, verb))
    return {Verdict::excused, "a chaotic transient"};
  for (const Answer& beside : first.beside(verb))
    if (const auto noise = difference(first.answer(verb), beside, {}, first.question().grid, of_attractors))
      return {Verdict::excused, "a start 1e-9 away: " + noise->what};
  return {Verdict::different, found->what};
}

/// What the answers of the first file say about the question.
std::string excluded(Asked& first, const Edited& second, Verb verb) {
  if (of_trajectory(verb) || verb == Verb::modes) return "";
  constexpr std::size_t many = 150;
  if (first.answer(Verb::simulate).rows.size() > many)
    return "more than 150 events in five periods: a search of minutes";
  const auto word = first.answer(Verb::classify).words.find("attractor");
  const bool undecided = word != first.answer(Verb::classify).words.end() && word->second == name(Attractor::undecided);
  if (verb != Verb::classify && undecided) return "undecided: a search of minutes for an orbit";
  const auto free = [&](Verb of) {  // a branch does not tell
    return std::ranges::any_of(first.answer(of).numbers, [](const Number& n) {
      return n.what == "drift" || (n.what == "family" && n.value > 0.0);
    });
  };
  if (second.rule.farthest > 1.0 && (free(verb) || free(Verb::classify)))
    return "a free group is held by a stop, however far it is";
  return "";
}

}  // namespace

const char* name(Verdict verdict) {
  constexpr const char* names[] = {"agreed", "excluded", "excused", "waiting", "different"};
  return names[static_cast<std::size_t>(verdict)];
}

Asked::Asked(const Definition& file)
    : file_(file), definition_(read(file)), question_{sample_grid(definition_.build())} {}

const Answer& Asked::answer(Verb verb) {
  const auto found = answers_.find(verb);
  return found != answers_.end() ? found->second
                                 : answers_.emplace(verb, ask(verb, definition_, question_)).first->second;
}

const std::vector<Answer>& Asked::beside(Verb verb) {
  const auto found = beside_.find(verb);
  if (found != beside_.end()) return found->second;
  std::vector<Answer> answers;
  for (const std::uint64_t direction : {1u, 2u})
    if (const auto there = moved(file_, of_trajectory(verb) ? 1e-11 : 1e-9, direction))
      answers.push_back(ask(verb, *there, question_));
  return beside_.emplace(verb, std::move(answers)).first->second;
}

Judgement judge(Asked& first, const Edit& edit, const Edited& second, Verb verb) {
  if (const std::string why = excluded(first.file(), edit, verb); !why.empty()) return {Verdict::excluded, why};
  if (const std::string why = excluded(first, second, verb); !why.empty()) return {Verdict::excluded, why};
  Question question = first.question();
  question.grid *= second.rule.time;
  Answer answer;
  try {
    answer = ask(verb, read(second.file), question);
  } catch (const InputError& error) {
    return {Verdict::different, std::string("the second file is refused: ") + error.what()};
  }
  Judgement outcome = of_trajectory(verb) ? judge_trajectory(first, answer, second, verb)
                                          : judge_attractor(first, answer, second, verb);
  if (outcome.verdict != Verdict::different) return outcome;
  if (const std::string fault = waiting_for(first.file(), edit, verb, outcome.why); !fault.empty())
    return {Verdict::waiting, fault + ": " + outcome.why};
  return outcome;
}

std::string both_commands(const Definition& first, const Edit& edit, Verb verb, std::uint64_t seed) {
  campaign::Random random(seed, 0);
  const auto second = edit.apply(first, random);
  Question question = Asked(first).question();
  std::string out =
      "cat > first.toml <<'END'\n" + text(first) + "END\n" + command(verb, read(first), "first.toml", question) + "\n";
  if (!second) return out;
  question.grid *= second->rule.time;
  return out + "cat > second.toml <<'END'\n" + text(second->file) + "END\n" +
         command(verb, read(second->file), "second.toml", question) + "\n";
}

}  // namespace slapstick::neutral
