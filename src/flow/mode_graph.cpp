/// Chooses the mode that may start at a state, by the order of each guard's zero there.
#include "flow/mode_graph.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "flow/mode_choice.hpp"

namespace slapstick::flow {
namespace {

/// The state where a guard was located carries the error of its root as well as its own rounding.
constexpr double rest_factor = 8.0;

/// A number that is far above the smallest ones, times any window.
constexpr double no_underflow = 0x1p-900;

/// Those that Mode::leading gives. Higher ones are looked at only where these vanish.
constexpr int leading_orders = 8;

/// A normal force that is zero for good, as that of a brake that is off, presses nothing: its contact is unloaded.
/// @returns the first guard that does not start upwards; null if all do
const mode::Guard* unfit_guard(const mode::Mode& mode, const double* X, const double* magnitude,
                               std::span<int> orders) {
  for (int g = 0; g < mode.guard_count(); ++g) {
    const mode::Guard& guard = mode.guards()[g];
    orders[g] = start_order(mode, g, X, magnitude);
    const bool presses_never = orders[g] == never && guard.kind == mode::GuardKind::load;
    if (orders[g] == negative || presses_never) return &guard;
  }
  return nullptr;
}

/// The system and the guards of a mode, whether it has been built or not.
struct Linear {
  const mode::Matrix &system, &system_size;
  const std::vector<mode::Guard>& guards;
};

/// The first guard that certainly starts downwards: by its value, or by a derivative where all before are exactly zero,
/// and among these by the lowest one; or null. For modes without operators; a rounding bound that is more than theirs.
/// So it names nothing that `unfit_guard` would take, and which mode is chosen does not depend on which ones were built
/// before.
const mode::Guard* falling_guard(const Linear& mode, const double* X, const double* magnitude) {
  constexpr double roundings = 64.0 * event::unit_roundoff;
  const auto m = mode.system.rows();
  bool zero_found = false;
  for (const mode::Guard& guard : mode.guards) {
    const double value = guard.at(X);
    if (value < -roundings * static_cast<double>(m) * guard.size(magnitude)) return &guard;
    zero_found = zero_found || value == 0.0;
  }
  if (!zero_found) return nullptr;
  mode::Vector term = Eigen::Map<const mode::Vector>(X, m), size = Eigen::Map<const mode::Vector>(magnitude, m);
  std::vector<const mode::Guard*> open;  // those that start with a zero
  for (const mode::Guard& guard : mode.guards) open.push_back(&guard);
  for (int n = 0;; ++n) {
    std::vector<const mode::Guard*> zero;
    for (const mode::Guard* guard : open) {
      const double value = guard->row.dot(term);
      const double noise = roundings * static_cast<double>(m) * guard->row.cwiseAbs().dot(size);
      if (value < -noise) return guard;
      if (value == 0.0) zero.push_back(guard);
    }
    if (zero.empty() || n == 2) return nullptr;
    open.swap(zero);
    term = mode.system * term;
    size = mode.system_size * size;
  }
}

/// The order of guard h where its leading coefficients vanish. A force that acts at one end of a chain of k masses
/// reaches a stop at the other end in the derivative of order 2 (k - 1).
/// If the first m derivatives c . A^n X of a mode with m numbers vanish, all do (Cayley and Hamilton).
/// The rounding of A^n X, that of A's entries among it, is no more than n (m + 2) u S^n |X|, S = Mode::system_size.
int far_order(const mode::Mode& mode, const mode::Guard& h, const double* X, const double* magnitude) {
  const int m = mode.size();
  if (m <= leading_orders) return never;
  const mode::Matrix& A = mode.system();
  mode::Vector term = Eigen::Map<const mode::Vector>(X, m), size = Eigen::Map<const mode::Vector>(magnitude, m);
  for (int n = 0; n < std::min(m, static_cast<int>(never)); ++n) {
    if (n >= leading_orders) {
      const double value = h.row.dot(term);
      const double noise = rest_factor * (n + 1) * mode.noise_factor() * h.row.cwiseAbs().dot(size);
      if (value > noise) return n;
      if (value < -noise) return negative;
    }
    term = A * term;
    size = mode.system_size() * size;
  }
  return never;
}

}  // namespace

double rounding_of(int m, double size) { return rest_factor * mode::Mode::noise_factor_of(m) * size; }

double rounding_of(const mode::RowVector& row, const double* magnitude) {
  double size = 0.0;
  for (Eigen::Index j = 0; j < row.size(); ++j) size += std::abs(row[j]) * magnitude[j];
  return rounding_of(static_cast<int>(row.size()), size);
}

int start_order(const mode::Mode& mode, int guard, const double* X, const double* magnitude, int known) {
  const mode::Guard& h = mode.guards()[guard];
  if (known == 0) {
    const double value = h.single >= 0 ? h.factor * X[h.single] : h.at(X);
    const double bound = h.single >= 0 ? 0.0 : rounding_of(mode.size(), h.size(magnitude));
    if (value > bound) return 0;
    if (value < -bound) return negative;
    const double rate = value == 0.0 && h.rate >= 0 ? h.factor * X[h.rate] : 0.0;
    if (std::abs(rate) > no_underflow) return rate > 0.0 ? 1 : negative;
  }
  event::Lane8 a, noise;
  mode.leading(guard, X, magnitude, a, noise);
  for (int n = known; n < leading_orders; ++n) {
    if (a[n] > rest_factor * noise[n]) return n;
    if (a[n] < -rest_factor * noise[n]) return negative;
  }
  return far_order(mode, h, X, magnitude);
}

double sliding_velocity(const CompiledSystem& system, int contact, const double* X) {
  const mode::ContactRow& row = system.frame().frictions[contact];
  return row.sign * X[system.frame().u(row.own)];
}

double gap(const CompiledSystem& system, int stop, const double* X) {
  const mode::ContactRow& row = system.frame().stops[stop];
  return -row.sign * X[row.own];
}

double approach_velocity(const CompiledSystem& system, int stop, const double* X) {
  const mode::ContactRow& row = system.frame().stops[stop];
  return row.sign * X[system.frame().u(row.own)];
}

double depth(const CompiledSystem& system, int compliant, const double* X) {
  const mode::ContactRow& row = system.frame().compliant[compliant];
  return row.sign * X[row.own];
}

ModeId approaching_mode(const CompiledSystem& system, const double* X) {
  mode::ContactStates states = system.states(0);
  for (std::size_t i = 0; i < states.frictions.size(); ++i) {
    const double w = sliding_velocity(system, static_cast<int>(i), X);
    states.frictions[i] = w > 0.0   ? mode::FrictionState::slip_plus
                          : w < 0.0 ? mode::FrictionState::slip_minus
                                    : mode::FrictionState::stick;
  }
  for (std::size_t i = 0; i < states.compliant.size(); ++i)
    if (depth(system, static_cast<int>(i), X) > 0.0) states.compliant[i] = mode::CompliantState::on;
  for (std::size_t i = 0; i < states.pieces.size(); ++i) states.pieces[i] = piece_at(system, static_cast<int>(i), X);
  return system.mode_id(states);
}

double row_product(const mode::RowVector& row, const double* X) {
  double sum = 0.0;
  for (Eigen::Index j = 0; j < row.size(); ++j) sum += row[j] * X[j];
  return sum;
}

int piece_at(const CompiledSystem& system, int characteristic, const double* X) {
  const auto& corners = system.frame().characteristics[static_cast<std::size_t>(characteristic)].corners;
  int piece = 0;
  while (piece < static_cast<int>(corners.size()) && row_product(corners[static_cast<std::size_t>(piece)], X) > 0.0)
    ++piece;
  return piece;
}

namespace {

/// A guard that does not fit: its kind, and its contact among all.
struct Unfit {
  mode::GuardKind kind;
  int contact;
};

/// @param in_order  of contacts that choose by themselves the lowest derivative speaks first, whether the mode is known
///                  or not: higher ones see more of other contacts
std::optional<Unfit> unfit_in(const CompiledSystem& system, const Choice& choice, bool in_order, const double* X,
                              const double* magnitude, std::span<int> orders) {
  const auto unfit = [&](const mode::Guard& guard) {
    return Unfit{guard.kind, mode::contact_index(guard.kind, guard.contact, system.model())};
  };
  const ModeId id = choice.id();
  const mode::Mode* const known = system.known_mode(id);
  if (known != nullptr && in_order) {
    const Linear mode{known->system(), known->system_size(), known->guards()};
    if (const mode::Guard* guard = falling_guard(mode, X, magnitude)) return unfit(*guard);
  } else if (known == nullptr && (in_order || (!system.few_modes() && !choice.only_one()))) {
    const auto outline = system.outline(id);
    const Linear mode{outline->system, outline->system_size, outline->guards};
    if (const mode::Guard* guard = falling_guard(mode, X, magnitude)) return unfit(*guard);
  }
  const mode::Guard* const guard = unfit_guard(known != nullptr ? *known : system.mode(id), X, magnitude, orders);
  return guard != nullptr ? std::optional(unfit(*guard)) : std::nullopt;
}

/// Principal pivoting (Murty 1974): from the first combination on the contact of a guard that does not fit goes over to
/// the state behind that guard, one after the other. Contacts that all change cost a step each, where the combinations
/// are a power. The steps may come to no end, and of several modes that fit they do not look for the fewest changes.
ModeId by_pivots(const CompiledSystem& system, const double* X, const double* magnitude, std::span<int> orders) {
  Choice choice(system, X, magnitude);
  const int most_steps = 4 * choice.contacts();
  for (int step = 0; step < most_steps; ++step) {
    const auto unfit = unfit_in(system, choice, true, X, magnitude, orders);
    if (!unfit) return choice.id();
    if (!choice.go_behind(unfit->kind, unfit->contact)) break;
  }
  return -1;
}

}  // namespace

ModeId select_mode(const CompiledSystem& system, const double* X, const double* magnitude, std::span<int> orders) {
  constexpr int many = 100;  // combinations; fewer give up the fewest changes, more cost time at each such instant
  Choice choice(system, X, magnitude);
  for (int tries = 1;; ++tries) {
    const auto unfit = unfit_in(system, choice, choice.in_groups(), X, magnitude, orders);
    if (!unfit) return choice.id();
    if (tries == many)
      if (const ModeId found = by_pivots(system, X, magnitude, orders); found >= 0) return found;
    if (!choice.next(unfit->contact)) return -1;
  }
}

}  // namespace slapstick::flow
