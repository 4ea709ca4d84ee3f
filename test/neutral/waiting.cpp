/// What the table leaves out, and the faults that are known: who mends one deletes its entry here.
#include <algorithm>

#include "neutral/laws.hpp"

namespace slapstick::neutral {
namespace {

bool without_drive(const Definition& file) { return !has_harmonics(file); }
bool aperiodic(const Definition& file) {
  return !file.of("signal").empty() || std::ranges::any_of(file.of("force"), [](const Part& p) { return p.fields.contains("frequency"); });
}
template <class Thing>
bool among(const std::vector<Thing>& all, const Thing& one) {
  return std::ranges::find(all, one) != all.end();
}

struct Exclusion {
  std::vector<std::string> edits;
  std::vector<Verb> verbs;
  bool (*holds)(const Definition&);
  const char* reason;
};

const std::vector<Verb> settled{Verb::classify, Verb::orbit, Verb::branch, Verb::curve};

const std::vector<Exclusion>& exclusions() {
  static const std::vector<Exclusion> all = {
      {{"clock"}, {Verb::measure}, [](const Definition&) { return true; }, "statistics of another stretch of time"},
      {{"twin"}, settled, without_drive, "two free cycles have phases of their own: one of a family"},
  };
  return all;
}

const std::vector<Exclusion>& faults() {
  static const std::vector<Exclusion> all = {
      {{"zero-tone", "zero-signal"}, settled, [](const Definition& file) { return !aperiodic(file); },
       "a drive that does nothing is taken for a drive"},
      {{"zero-force"}, settled, without_drive, "a drive that does nothing is taken for a drive"},
      {{"far-stop", "far-pad", "far-compliant-stop"}, {Verb::simulate, Verb::measure}, [](const Definition&) { return true; },
       "a contact that is never reached takes digits (far-stop-first)"},
  };
  return all;
}

std::string first_of(const std::vector<Exclusion>& list, const Definition& file, const Edit& edit, Verb verb) {
  for (const Exclusion& one : list)
    if (among(one.verbs, verb) && among(one.edits, std::string(edit.name)) && one.holds(file)) return one.reason;
  return "";
}

}  // namespace

std::string excluded(const Definition& file, const Edit& edit, Verb verb) { return first_of(exclusions(), file, edit, verb); }

std::string waiting_for(const Definition& first, const Edit& edit, Verb verb) { return first_of(faults(), first, edit, verb); }

std::string waiting_for(const Definition& file, const Law& law) {
  if (std::string(law.name) == "columns-integrate" && aperiodic(file)) return "columns under tones and signals are memory that nobody wrote (columns)";
  return "";
}

}  // namespace slapstick::neutral
