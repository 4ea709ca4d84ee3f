/// Prints branches as a table, with the branches that are born on them.
#include "branch_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/ranges.hpp"
#include "base/text.hpp"
#include "slapstick/continuation/sentences.hpp"

namespace slapstick::app {
namespace {

/// @param at_circle  a largest multiplier so near the unit circle says nothing
std::string row(std::size_t branch, std::size_t point, std::string_view type, double value,
                const orbit::Solution& solution, const std::string& what, double at_circle = 1e-6) {
  const double largest = solution.largest_across();
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%3zu %5zu  %-2s  %18.12g  %-10s %12.6g %12.6g  %-8s  ", branch, point,
                std::string(type).c_str(), value, solution.label.c_str(), solution.cycle, largest,
                std::abs(largest - 1.0) < at_circle ? ""
                : largest < 1.0                     ? "stable"
                                                    : "unstable");
  return text.data() + what + "\n";
}

/// How well the critical multiplier of a point is known: at a fold, where states are, to the root of the parameter's
/// error.
double critical_tolerance(orbit::SpecialType type) {
  using enum orbit::SpecialType;
  return type == LP || type == PD || type == NS || type == BP ? 2e-3 : 1e-6;
}

std::string short_number(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.5g", value);
  return text.data();
}

/// As docs/explanation/continuation.md calls it.
std::string coefficient_name(orbit::SpecialType type) {
  return type == orbit::SpecialType::LP ? "a" : type == orbit::SpecialType::PD ? "c" : "l1";
}

/// What a special point is, in words.
std::string words(const orbit::Branch& branch, const orbit::SpecialPoint& special, const Followed& in,
                  const std::vector<std::size_t>& images) {
  std::string what = orbit::what_happens(special, *in.system) + image_words(images);
  if (special.type == orbit::SpecialType::NS) what += ", rotation " + short_number(special.rotation);
  const orbit::NormalForm& form = special.normal_form;
  if (const std::string verdict = orbit::sentence(form); !verdict.empty()) what += ", " + verdict;
  if (form.coefficient) what += ", " + coefficient_name(special.type) + " = " + short_number(*form.coefficient);
  if (const auto classes = orbit::classes_around(branch, special))
    what += "; " + classes->first + " -> " + classes->second;
  if (const std::string outcome = orbit::what_becomes(special); !outcome.empty()) what += "; " + outcome;
  constexpr double digits = 1e-10, share = 1e-6;  // of its value, and of the range
  if (!(special.error <= std::min(digits * std::abs(special.value), share * (in.range.to - in.range.from))))
    what += "; known to " + short_number(special.error);
  return what;
}

/// "; d omega / d friction = -0.31"
std::string rates(const Sensitivities& of, std::size_t special, const std::string& parameter) {
  std::string text;
  for (std::size_t j = 0; j < of.names.size(); ++j) {
    const orbit::Sensitivity& rate = of.rates[special][j];
    text += "; d " + parameter + " / d " + of.names[j] +
            (std::isfinite(rate.value) ? " = " + short_number(rate.value) : " is not known");
    if (rate.known == orbit::Known::from_one_side) text += " (from one side)";
  }
  return text;
}

std::string head(const std::string& parameter) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%3s %5s  %-2s  %18.60s  %-10s %12s %12s\n", "BR", "PT", "TY",
                parameter.c_str(), "class", "period", "max |mu|");
  return text.data();
}

/// "  2 is born at omega = 2.84595629561 (PD of 1)", in the column BR
std::string birth_line(std::size_t branch, const Birth& birth, const std::string& parameter) {
  std::array<char, 40> number{}, value{};
  std::snprintf(number.data(), number.size(), "%3zu", branch + 1);
  std::snprintf(value.data(), value.size(), "%.12g", birth.value);
  return std::string(number.data()) + " is born at " + parameter + " = " + value.data() + " (" +
         std::string(name(birth.type)) + " of " + std::to_string(birth.branch + 1) + ")\n";
}

}  // namespace

bool begins_at(const orbit::Branch& branch, const orbit::SpecialPoint& special) {
  if (special.after != 0 || branch.points.size() < 2) return false;
  const double first = branch.points[0].orbit.parameter();
  double next = branch.points[1].orbit.parameter();
  for (const orbit::SpecialPoint& change : branch.special)  // where it may turn back
    if (change.after == 0 && orbit::goes_on(branch, change)) next = change.value;
  return (special.value - first) * (next - first) < 0.0;
}

std::string image_words(const std::vector<std::size_t>& branches) {
  std::string text;
  for (const std::size_t branch : branches) text += ", the image of branch " + std::to_string(branch + 1) + " is born";
  return text;
}

namespace {

/// Special points that a row of their cascade stands for, and what that row says.
struct Summary {
  std::vector<bool> hidden;
  std::vector<std::string> words;
};

Summary summary(const orbit::Branch& branch, bool all_changes) {
  Summary rows{std::vector<bool>(branch.special.size(), false), std::vector<std::string>(branch.special.size())};
  if (all_changes) return rows;
  for (const orbit::Cascade& cascade : orbit::cascades(branch)) {
    std::fill(rows.hidden.begin() + static_cast<std::ptrdiff_t>(cascade.first),
              rows.hidden.begin() + static_cast<std::ptrdiff_t>(cascade.last) + 1, true);
    const std::size_t far = cascade.first > cascade.onset ? cascade.last : cascade.first;
    rows.words[cascade.onset] += "; a cascade of " + std::to_string(cascade.changes) + " changes " +
                                 (far > cascade.onset ? "to " : "from ") + short_number(branch.special[far].value) +
                                 " (--all-changes)";
  }
  return rows;
}

}  // namespace

std::string branch_table(const std::vector<orbit::Branch>& branches, const Followed& in,
                         const std::vector<Sensitivities>& sensitivities, const Lineage& lineage) {
  std::string text = head(in.parameter);
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const orbit::Branch& branch = branches[b];
    if (lineage.births[b]) text += birth_line(b, *lineage.births[b], in.parameter);
    const Summary cascades = summary(branch, in.all_changes);
    auto special = branch.special.begin();
    const auto add_special = [&](std::size_t point) {
      const auto place = static_cast<std::size_t>(special - branch.special.begin());
      if (!cascades.hidden[place])
        text += row(b + 1, point + 1, name(special->type), special->value, special->solution,
                    words(branch, *special, in, lineage.images[b][place]) + cascades.words[place] +
                        rates(sensitivities[b], place, in.parameter),
                    critical_tolerance(special->type));
      ++special;
    };
    while (special != branch.special.end() && begins_at(branch, *special)) add_special(0);
    for (std::size_t i = 0; i < branch.points.size(); ++i) {
      const orbit::Solution& point = branch.points[i];
      if (i == 0 || i + 1 == branch.points.size())
        text += row(b + 1, i + 1, "EP", point.orbit.parameter(), point,
                    point.is_motion ? "" : "not a motion: " + point.why);
      while (special != branch.special.end() && special->after == i) add_special(i);
    }
    text += "    " + std::to_string(branch.points.size()) + " points; " + orbit::sentence(branch) + "\n";
  }
  return text;
}

Lineage follow_born(const orbit::Problem& problem, std::vector<orbit::Branch>& branches, std::size_t most,
                    const orbit::ContinuationOptions& how) {
  Lineage lineage{std::vector<std::optional<Birth>>(branches.size()), {}};
  for (std::size_t b = 0; b < branches.size(); ++b) {
    lineage.images.emplace_back(branches[b].special.size());
    for (std::size_t k = 0; k < branches[b].special.size(); ++k) {
      const Birth here{b, branches[b].special[k].type, branches[b].special[k].value};
      const std::vector<orbit::Orbit> born = branches[b].special[k].born;
      for (const orbit::Orbit& start : born)
        if (branches.size() < most && orbit::follow_born(problem, branches, start, how, lineage.images[b][k]))
          lineage.births.emplace_back(here);
    }
  }
  return lineage;
}

}  // namespace slapstick::app
