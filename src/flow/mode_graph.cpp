#include "slapstick/flow/mode_graph.hpp"

#include <array>

namespace slapstick::flow {
namespace {

/// The state where a guard was located carries the error of its root as well as its own rounding.
constexpr double rest_factor = 8.0;

constexpr int most_contacts = 16;

/// What one contact offers, as digits of a mode id (stop: open 0, closed 1; friction: slip- 0, stick 1, slip+ 2).
struct Candidates {
  std::array<int, 3> digit;
  int count;
};

Candidates friction_candidates(double w) {
  if (w > 0.0) return {{2}, 1};
  if (w < 0.0) return {{0}, 1};
  return {{1, 2, 0}, 3};
}

Candidates stop_candidates(double gap, double approach) {
  if (gap == 0.0 && approach == 0.0) return {{1, 0}, 2};
  return {{0}, 1};
}

double dot(const double* row, const double* X, int count) {
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += row[i] * X[i];
  return sum;
}

double rate(const System& system, const mode::ContactRow& contact, const double* X) {
  const mode::Frame& frame = system.frame();
  if (contact.own >= 0) return X[frame.u(contact.own)] + frame.drift[contact.own];
  double sum = 0.0;
  for (int i = 0; i < frame.n; ++i) sum += contact.row[i] * (X[frame.u(i)] + frame.drift[i]);
  return sum;
}

bool fits(const mode::Mode& mode, const double* X, const double* magnitude, std::span<int> orders) {
  if (!mode.possible()) return false;
  for (int g = 0; g < mode.guard_count(); ++g) {
    orders[g] = start_order(mode, g, X, magnitude);
    if (orders[g] == negative) return false;
    if (orders[g] == never && mode.guards()[g].kind == mode::GuardKind::slip)
      return false;  // at rest for good: stick, not slip
  }
  return true;
}

}  // namespace

int start_order(const mode::Mode& mode, int guard, const double* X, const double* magnitude, int known) {
  const mode::Guard& h = mode.guards()[guard];
  if (known == 0 && h.single >= 0 && h.factor * X[h.single] > 0.0) return 0;
  event::Lane8 a, noise;
  mode.leading(guard, X, magnitude, a, noise);
  for (int n = known; n < never; ++n) {
    if (a[n] > rest_factor * noise[n]) return n;
    if (a[n] < -rest_factor * noise[n]) return negative;
  }
  return never;
}

double sliding_velocity(const System& system, int contact, const double* X) {
  const mode::ContactRow& row = system.frame().frictions[contact];
  if (row.own >= 0) return X[system.frame().u(row.own)];
  return rate(system, row, X) - system.model().frictions[contact].belt_speed;
}

double gap(const System& system, int stop, const double* X) {
  const mode::ContactRow& contact = system.frame().stops[stop];
  if (contact.own >= 0) return -X[contact.own];
  const mode::Frame& frame = system.frame();
  return system.model().stops[stop].clearance - contact.row.dot(frame.shift) - dot(contact.row.data(), X, frame.n);
}

double approach_velocity(const System& system, int stop, const double* X) {
  return rate(system, system.frame().stops[stop], X);
}

int approaching_mode(const System& system, const double* X) {
  const Model& model = system.model();
  mode::ContactStates states{std::vector<mode::StopState>(model.stops.size(), mode::StopState::open), {}};
  for (int i = 0; i < static_cast<int>(model.frictions.size()); ++i) {
    const double w = sliding_velocity(system, i, X);
    states.frictions.push_back(w > 0.0   ? mode::FrictionState::slip_plus
                               : w < 0.0 ? mode::FrictionState::slip_minus
                                         : mode::FrictionState::stick);
  }
  return system.mode_id(states);
}

int select_mode(const System& system, const double* X, const double* magnitude, std::span<int> orders) {
  const Model& model = system.model();
  const auto stops = static_cast<int>(model.stops.size());
  const int contacts = stops + static_cast<int>(model.frictions.size());
  std::array<Candidates, most_contacts> offered;
  for (int c = 0; c < contacts; ++c) {
    offered[c] = c < stops ? stop_candidates(gap(system, c, X), approach_velocity(system, c, X))
                           : friction_candidates(sliding_velocity(system, c - stops, X));
  }
  // Count through all combinations; the last contact's candidates change fastest.
  std::array<int, most_contacts> choice{};
  for (;;) {
    int id = 0, stride = 1;
    for (int c = 0; c < contacts; ++c) {
      id += stride * offered[c].digit[choice[c]];
      stride *= c < stops ? 2 : 3;
    }
    if (fits(system.mode(id), X, magnitude, orders)) return id;
    int c = contacts - 1;
    while (c >= 0 && ++choice[c] == offered[c].count) choice[c--] = 0;
    if (c < 0) return -1;
  }
}

}  // namespace slapstick::flow
