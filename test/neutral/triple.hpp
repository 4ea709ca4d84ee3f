#pragma once
/// One triple of a file, an edit and a verb: do the answers agree?
#include <string>

#include "neutral/difference.hpp"

namespace slapstick::neutral {

enum class Verdict {
  agreed,
  excluded,  ///< by the table: the verb does not answer both files alike, for a reason that stands in campaigns.md
  excused,   ///< by a rule about the first file: its answer hangs on less than rounding
  waiting,   ///< for a known fault (waiting.cpp)
  different
};
[[nodiscard]] const char* name(Verdict verdict);

struct Judgement {
  Verdict verdict = Verdict::agreed;
  std::string why;
};

/// A file with its answers, which are asked for once.
class Asked {
 public:
  explicit Asked(const Definition& file);
  [[nodiscard]] const Definition& file() const { return file_; }
  [[nodiscard]] const ModelDefinition& definition() const { return definition_; }
  [[nodiscard]] const Question& question() const { return question_; }
  const Answer& answer(Verb verb);
  /// Those of two starts that differ from the file's by 1e-9 of each number (of a trajectory by 1e-11).
  const std::vector<Answer>& beside(Verb verb);

 private:
  Definition file_;
  ModelDefinition definition_;
  Question question_;
  std::map<Verb, Answer> answers_;
  std::map<Verb, std::vector<Answer>> beside_;
};

[[nodiscard]] Judgement judge(Asked& first, const Edit& edit, const Edited& second, Verb verb);

/// What the table of campaigns.md leaves out, and why; "" where nothing.
[[nodiscard]] std::string excluded(const Definition& file, const Edit& edit, Verb verb);
/// The known fault that a difference is put down to, by name; "" if there is no such fault.
/// @param said  the difference in words
[[nodiscard]] std::string waiting_for(const Definition& first, const Edit& edit, Verb verb, const std::string& said);

/// Files that are simpler by one step, all of them sound.
[[nodiscard]] std::vector<Definition> simpler(const Definition& file);
/// The smallest file found for which the triple is still different, with the edit's own random numbers of `seed`, and
/// in the same respect as `why` says: another difference may be another fault, or none.
[[nodiscard]] Definition smallest(const Definition& file, const Edit& edit, Verb verb, std::uint64_t seed,
                                  const std::string& why, int most_tries);

/// Both files and both commands, as a shell runs them.
[[nodiscard]] std::string both_commands(const Definition& first, const Edit& edit, Verb verb, std::uint64_t seed);

}  // namespace slapstick::neutral
