/// The sentences in which results of the continuation are told.
#include "slapstick/continuation/sentences.hpp"

#include <array>
#include <cmath>

#include "base/text.hpp"
#include "change/change_kind.hpp"

namespace slapstick::orbit {
namespace {

/// " (crossing-sliding)"
std::string kind_in_brackets(Sliding sliding) {
  return sliding == Sliding::unchanged ? "" : " (" + std::string(name(sliding)) + "-sliding)";
}

/// An event whose guard falls through zero ever more slowly: beyond, it only touches zero.
std::string tangential(const Leg& leg, mode::GuardKind kind, const System& system) {
  using enum mode::GuardKind;
  const std::string contact = system.contact_name(leg.event_contact);
  switch (kind) {
    case gap:
      return "the speed of the impact at " + contact + " goes to zero";
    case engage:
      return "the speed of the engagement at " + contact + " goes to zero";
    case slip:
      return "the " + std::string(leg.event == EventKind::stick ? "stick" : "reversal") + " of " + contact +
             " becomes tangential: its velocity only touches zero";
    case stick_above:
    case stick_below:
      return "the release of " + contact + " becomes tangential: its holding force only touches static friction";
    case press:
      return "the release of " + contact + " becomes tangential: its force only touches zero";
    case let_go:
      return "the end of the push at " + contact + " becomes tangential: its force only touches zero";
    case push:
      return "the return of the push at " + contact + " becomes tangential: its force only touches zero";
    case corner_above:
    case corner_below:
    case bound:
    case beyond:
      return "the passage of a corner of " + contact + " becomes tangential";
    case load:
    case unloaded:
      return "the zero of the normal force of " + contact + " becomes tangential";
    case leave:
      break;
  }
  return "the return of " + contact + " to its gap becomes tangential";
}

/// A guard that touches zero within a leg.
std::string touching(const UsedMargin& margin, const System& system) {
  using enum mode::GuardKind;
  const std::string leg = " in leg " + std::to_string(margin.leg + 1);
  const std::string contact = system.contact_name(mode::contact_index(margin.guard, margin.contact, system.model()));
  switch (margin.guard) {
    case gap:
      return "the gap of " + contact + " touches zero" + leg;
    case slip:
      return "the velocity of " + contact + " touches zero" + leg;
    case stick_above:
    case stick_below:
      return "the holding force of " + contact + " touches static friction" + leg;
    case press:
      return "the force of " + contact + " touches zero" + leg;
    case corner_above:
    case corner_below:
    case bound:
    case beyond:
      return contact + " touches a corner" + leg;
    case load:
    case unloaded:
      return "the normal force of " + contact + " touches zero" + leg;
    default:
      return "a compliant stop touches" + leg;
  }
}

std::string shrinking(std::size_t leg) { return "leg " + std::to_string(leg + 1); }

/// Where a motion goes: "1-2-I".
std::string destination(const Jump& jump) {
  return jump.kind == Jump::Kind::settles ? jump.label
                                          : "no periodic orbit within " + std::to_string(jump.cycles) + " cycles";
}

/// "CH at 1.75: a cascade, which gathers there, .."
std::string end_at(const SpecialPoint& point) {
  const std::string place = std::string(name(point.type)) + " at " + shown(point.value) + ": ";
  switch (point.passage) {
    case Passage::merges:
      if (point.type == SpecialType::PD) return "meets the orbit of which it is the double at " + shown(point.value);
      return place + what_becomes(point);
    case Passage::symmetric:
      return "beyond the symmetric orbit at " + shown(point.value) + " are the images of this branch's";
    case Passage::retraced:
      return place + "from there on the branch runs back over itself";
    case Passage::jump:
      if (point.jump->kind == Jump::Kind::departs)
        return place + "a jump: to either side of it motions differ within a cycle, however near";
      return place + "a jump: the motion goes over to " + destination(*point.jump);
    case Passage::not_followed:
      return place + "the events change";
    case Passage::unknown:
      if (point.type != SpecialType::CH) return place + "no orbit was found beyond, a jump or a failure of the search";
      return place + (point.cascade_ratio > 0.0
                          ? "a cascade, which gathers there, and no orbit with the chatter was found beyond"
                          : "the complete chatter ends there, and no orbit with impacts was found beyond");
    default:
      return place + what_becomes(point);
  }
}

std::string infinite(bool grows) { return grows ? ", where a multiplier grows without bound" : ""; }

std::string values_of(const CurveEnd& end) { return shown(end.values[0]) + ", " + shown(end.values[1]); }

/// What may be the cause where a curve cannot be followed.
std::string likely_cause(const Curve& curve, const CurveEnd& end, const System& system) {
  if (!end.near) return infinite(end.infinite_multiplier);
  if (end.near->kind == Meeting::Kind::resonance) return ", near the resonance 1:" + std::to_string(end.near->order);
  return ", near where " + describe(end.near->margin, curve.shape, system);
}

std::string sentence(const Curve& curve, const CurveEnd& end, const System& system) {
  switch (end.kind) {
    case CurveEnd::Kind::range:
      return "range";
    case CurveEnd::Kind::most_points:
      return "points";
    case CurveEnd::Kind::stopped:
      return "stopped";
    case CurveEnd::Kind::end_of_torus:
      return "resonance 1:" + std::to_string(end.near->order) + " at " + values_of(end) +
             ": no torus beyond, both multipliers are real";
    case CurveEnd::Kind::no_step:
      break;
  }
  return "no convergence beyond " + values_of(end) + likely_cause(curve, end, system);
}

std::string sentence(const Curve& curve, const Meeting& met, const System& system) {
  switch (met.kind) {
    case Meeting::Kind::multiplier:
      return met.type == SpecialType::LP   ? "a fold of the branch: a multiplier passes +1"
             : met.type == SpecialType::PD ? "a multiplier passes -1"
                                           : "two multipliers on the unit circle";
    case Meeting::Kind::resonance:
      return "resonance 1:" + std::to_string(met.order) +
             (met.order == 1   ? ": a second multiplier passes +1"
              : met.order == 2 ? ": a second multiplier passes -1"
              : met.order == 3 ? ": the angle is a third of a turn"
                               : ": the angle is a quarter of a turn");
    case Meeting::Kind::end_of_torus:
      return "resonance 1:" + std::to_string(met.order) + ": both multipliers are " + (met.order == 2 ? "-1" : "1");
    case Meeting::Kind::turn:
      return "the curve turns back in " + curve.parameters[met.parameter];
    case Meeting::Kind::margin:
      break;
  }
  return "the events change: " + describe(met.margin, curve.shape, system);
}

}  // namespace

std::string describe(const UsedMargin& margin, const Itinerary& shape, const System& system) {
  const Leg& leg = shape.legs[margin.leg];
  switch (margin.kind) {
    case UsedMargin::Kind::duration:
      return shrinking(margin.leg) + " (" + system.mode_name(system.mode_id(leg.states)) + ") shrinks to nothing";
    case UsedMargin::Kind::no_stick:
      if (margin.guard == mode::GuardKind::press)
        return "the force that lifts " + system.contact_name(margin.contact) +
               " off at a point of a signal comes to zero";
      return "the holding force of " +
             system.contact_name(mode::contact_index(mode::GuardKind::slip, margin.contact, system.model())) +
             " comes to static friction at its reversal (" + std::string(name(leg.event)) + ")";
    case UsedMargin::Kind::speed:
      return tangential(leg, margin.guard, system);
    case UsedMargin::Kind::least:
      break;
  }
  return touching(margin, system);
}

std::string what_happens(const SpecialPoint& point, const System& system) {
  switch (point.occurrence) {
    case Occurrence::fold:
      return "fold";
    case Occurrence::doubling:
      return "period doubling";
    case Occurrence::end_of_doubled:
      return "the branch leaves a shorter orbit, which doubles";
    case Occurrence::torus:
      return "torus";
    case Occurrence::crossing:
      return "branches cross";
    case Occurrence::broken_symmetry:
      return "a symmetry breaks: the crossing branch's sides are images of one another";
    case Occurrence::release:
      return "a contact that has rested lets go, into a complete chatter";
    case Occurrence::onset:
      return "infinitely many changes gather at the onset of a complete chatter" +
             (point.cascade_ratio > 0.0
                  ? " (a cascade, ratio " + shown(std::round(1e4 * point.cascade_ratio) / 1e4) + ")"
                  : "");
    case Occurrence::death:
      return shrinking(point.margin.leg) + " and others shrink to nothing together";
    case Occurrence::margin:
      break;
  }
  return describe(point.margin, point.solution.orbit.shape, system) + kind_in_brackets(point.sliding) +
         (point.chatter_begins ? ", and a complete chatter begins" : "");
}

bool goes_on(const Branch& branch, const SpecialPoint& special) {
  if (special.after + 1 >= branch.points.size()) return false;
  if (special.passage == Passage::family)  // the branch may end in the family, or go on with what rests
    return branch.points[special.after].family != branch.points[special.after + 1].family;
  return goes_on(special.passage);
}

std::optional<std::pair<std::string, std::string>> classes_around(const Branch& branch, const SpecialPoint& special) {
  const std::string& here = branch.points[special.after].label;
  if (goes_on(branch, special)) return std::pair(here, branch.points[special.after + 1].label);
  const bool ends_in_another = special.passage == Passage::merges || special.passage == Passage::symmetric;
  if (!ends_in_another || !changes_events(special.type) || special.born.empty()) return std::nullopt;
  return std::pair(here, class_name(special.born.front()));
}

std::string what_becomes(const SpecialPoint& point) {
  switch (point.passage) {
    case Passage::persistence:
      return "persistence";
    case Passage::fold:
      return "non-smooth fold";
    case Passage::jump:
      if (point.jump->kind == Jump::Kind::departs) return "jump";
      return "jump to " + destination(*point.jump);
    case Passage::family:
      return "from there on it is one of a family";
    case Passage::cascade:
      return "one of infinitely many changes";
    case Passage::merges:
      return point.type == SpecialType::PD ? "" : "from there on it is a shorter orbit, run through more than once";
    case Passage::equilibrium:
      return "the cycle shrinks to a state of rest";
    case Passage::retraced:
      return "the branch turns back onto its own orbits";
    case Passage::not_followed:
      return "not followed";
    case Passage::unknown:
      return point.type == SpecialType::CH ? "the branch ends" : "none found";
    case Passage::same_events:
    case Passage::symmetric:
      break;
  }
  return "";
}

std::string_view name(BranchEnd::Kind kind) {
  constexpr std::array<std::string_view, 13> names = {
      "range",   "closed",   "no-model",        "special", "over-itself", "unbounded", "most-points",
      "stopped", "led-back", "too-many-events", "no-step", "no-change",   "refused"};
  return names.at(static_cast<std::size_t>(kind));
}

std::string_view name(CurveEnd::Kind kind) {
  constexpr std::array<std::string_view, 5> names = {"range", "most-points", "stopped", "end-of-torus", "no-step"};
  return names.at(static_cast<std::size_t>(kind));
}

std::string name(const Meeting& met) {
  switch (met.kind) {
    case Meeting::Kind::resonance:
    case Meeting::Kind::end_of_torus:
      return "R" + std::to_string(met.order);
    case Meeting::Kind::turn:
      return "turn";
    default:
      return std::string(name(met.type));
  }
}

std::string sentence(const NormalForm& form) {
  switch (form.verdict) {
    case NormalForm::Verdict::none:
    case NormalForm::Verdict::fold:
      return "";
    case NormalForm::Verdict::supercritical:
      return "supercritical";
    case NormalForm::Verdict::subcritical:
      return "subcritical";
    case NormalForm::Verdict::not_simple:
      return "the critical multiplier is not that of a simple eigenvector";
    case NormalForm::Verdict::resonance:
      return "near the resonance 1:" + std::to_string(form.resonance);
    case NormalForm::Verdict::other_critical:
      return "another multiplier is near the unit circle";
    case NormalForm::Verdict::too_inexact:
      return "its error is too large";
    case NormalForm::Verdict::no_map:
      break;
  }
  return "a leg beside the orbit does not end";
}

std::string sentence(const Branch& branch, const BranchEnd& end) {
  const std::string beyond = "beyond " + branch.parameter + " = " + shown(end.value);
  switch (end.kind) {
    case BranchEnd::Kind::range:
      return "range";
    case BranchEnd::Kind::closed:
      return "closed";
    case BranchEnd::Kind::no_model:
      return "the model ends at " + branch.parameter + " = " + shown(end.value) + " (" + end.detail + ")";
    case BranchEnd::Kind::special:
      return end_at(branch.special.at(*end.special));
    case BranchEnd::Kind::over_itself:
      return "runs over itself from " + shown(end.value) + " on";
    case BranchEnd::Kind::unbounded:
      return "the orbit grows without bound as " + branch.parameter + " nears " + shown(end.value);
    case BranchEnd::Kind::most_points:
      return std::to_string(end.limit) + " points each way, the most allowed";
    case BranchEnd::Kind::stopped:
      return "stopped";
    case BranchEnd::Kind::led_back:
      return "the events change at " + branch.parameter + " = " + shown(end.value) +
             ", and what was found beyond leads back over the branch itself";
    case BranchEnd::Kind::too_many_events:
      return "an orbit of more than " + std::to_string(end.limit) + " events is not followed, " + beyond;
    case BranchEnd::Kind::no_change:
      return "the motion has other events than the orbit " + beyond + " (" + end.detail + ")";
    case BranchEnd::Kind::no_step:
    case BranchEnd::Kind::refused:
      break;
  }
  return beyond + ": " + end.detail;
}

std::string sentence(const Branch& branch) {
  if (branch.up.kind == BranchEnd::Kind::closed) return "closed";
  return "down: " + sentence(branch, branch.down) + "; up: " + sentence(branch, branch.up);
}

std::string sentence(const Curve& curve, const CurveEvent& event, const System& system) {
  std::string text;
  for (const Meeting& met : event.met) text += (text.empty() ? "" : "; ") + sentence(curve, met, system);
  return text;
}

std::string sentence(const Curve& curve, const System& system) {
  return "down: " + sentence(curve, curve.down, system) + "; up: " + sentence(curve, curve.up, system);
}

}  // namespace slapstick::orbit
