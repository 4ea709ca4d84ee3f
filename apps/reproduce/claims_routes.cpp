/// C6 to C8: how the windows end in chaos.
#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "reproduce/claims.hpp"

namespace slapstick::paper {
namespace {

bool is_chaotic(const Classification& what) { return what.attractor == Attractor::chaotic; }
bool quasi_periodic(const Classification& what) { return what.attractor == Attractor::quasi_periodic; }

/// The 2n-2p window that follows a period doubling of n-p: its first value found in steps, then its upper edge.
std::optional<Edge> doubled(const Study& study, const Edge& edge, int n, long p, double step, double tolerance) {
  const double limit = edge.omega() + 40.0 * step;
  const auto seed = scan(study, {}, edge.outside.omega, edge.outside.what.state, step, limit, cycle(2 * n, 2 * p));
  if (!seed) return std::nullopt;
  return follow(study, {}, *seed, seed->omega + 0.2, cycle(2 * n, 2 * p),
                {step, tolerance, std::min(1e-3, 0.2 * step)});
}

/// What is found beyond a Neimark-Sacker edge, each value from the same start: quasi-periodic, locked, chaotic.
std::vector<Found> beyond(const Study& study, const Edge& edge, double to) {
  const double step = study.sizes().locked_step;
  const double first = std::ceil((edge.omega() + 2e-4) / step) * step;
  std::vector<Found> all;
  State state = edge.outside.what.state;
  for (int k = 0; first + k * step <= to; ++k) {
    study.course().check();
    all.push_back(study.find({}, first + k * step, state));
    state = all.back().what.state;
  }
  return all;
}

/// Edges of the locked windows that span at least two values.
void add_locked(const Study& study, const std::vector<Found>& values, Claim& claim) {
  for (const Run& run : runs(values)) {
    if (run.attractor != Attractor::periodic || run.count < 2) continue;
    const auto seed =
        std::find_if(values.begin(), values.end(), [&](const Found& found) { return found.omega == run.from; });
    const Wanted same = cycle(seed->what.n, seed->what.p);
    const Search fine{study.sizes().locked_step, 5e-5, 5e-4};
    const Window window = around(study, {}, *seed, run.from - 0.01, run.to + 0.01, same, fine);
    const std::string name = std::to_string(seed->what.n) + "-" + std::to_string(seed->what.p);
    claim.quantities.push_back(edge_quantity("lower edge of the locked " + name + " window", "", window.lower));
    claim.quantities.push_back(edge_quantity("upper edge of the locked " + name + " window", "", window.upper));
  }
}

/// The route n-1 -> 2n-2 -> invariant circles -> chaos, which C7 and C8 claim.
struct Route {
  Edge doubling;
  std::optional<Edge> circle;
  std::vector<Found> after;
  std::optional<double> quasi, locked, chaos;  ///< first frequency of each kind beyond the circle's birth
};

Route route(const Evidence& evidence, int n, double to) {
  Route out;
  out.doubling = evidence.surveys.paper().windows[n].upper;
  out.circle = doubled(evidence.study, out.doubling, n, 1, 5e-4, 5e-5);
  if (!out.circle) return out;
  out.after = beyond(evidence.study, *out.circle, to);
  const auto first = [&](const Wanted& wanted) -> std::optional<double> {
    const auto found =
        std::find_if(out.after.begin(), out.after.end(), [&](const Found& one) { return wanted(one.what); });
    return found == out.after.end() ? std::nullopt : std::optional(found->omega);
  };
  out.quasi = first(quasi_periodic);
  out.locked = first([](const Classification& what) { return what.attractor == Attractor::periodic; });
  out.chaos = first(is_chaotic);
  return out;
}

void add_first(Claim& claim, const std::string& what, const std::optional<double>& omega, double step) {
  Quantity quantity{"first " + what + " value beyond it", "", "none", omega, "in steps of " + shown(step)};
  if (omega) quantity.computed = grid_value(*omega, step);
  claim.quantities.push_back(quantity);
}

void add_route(const Study& study, const Route& route, Claim& claim, const std::string& simple,
               const std::string& twice) {
  claim.quantities.push_back(edge_quantity(simple + " doubles to " + twice, "", route.doubling));
  if (!route.circle) return;
  claim.quantities.push_back(edge_quantity(twice + " loses stability", "", *route.circle));
  const double step = study.sizes().locked_step;
  add_first(claim, "quasi-periodic", route.quasi, step);
  add_first(claim, "locked", route.locked, step);
  add_first(claim, "chaotic", route.chaos, step);
  add_locked(study, route.after, claim);
}

/// Of two neighbouring intervals between doublings, with what the edges' errors make of it to first order.
Quantity interval_ratio(std::size_t index, const Edge& a, const Edge& b, const Edge& c) {
  const double first = b.omega() - a.omega(), second = c.omega() - b.omega(), ratio = first / second;
  const double within =
      std::abs(ratio) * ((a.within() + b.within()) / std::abs(first) + (b.within() + c.within()) / std::abs(second));
  return {"ratio of successive intervals, " + std::to_string(index),
          "",
          place(ratio, within),
          ratio,
          "tends to 4.6692 (Feigenbaum)",
          within};
}

/// The pair of multipliers at the end of `edge` is complex and on the unit circle.
bool leaves_as_a_pair(const std::optional<Edge>& edge) {
  if (!edge || !edge->found || edge->inside.what.multipliers.empty()) return false;
  const std::complex<double> leading = edge->inside.what.multipliers.front();
  return std::abs(leading) > 0.98 && std::abs(leading.imag()) > 1e-3;
}

}  // namespace

Claim claim_6(const Evidence& evidence) {
  const Study& study = evidence.study;
  Claim claim{"C6", "1-1-I doubles to 2-2 near 2.84 and on to chaos (Fig. 6a).", "", Agreement::no, "", {}};
  Edge edge = evidence.surveys.paper().windows[1].upper;
  if (edge.found) edge = follow(study, {}, edge.inside, 3.0, cycle(1, 1), {1e-4, 1e-6, 1e-3});
  std::vector<Edge> edges = {edge};
  claim.quantities.push_back(edge_quantity("1-1 doubles", "2.84", edge));
  double step = 2e-3;
  for (int n = 2; n <= 16; n *= 2, step /= 4.5) {
    const auto next = doubled(study, edge, n / 2, n / 2, step, 1e-6);
    if (!next || !next->found) break;
    edge = *next;
    edges.push_back(edge);
    const std::string kind = std::to_string(n) + "-" + std::to_string(n);
    claim.quantities.push_back(edge_quantity(kind + " doubles", "", edge));
  }
  for (std::size_t k = 2; k < edges.size(); ++k)
    claim.quantities.push_back(interval_ratio(k - 1, edges[k - 2], edges[k - 1], edges[k]));
  constexpr double chaos_step = 5e-4;
  const auto chaos = scan(study, {}, edge.omega(), edge.outside.what.state, chaos_step, 3.0, is_chaotic);
  const std::string chaos_from = chaos ? place(chaos->omega, chaos_step) : "";
  if (chaos)
    claim.quantities.push_back(
        {"first chaotic value", "", chaos_from, chaos->omega,
         "in steps of " + shown(chaos_step) + "; exponent " + fixed(chaos->what.exponent, 3) + " per period",
         chaos_step});
  claim.computed = std::to_string(edges.size()) + " period doublings at ω =";
  for (const Edge& one : edges) claim.computed += " " + place(one);
  claim.computed += chaos ? "; chaos from " + chaos_from + " on." : "; no chaos found.";
  const bool good = edges.size() >= 3 && chaos && std::abs(edges[0].omega() - 2.84) < 0.01;
  claim.agreement = good ? Agreement::yes : Agreement::partly;
  claim.explanation =
      "A multiplier passes -1 at each step. The intervals do not shrink at Feigenbaum's rate, 4.67, throughout. This "
      "rate "
      "is the law of smooth maps, and a return map through impacts and friction is only piecewise smooth (the branches "
      "have a kink near 2.90).";
  return claim;
}

Claim claim_7(const Evidence& evidence) {
  const Study& study = evidence.study;
  const Route found = route(evidence, 2, 4.84);
  Claim claim{"C7",
              "2-1-I doubles to 4-2-I; at 4.801 two fixed points of the impact map, at 4.805 two invariant circles: a "
              "Hopf bifurcation between; then phase locking, then chaos (Figs. 6b, 7).",
              "",
              Agreement::no,
              "",
              {}};
  const Found at_4801 = study.find({}, 4.801, study.rest()), at_4805 = study.find({}, 4.805, study.rest());
  claim.quantities = {class_quantity("class at 4.801", "4-2-I", at_4801),
                      class_quantity("class at 4.805", "quasi-periodic", at_4805)};
  add_route(study, found, claim, "2-1-I", "4-2-I");
  const bool points = at_4801.what.label == "4-2-I" && quasi_periodic(at_4805.what);
  const bool way = leaves_as_a_pair(found.circle) && found.locked && found.chaos;
  claim.agreement = points && way ? Agreement::yes : points ? Agreement::partly : Agreement::no;
  claim.computed =
      "4.801: " + at_4801.what.label + "; 4.805: " + at_4805.what.label +
      "; the pair of multipliers leaves the unit circle at ω = " + (found.circle ? place(*found.circle) : "?") + ".";
  claim.explanation =
      "For a map the bifurcation is called Neimark-Sacker; the paper's word Hopf means the same here. After the "
      "circles come "
      "locked windows, which double, and chaos, as the paper says.";
  return claim;
}

Claim claim_8(const Evidence& evidence) {
  const Study& study = evidence.study;
  const Route found = route(evidence, 3, 6.70);
  Claim claim{"C8", "3-1-I becomes 6-2-I by a pitchfork bifurcation, then Hopf, then chaos, below 6.7 (Fig. 6c).",
              "",   Agreement::no,
              "",   {}};
  add_route(study, found, claim, "3-1-I", "6-2-I");
  const bool doubling = found.doubling.found && !found.doubling.inside.what.multipliers.empty() &&
                        found.doubling.inside.what.multipliers.front().real() < -0.98;
  const bool way = doubling && leaves_as_a_pair(found.circle) && found.chaos && *found.chaos < 6.7;
  claim.agreement = way ? Agreement::yes : Agreement::partly;
  claim.computed = "Doubling at ω = " + place(found.doubling) + ", Neimark-Sacker at " +
                   (found.circle ? place(*found.circle) : "?") + ", chaos from " +
                   (found.chaos ? grid_value(*found.chaos, study.sizes().locked_step) : "?") + ".";
  claim.explanation =
      "The route and its place are confirmed. The first step is a period doubling (a multiplier passes -1), "
      "not a pitchfork: in the diagram both look like a fork.";
  return claim;
}

}  // namespace slapstick::paper
