/// Finds windows of one kind of motion along omega, and bisects their edges.
#include "reproduce/window.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

namespace slapstick::paper {

namespace {

/// Enough to tell a periodic motion, started next to itself, from all others. Less would deny cycles that attract
/// weakly, and put edges where none are.
ClassifyOptions brief() {
  ClassifyOptions how;
  how.transient_periods = 500;
  how.most_periods = 15'000;
  how.exponent_periods = 400;
  return how;
}

/// For many values: chaos is told from the rest after a quarter of the usual search.
ClassifyOptions for_survey() {
  ClassifyOptions how;
  how.most_periods = 5000;
  return how;
}

double largest_multiplier(const Found& found) {
  return found.what.multipliers.empty() ? 0.0 : std::abs(found.what.multipliers.front());
}

/// `Edge::hidden` by the last two cycles inside; no more than `most`, also where the multipliers do not grow.
double hidden_beyond(const Found& before, const Found& inside, double most) {
  const double modulus = largest_multiplier(inside);
  if (modulus < weakly_attracting) return 0.0;
  const double growth = (modulus - largest_multiplier(before)) / std::abs(inside.omega - before.omega);
  const double distance = std::max(1.0 - modulus, 0.0) / growth;
  return growth > 0.0 && distance < most ? distance : most;
}

}  // namespace

double Edge::within() const { return found ? std::max(std::abs(outside.omega - inside.omega), 2.0 * hidden) : 0.0; }

Edge follow(const Study& study, const Overrides& with, const Found& seed, double limit, const Wanted& wanted,
            const Search& search) {
  Edge edge;
  edge.inside = seed;
  Found before = seed;
  const double sign = limit > seed.omega ? 1.0 : -1.0;
  // A long step may leave the basin before the attractor ends: each time, go on in steps of a third as long.
  for (double step = search.step; !edge.found || std::abs(edge.outside.omega - edge.inside.omega) > search.tolerance;
       step /= 3.0) {
    for (edge.found = false; !edge.found;) {
      study.course().check();
      const double ahead = std::abs(limit - edge.inside.omega);
      if (ahead == 0.0) return edge;
      const double omega = ahead < 1.5 * step ? limit : edge.inside.omega + sign * step;
      Found next = study.find(with, omega, edge.inside.what.state, brief());
      edge.found = !wanted(next.what);
      if (!edge.found)
        before = std::exchange(edge.inside, std::move(next));
      else
        edge.outside = std::move(next);
    }
  }
  edge.hidden = hidden_beyond(before, edge.inside, std::abs(limit - edge.inside.omega));
  ClassifyOptions patient;
  patient.transient_periods = 3000;
  patient.most_periods = 5000;
  patient.exponent_periods = 2000;  // attraction is weak near a bifurcation
  const double further = edge.outside.omega + sign * search.beyond;
  edge.beyond = study.find(with, further, edge.outside.what.state, patient);
  return edge;
}

Window around(const Study& study, const Overrides& with, const Found& seed, double from, double to,
              const Wanted& wanted, const Search& search) {
  Window window;
  window.found = wanted(seed.what);
  if (!window.found) return window;
  window.lower = follow(study, with, seed, from, wanted, search);
  window.upper = follow(study, with, seed, to, wanted, search);
  return window;
}

Wanted cycle(int n, long p) {
  return [n, p](const Classification& what) {
    return what.attractor == Attractor::periodic && what.n == n && what.p == p && what.chatter != Chatter::complete;
  };
}

Wanted cycle(int n, long p, bool sticking) {
  return [base = cycle(n, p), sticking](const Classification& what) { return base(what) && what.sticking == sticking; };
}

std::vector<Found> survey(const Study& study, const Overrides& with, double from, double to, double step, bool up) {
  const int last = static_cast<int>(std::lround((to - from) / step));
  std::vector<Found> found;
  State state = study.rest();
  for (int k = 0; k <= last; ++k) {
    study.course().check();
    const int i = up ? k : last - k;
    found.push_back(study.find(with, from + (to - from) * i / last, state, for_survey()));
    state = found.back().what.state;
  }
  if (!up) std::reverse(found.begin(), found.end());
  return found;
}

std::vector<Run> runs(const std::vector<Found>& survey) {
  std::vector<Run> out;
  for (const Found& found : survey) {
    if (out.empty() || out.back().label != found.what.label) {
      out.push_back({found.what.label, found.what.attractor, found.omega, found.omega, 0});
    }
    out.back().to = found.omega;
    ++out.back().count;
  }
  return out;
}

}  // namespace slapstick::paper
