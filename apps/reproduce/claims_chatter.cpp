/// C4: chatter below the 1-1 window.
#include <cmath>

#include "base/text.hpp"
#include "reproduce/claims.hpp"

namespace slapstick::paper {
namespace {

/// One burst of a settled motion, event by event.
struct Burst {
  int impacts = 0;
  double first = 0.0, limit = 0.0, error = 0.0,
         release = 0.0;  ///< in forcing periods after a whole period; error in time units
  int limits = 0;        ///< chatter limits in the ten periods watched
  double ratio = 0.0;    ///< of the last two impact speeds
};

Burst watch(const Study& study, double omega) {
  const System system = study.system({}, omega);
  Motion motion(system, study.rest());
  const Instant begin{500, 0.0};
  while (motion.advance(begin) == Outcome::event) {
  }
  Burst burst;
  double last = 0.0;
  while (motion.advance({begin.period + 10, 0.0}) == Outcome::event) {
    const Event& event = motion.event();
    const double t = event.time.since(begin);
    if (event.kind == EventKind::impact && burst.limits == 0) {
      if (burst.impacts++ == 0) burst.first = t;
      burst.ratio = last > 0.0 ? event.w / last : 0.0;
      last = event.w;
    }
    if (event.kind == EventKind::chatter && burst.limits++ == 0) {
      burst.limit = t;
      burst.error = event.error;
    }
    if (event.kind == EventKind::release && burst.limits == 1 && burst.release == 0.0) burst.release = t;
  }
  return burst;
}

Wanted impacts_per_period(long p) {
  return [p](const Classification& what) {
    return what.attractor == Attractor::periodic && what.n == 1 && what.p == p && what.chatter != Chatter::complete;
  };
}

bool complete(const Classification& what) { return what.chatter == Chatter::complete; }

/// The windows of 1-p motion above the edge of complete chatter, each with both edges.
void add_ladder(const Study& study, const Found& above, Claim& claim) {
  Found here = above;
  const Search fine{0.002, 5e-5, 2e-4};
  while (here.omega < 1.13 && here.what.attractor == Attractor::periodic) {
    const Edge edge = follow(study, {}, here, 1.13, impacts_per_period(here.what.p), fine);
    if (here.what.n == 1 && here.what.p > 1 && edge.inside.omega - here.omega > 5e-4)
      claim.quantities.push_back(edge_quantity("upper edge of 1-" + std::to_string(here.what.p), "", edge));
    if (!edge.found) return;
    here = edge.outside;
  }
}

}  // namespace

Claim claim_4(const Evidence& evidence) {
  const Study& study = evidence.study;
  const Found at = study.find({}, 0.552, study.rest());
  const Edge upper = follow(study, {}, at, 0.7, complete, {0.002, 5e-5, 2e-4});
  const Edge lower = follow(study, {}, at, 0.3, complete, Search{0.02});
  const Burst burst = watch(study, 0.552);
  Claim claim{
      "C4",
      "Chatter for ω in [0.55, 1.12]; at 0.552 (Fig. 5) impacts ever closer until the blocks stick, once per period.",
      "",
      Agreement::no,
      "",
      {}};
  claim.computed = "At 0.552 " + at.what.label + ": " + std::to_string(burst.impacts) +
                   " impacts are bounced through one by one, then the proven limit; " + std::to_string(burst.limits) +
                   " limits in 10 periods. Complete chatter up to ω = " + place(upper) +
                   ", from there to 1.12 finite bursts.";
  const bool confirmed = complete(at.what) && burst.limits == 10;
  claim.agreement = !confirmed                                             ? Agreement::no
                    : lower.found && std::abs(lower.omega() - 0.55) < 0.01 ? Agreement::yes
                                                                           : Agreement::partly;
  claim.explanation =
      "Fig. 5 is confirmed: infinitely many impacts in finite time, once per period, then rest on the closed stop. "
      "0.552 lies at the very end of complete "
      "chatter; above it every period has a finite burst whose number of impacts falls step by step to 1 at 1.12, "
      "where the paper's interval ends. "
      "0.55 is no lower limit of chatter: chatter is complete at every lower frequency computed (to 0.3). 0.55 marks "
      "where complete chatter ends.";
  claim.quantities = {
      class_quantity("class at 0.552", "chatter until stick", at),
      number_quantity("impacts at 0.552 before the limit is known to rounding", "", burst.impacts, 0),
      number_quantity("limit at 0.552, periods after the first impact", "", burst.limit - burst.first, 6,
                      "error of the limit time at most " + shown(burst.error) + " time units"),
      number_quantity("rest on the stop after it, periods", "", burst.release - burst.limit, 6),
      number_quantity("ratio of the last two impact speeds", "", burst.ratio, 6, "r sqrt((R - F)/(R + F))"),
      edge_quantity("upper edge of complete chatter", "", upper),
      edge_quantity("lower edge of complete chatter", "0.55", lower)};
  add_ladder(study, upper.outside, claim);
  return claim;
}

}  // namespace slapstick::paper
