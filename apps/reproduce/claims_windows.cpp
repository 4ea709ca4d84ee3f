/// C1 to C5: the windows that the paper prints.
#include <algorithm>
#include <cmath>

#include "reproduce/claims.hpp"

namespace slapstick::paper {
namespace {

/// The print has two decimals, as read off a diagram in steps of 0.01: it is confirmed if it is the last such step
/// inside the window.
bool confirms(const Window& window, double lower, double upper) {
  if (!window.found || !window.lower.found || !window.upper.found) return false;
  return std::abs(std::ceil(100.0 * window.lower.omega()) - 100.0 * lower) < 0.5 &&
         std::abs(std::floor(100.0 * window.upper.omega()) - 100.0 * upper) < 0.5;
}

const char* const as_a_grid =
    "Each printed edge is the last multiple of 0.01 inside the computed window: a diagram in such steps shows exactly "
    "these.";

std::string interval(const Window& window) { return "[" + place(window.lower) + ", " + place(window.upper) + "]"; }

const Window& one_impact(const Evidence& evidence) { return evidence.surveys.paper().windows[1]; }

Window sticking(const Evidence& evidence) {
  const Found seed = evidence.study.find({}, 1.5, evidence.study.rest());
  return around(evidence.study, {}, seed, 1.0, 3.0, cycle(1, 1, true));
}

}  // namespace

Claim claim_1(const Evidence& evidence) {
  const Window& window = one_impact(evidence);
  Claim claim{"C1", "One impact per forcing cycle for ω in [1.12, 2.84].", "", Agreement::no, "", {}};
  claim.computed = "One impact per forcing cycle for ω in " + interval(window) + ".";
  const bool both = confirms(window, 1.12, 2.84);
  claim.agreement = both ? Agreement::yes : Agreement::no;
  claim.explanation = both ? as_a_grid : "An edge differs from the print.";
  claim.quantities = {edge_quantity("lower edge of the 1-1 window", "1.12", window.lower),
                      edge_quantity("upper edge of the 1-1 window", "2.84", window.upper)};
  return claim;
}

Claim claim_2(const Evidence& evidence) {
  const Window window = sticking(evidence);
  Claim claim{
      "C2", "In it, slip-stick motion (1-1-II) only for ω in [1.47, 1.6]; Fig. 3: ω = 1.5.", "", Agreement::no, "", {}};
  claim.computed = "1-1-II for ω in " + interval(window) + ".";
  const auto other =
      share(evidence.surveys.paper().survey, 1.12, 2.84, [](const Classification& what) { return what.sticking; });
  const bool both = confirms(window, 1.47, 1.60);
  claim.agreement = both ? Agreement::yes : Agreement::no;
  claim.explanation =
      std::string(both ? as_a_grid : "An edge differs from the print.") +
      " The caption of Fig. 3 calls ω = 1.5 a 1-1-I motion, the text a sticking one. The motion sticks. "
      "The orbit passes both edges unchanged; only its stick phase appears and vanishes there.";
  claim.quantities = {
      edge_quantity("lower edge of the 1-1-II window", "1.47", window.lower),
      edge_quantity("upper edge of the 1-1-II window", "1.6", window.upper),
      class_quantity("class at 1.5", "1-1-II (text)", evidence.study.find({}, 1.5, evidence.study.rest())),
      number_quantity("share of [1.12, 2.84] that sticks", "", other, 3)};
  return claim;
}

Claim claim_3(const Evidence& evidence) {
  const Window& whole = one_impact(evidence);
  const Window stick = sticking(evidence);
  const auto& up = evidence.surveys.paper().survey;
  const double below = share(up, whole.lower.inside.omega, stick.lower.outside.omega, cycle(1, 1, false));
  const double above = share(up, stick.upper.outside.omega, whole.upper.inside.omega, cycle(1, 1, false));
  const Found text = evidence.study.find({}, 2.2, evidence.study.rest()),
              caption = evidence.study.find({}, 2.0, evidence.study.rest());
  Claim claim{"C3", "1-1-I for ω in [1.12, 1.47] and [1.6, 2.84]; Fig. 4: ω = 2.2 in the text, 2 in the caption.",
              "",   Agreement::no,
              "",   {}};
  claim.computed = "1-1-I for ω in [" + place(whole.lower) + ", " + place(stick.lower) + "] and [" +
                   place(stick.upper) + ", " + place(whole.upper) + "].";
  const bool good = below == 1.0 && above == 1.0 && text.what.label == "1-1-I" && caption.what.label == "1-1-I";
  claim.agreement = good ? Agreement::yes : Agreement::partly;
  claim.explanation = "Both readings of Fig. 4 are 1-1-I; the edges are those of C1 and C2.";
  claim.quantities = {class_quantity("class at 2.2", "1-1-I", text), class_quantity("class at 2", "1-1-I", caption),
                      number_quantity("share of 1-1-I below the stick window", "1", below, 3),
                      number_quantity("share of 1-1-I above the stick window", "1", above, 3)};
  return claim;
}

Claim claim_5(const Evidence& evidence) {
  Claim claim{"C5",
              "On [0.56, 10] large windows of n-1 motion with narrow chaotic bands between neighbours; ω t_f / 2π is a "
              "staircase.",
              "",
              Agreement::no,
              "",
              {}};
  const auto& up = evidence.surveys.paper().survey;
  double covered = 0.0, bands = 0.0, within_all = 0.0;
  Window before;
  int found = 0;
  for (int n = 1; n <= 6; ++n) {
    const Window& window = evidence.surveys.paper().windows[n];
    if (!window.found) continue;
    const std::string name = std::to_string(n) + "-1";
    ++found;
    covered += window.width();
    within_all += window.lower.within() + window.upper.within();
    if (before.found) {
      const double low = before.upper.omega(), high = window.lower.omega();
      bands += std::max(0.0, high - low);
      const double chaotic =
          share(up, low, high, [](const Classification& what) { return what.attractor == Attractor::chaotic; });
      const double within = before.upper.within() + window.lower.within();
      claim.quantities.push_back({"band below the " + name + " window", "narrow, chaotic", place(high - low, within),
                                  high - low,
                                  high < low ? "the two windows overlap: both motions exist there"
                                             : "chaotic at " + fixed(100.0 * chaotic, 0) +
                                                   " % of its frequencies; the rest are cascades and locked windows",
                                  within});
    }
    claim.quantities.push_back(edge_quantity("lower edge of the " + name + " window", "", window.lower));
    claim.quantities.push_back(edge_quantity("upper edge of the " + name + " window", "", window.upper));
    before = window;
  }
  claim.computed = std::to_string(found) + " windows, n = 1 to 6, cover " + place(covered, within_all) +
                   " of the 9.44 units of ω; the bands between them " + place(bands, within_all) + ".";
  claim.agreement = found == 6 && covered > 3.0 * bands ? Agreement::partly : Agreement::no;
  claim.explanation =
      "The staircase is there from ω = 1.12 on. Two things differ from the words: below 1.12 the motion is 1-p with p "
      "> 1 "
      "(C4), not n-1; and the bands are only partly chaotic, with period doublings, invariant curves and locked "
      "windows in them.";
  return claim;
}

}  // namespace slapstick::paper
