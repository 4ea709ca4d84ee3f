/// C9: what more friction does, as numbers.
#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "reproduce/claims.hpp"

namespace slapstick::paper {
namespace {

constexpr double high = 5.0;  // "higher excitation frequencies"

/// The numbers of one friction value.
struct Row {
  double friction = 0.0;
  const Window* windows = nullptr;                                      ///< [n]: of n-1 motion
  double low_speed = 0.0;                                               ///< mean impact speed below 1.12
  double periodic = 0.0, chaotic = 0.0, sticking = 0.0;                 ///< shares of [0.56, 10]
  double high_periodic = 0.0, high_chaotic = 0.0, high_sticking = 0.0;  ///< shares of [5, 10]
};

bool periodic(const Classification& what) { return what.attractor == Attractor::periodic; }
bool chaotic(const Classification& what) { return what.attractor == Attractor::chaotic; }
bool sticks(const Classification& what) { return what.sticking; }

/// Over omega = 0.6, 0.65, .. 1.1, each started from rest, over the impacts of 100 periods.
double mean_impact_speed(const Study& study, double friction) {
  double sum = 0.0;
  int count = 0;
  for (; count <= 10; ++count) {
    const System system = study.system({{"friction", friction}}, 0.6 + 0.05 * count);
    Motion motion(system, study.rest());
    while (motion.advance({500, 0.0}) == Outcome::event) {
    }
    double speeds = 0.0;
    long impacts = 0;
    while (motion.advance({600, 0.0}) == Outcome::event) {
      if (motion.event().kind != EventKind::impact) continue;
      speeds += motion.event().w;
      ++impacts;
    }
    if (impacts > 0) sum += speeds / static_cast<double>(impacts);
  }
  return sum / count;
}

Row row(const Evidence& evidence, std::size_t i) {
  const std::vector<Found>& survey = evidence.surveys.frictions[i].survey;
  Row out;
  out.friction = friction_values[i];
  out.windows = evidence.surveys.frictions[i].windows;
  out.low_speed = mean_impact_speed(evidence.study, out.friction);
  out.periodic = share(survey, 0.0, 10.0, periodic);
  out.chaotic = share(survey, 0.0, 10.0, chaotic);
  out.sticking = share(survey, 0.0, 10.0, sticks);
  out.high_periodic = share(survey, high, 10.0, periodic);
  out.high_chaotic = share(survey, high, 10.0, chaotic);
  out.high_sticking = share(survey, high, 10.0, sticks);
  return out;
}

void add(const Row& row, Claim& claim) {
  const std::string at = " at f_s = " + shown(row.friction);
  claim.quantities.push_back(
      number_quantity("mean impact speed below 1.12" + at, "", row.low_speed, 4, "at ω = 0.6, 0.65, … 1.1"));
  for (int n = 1; n <= 6; ++n) {
    const Window& window = row.windows[n];
    if (!window.found) continue;
    const std::string name = std::to_string(n) + "-1 window" + at;
    claim.quantities.push_back(edge_quantity("lower edge of the " + name, "", window.lower));
    claim.quantities.push_back(edge_quantity("upper edge of the " + name, "", window.upper));
  }
  claim.quantities.push_back(number_quantity("share of [0.56, 10] periodic" + at, "", row.periodic, 3));
  claim.quantities.push_back(number_quantity("share of [0.56, 10] chaotic" + at, "", row.chaotic, 3));
  claim.quantities.push_back(number_quantity("share of [0.56, 10] sticking" + at, "", row.sticking, 3));
  claim.quantities.push_back(number_quantity("share of [5, 10] periodic" + at, "", row.high_periodic, 3));
  claim.quantities.push_back(number_quantity("share of [5, 10] chaotic" + at, "", row.high_chaotic, 3));
  claim.quantities.push_back(number_quantity("share of [5, 10] sticking" + at, "", row.high_sticking, 3));
}

/// The values of a quantity for all friction values, as "0.1, 0.2, ..."
template <class Value>
std::string listed(const std::vector<Row>& rows, int digits, const Value& value) {
  std::string out;
  for (const Row& row : rows) out += (out.empty() ? "" : ", ") + fixed(value(row), digits);
  return out;
}

/// The upper edges of the n-1 windows, likewise.
std::string upper_edges(const std::vector<Row>& rows, int n) {
  std::string out;
  for (const Row& row : rows) {
    const Window& window = row.windows[n];
    out += (out.empty() ? "" : ", ") + (window.found ? place(window.upper) : "none");
  }
  return out;
}

template <class Value>
bool falls(const std::vector<Row>& rows, const Value& value) {
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (!(value(rows[i]) < value(rows[i - 1]))) return false;
  return true;
}

double upper_3(const Row& row) { return row.windows[3].found ? row.windows[3].upper.omega() : std::nan(""); }

std::string verdict(const std::string& what, bool holds) {
  return what + (holds ? ": yes. " : ": no, not throughout. ");
}

void judge(const std::vector<Row>& rows, Claim& claim) {
  const auto upper_1 = [](const Row& row) { return row.windows[1].upper.omega(); };
  const bool slower = falls(rows, [](const Row& row) { return row.low_speed; });
  const bool little = std::abs(upper_1(rows.back()) - upper_1(rows.front())) < 0.1;
  const bool left = falls(rows, upper_3);
  const bool wider = falls(rows, [](const Row& row) { return -row.high_chaotic; });
  const bool sticky = falls(rows, [](const Row& row) { return -row.sticking; });
  const int good = slower + little + left + wider + sticky;
  claim.agreement = good == 5 ? Agreement::yes : good > 0 ? Agreement::partly : Agreement::no;
  claim.computed =
      "For f_s = f_k = 0, 0.05, 0.1, 0.15, 0.2, 0.3: mean impact speed below 1.12: " +
      listed(rows, 3, [](const Row& row) { return row.low_speed; }) + "; upper edge of 1-1: " + upper_edges(rows, 1) +
      "; of 3-1: " + upper_edges(rows, 3) +
      "; share of [5, 10] that is chaotic: " + listed(rows, 2, [](const Row& row) { return row.high_chaotic; }) +
      "; share of [0.56, 10] that sticks: " + listed(rows, 2, [](const Row& row) { return row.sticking; }) + ".";
  claim.explanation = verdict("Smaller impact speeds at low ω", slower) +
                      verdict("Little change of the 1-1 window (under 0.1)", little) +
                      verdict("Bifurcation points at high ω move left with every step of friction", left) +
                      verdict("Chaos widens at high ω with every step", wider) +
                      verdict("Sticking orbits gain with every step", sticky) +
                      "Sticking includes rest on the closed stop after complete chatter, which needs no friction: so "
                      "its share is not 0 at f_s = 0. ";
  if (!wider)
    claim.explanation +=
        "Without friction the bands are the widest; some friction first narrows them, and only strong friction fills "
        "the highest frequencies with chaos. "
        "The paper does not print its friction values; from 0.15 upwards its words hold best.";
}

}  // namespace

Claim claim_9(const Evidence& evidence) {
  Claim claim{
      "C9",
      "More friction changes little at low ω beyond smaller impact speeds; at high ω bifurcation points move left, "
      "periodic windows shrink, chaos widens, non-sticking orbits become sticking (Fig. 8).",
      "",
      Agreement::no,
      "",
      {}};
  std::vector<Row> rows;
  for (std::size_t i = 0; i < std::size(friction_values); ++i) rows.push_back(row(evidence, i));
  for (const Row& one : rows) add(one, claim);
  judge(rows, claim);
  return claim;
}

}  // namespace slapstick::paper
