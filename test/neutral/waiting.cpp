/// What the table leaves out, and the faults that are known: who mends one deletes its entry here.
#include <algorithm>

#include "neutral/triple.hpp"

namespace slapstick::neutral {
namespace {

bool always(const Definition&) { return true; }
bool without_drive(const Definition& file) { return !has_harmonics(file); }
/// Several friction contacts, of which one has less to slip than to stick.
bool steps_down_twice(const Definition& file) {
  const auto steps_down = [](const Part& p) {
    const auto kinetic = p.fields.find("kinetic"), fixed = p.fields.find("static");
    return kinetic == p.fields.end() || fixed == p.fields.end() || fixed->second.expression ||
           fixed->second.number != kinetic->second.number;
  };
  const auto& all = file.of("friction");
  return all.size() > 1 && std::ranges::any_of(all, steps_down);
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
  std::vector<std::string> says = {""};  ///< a difference that begins otherwise is not put down to it
};

const std::vector<Verb> all_verbs{Verb::simulate, Verb::measure, Verb::classify, Verb::modes,
                                  Verb::orbit,    Verb::branch,  Verb::curve};
const std::vector<Verb> settled{Verb::classify, Verb::orbit, Verb::branch, Verb::curve};

const std::vector<Exclusion>& exclusions() {
  static const std::vector<Exclusion> all = {
      {{"clock"}, {Verb::measure}, always, "statistics of another stretch of time"},
      {{"clock"}, {Verb::modes}, always, "the start decides which pieces of the characteristics act"},
      {{"twin", "joined-twin"}, settled, without_drive, "two free cycles have phases of their own: one of a family"},
  };
  return all;
}

const std::vector<Exclusion>& faults() {
  static const std::vector<Exclusion> all = {
      {{"order-of-contacts", "friction-as-freewheel"},
       all_verbs,
       steps_down_twice,
       "several modes fit where static friction is above kinetic, and the file's order decides"},
      {{"twin", "joined-twin"},
       {Verb::orbit, Verb::branch, Verb::curve},
       always,
       "a twin's cycle is named, and its equations are not solved",
       {"orbit: yes, no", "branch: yes, no"}},
      {{"units"},
       {Verb::branch},
       always,
       "where two events meet, the point has the name of the one or the other's margin, by rounding (issue 40)",
       {"special point 1: CO, GR", "special point 1: GR, CO", "special point 2: CO, GR", "special point 2: GR, CO"}},
      {{"far-stop", "far-pad", "far-compliant-stop", "machine-at-rest", "collinear-corner"},
       {Verb::orbit, Verb::branch, Verb::curve},
       without_drive,
       "free cycles of a family: the equations are solved or not by rounding",
       {"class: free", "orbit: yes, no", "branch: yes, no"}},
  };
  return all;
}

/// @param said  how a difference is told; "" of what is not compared at all
std::string first_of(const std::vector<Exclusion>& list, const Definition& file, const Edit& edit, Verb verb,
                     const std::string& said) {
  const auto fits = [&](const std::string& beginning) { return said.starts_with(beginning); };
  for (const Exclusion& one : list)
    if (among(one.verbs, verb) && among(one.edits, std::string(edit.name)) && one.holds(file) &&
        std::ranges::any_of(one.says, fits))
      return one.reason;
  return "";
}

}  // namespace

std::string excluded(const Definition& file, const Edit& edit, Verb verb) {
  return first_of(exclusions(), file, edit, verb, "");
}

std::string waiting_for(const Definition& first, const Edit& edit, Verb verb, const std::string& said) {
  return first_of(faults(), first, edit, verb, said);
}

}  // namespace slapstick::neutral
