#pragma once
/// What a verb answers of a model file, as words, rows of events and numbers that know which part they are of.
#include <complex>
#include <map>
#include <string>
#include <vector>

#include "neutral/file.hpp"
#include "slapstick/flow/motion.hpp"
#include "slapstick/flow/natural_modes.hpp"
#include "slapstick/model/quantity.hpp"

namespace slapstick::neutral {

struct Number {
  std::string what, of;  ///< "mean F", "wall"; of the model as a whole: ""
  double value = 0.0;
  Dimension dimension;
  bool odd = false;           ///< changes its sign with the coordinates
  int sample = -1;            ///< at which instant, or -1
  double until = 0.0;         ///< the motion's time that it depends on; of an attractor 0
  bool undetermined = false;  ///< contacts on one pair hold together, and only the sum of their forces is determined
};

struct Row {
  /// Of a stop that closes: chatter, whether a limit or an impact without rebound came before.
  EventKind kind = EventKind::impact;
  std::string contact;
  double time = 0.0, w = 0.0;
  bool held = false;  ///< a stop lets go while friction holds its pair, or with it: which is told first is rounding
};

struct Answer {
  std::string failure, message;  ///< "refused" or "failed", and why
  std::map<std::string, std::string> words;
  std::vector<Number> numbers;
  std::vector<Row> rows;
  std::vector<std::complex<double>> multipliers, eigenvalues;
  long periods_used = 0;  ///< of `classify`: until it knew
};

/// The name of a coordinate, and whether its sign turns in a mirror.
/// Of an inner one the name of its element, which a file gives; its stretch is the same in a mirror.
struct Named {
  std::string name;
  bool odd;
};
[[nodiscard]] Named named(const Model& model, std::size_t coordinate);

enum class Verb { simulate, measure, classify, modes, orbit, branch, curve };
[[nodiscard]] const char* name(Verb verb);
[[nodiscard]] Dimension dimension(Quantity::Kind kind);
/// Is it a part of a sum that alone is determined (docs/reference/measure.md)? Contacts on one pair hold it together.
[[nodiscard]] bool undetermined(const Model& model, const Quantity& quantity);
/// How many parameters a file must have for the verb.
[[nodiscard]] std::size_t parameters_of(Verb verb);
/// Does the verb answer about the motion from the start on? The others are about where it settles.
[[nodiscard]] bool of_trajectory(Verb verb);

/// @param grid  samples are at multiples of it, in time units; the motion is looked at for `steps` of these
struct Question {
  double grid = 1.0;
  int steps = 20;
};
/// As the verb of the program asks the library; what that throws is the answer's `failure`.
[[nodiscard]] Answer ask(Verb verb, const ModelDefinition& definition, const Question& question);
/// The command that asks the same of a file.
[[nodiscard]] std::string command(Verb verb, const ModelDefinition& definition, const std::string& file,
                                  const Question& question);

/// lambda and, where it oscillates, its conjugate.
[[nodiscard]] std::vector<std::complex<double>> eigenvalues(const NaturalMode& mode);

/// The largest factor by which a small change of the start has grown until a time.
[[nodiscard]] double growth(const ModelDefinition& definition, double until);

}  // namespace slapstick::neutral
