/// Chooses the mode that may start at a state, by the order of each guard's zero there.
#include "flow/mode_graph.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace slapstick::flow {
namespace {

/// The state where a guard was located carries the error of its root as well as its own rounding.
constexpr double rest_factor = 8.0;

/// A number that is far above the smallest ones, times any window.
constexpr double no_underflow = 0x1p-900;

/// Those that Mode::leading gives. Higher ones are looked at only where these vanish.
constexpr int leading_orders = 8;

constexpr int most_contacts = System::most_contacts;

/// What one contact offers, as digits of a mode id (stop: open 0, closed 1; friction: slip- 0, stick 1, slip+ 2,
/// unloaded 3; compliant: off 0, on 1, detached 2, bounded 3; characteristic: its piece, up to 200).
struct Candidates {
  std::array<std::int16_t, 4> digit;
  std::int8_t count;
};

/// In tables: a copy of what was just written in parts would wait for the parts.
const Candidates& friction_candidates(double w, bool can_unload) {
  static constexpr Candidates forward[] = {{{2}, 1}, {{2, 3}, 2}}, backward[] = {{{0}, 1}, {{0, 3}, 2}},
                              resting[] = {{{1, 2, 0}, 3}, {{1, 2, 0, 3}, 4}};
  return (w > 0.0 ? forward : w < 0.0 ? backward : resting)[can_unload ? 1 : 0];
}

const Candidates& stop_candidates(double gap, double approach) {
  static constexpr Candidates open = {{0}, 1}, touching = {{1, 0}, 2};
  return gap == 0.0 && approach == 0.0 ? touching : open;
}

Candidates compliant_candidates(double depth, const CompliantStop& stop) {
  const bool can_detach = !stop.pulls && stop.damping > 0.0;
  if (depth < 0.0) return {{0}, 1};
  if (can_detach && stop.bounded) return depth == 0.0 ? Candidates{{0, 3, 2, 1}, 4} : Candidates{{1, 3, 2}, 3};
  if (depth == 0.0) return can_detach ? Candidates{{0, 1, 2}, 3} : Candidates{{0, 1}, 2};
  return can_detach ? Candidates{{1, 2}, 2} : Candidates{{1}, 1};
}

/// A slider at its limit slips if the pair goes on beyond the limit, and rests if not, as where the pair is held.
Candidates in_order(const CompiledSystem& system, int i, const double* X, Candidates found) {
  const mode::SliderRow* const slider = system.frame().slider(i);
  if (slider == nullptr) return found;
  const double velocity = slider->pair.sign * X[system.frame().u(slider->pair.own)];
  const bool high = std::max(found.digit[0], found.digit[1]) == 2, slips = high ? velocity > 0.0 : velocity < 0.0;
  if ((found.digit[0] != 1) != slips) std::swap(found.digit[0], found.digit[1]);
  return found;
}

/// At a corner, within twice the bound that `start_order` allows, also the piece on its other side.
Candidates piece_candidates(const CompiledSystem& system, int i, const double* X, const double* magnitude) {
  const auto& corners = system.frame().characteristics[static_cast<std::size_t>(i)].corners;
  const auto piece = static_cast<std::size_t>(piece_at(system, i, X));
  const auto near = [&](std::size_t corner) {
    const mode::RowVector& row = corners[corner];
    double size = 0.0;
    for (Eigen::Index j = 0; j < row.size(); ++j) size += std::abs(row[j]) * magnitude[j];
    const double noise = mode::Mode::noise_factor_of(static_cast<int>(row.size())) * size;
    return std::abs(row_product(row, X)) <= 2.0 * rest_factor * noise;
  };
  const auto digit = static_cast<std::int16_t>(piece);
  if (piece < corners.size() && near(piece))
    return in_order(system, i, X, {{digit, static_cast<std::int16_t>(digit + 1)}, 2});
  if (piece > 0 && near(piece - 1)) return in_order(system, i, X, {{digit, static_cast<std::int16_t>(digit - 1)}, 2});
  return {{digit}, 1};
}

/// A normal force that is zero for good, as that of a brake that is off, presses nothing: its contact is unloaded.
bool fits(const mode::Mode& mode, const double* X, const double* magnitude, std::span<int> orders) {
  for (int g = 0; g < mode.guard_count(); ++g) {
    orders[g] = start_order(mode, g, X, magnitude);
    const bool presses_never = orders[g] == never && mode.guards()[g].kind == mode::GuardKind::load;
    if (orders[g] == negative || presses_never) return false;
  }
  return true;
}

/// False if a guard of the mode certainly starts downwards: by its value, or by a derivative where all before are
/// exactly zero. For modes without operators; a rounding bound that is more than theirs. So it refuses nothing that
/// `fits` would take, and which mode is chosen does not depend on which ones were built before.
bool may_fit(const mode::Outline& outline, const double* X, const double* magnitude) {
  constexpr double roundings = 64.0 * event::unit_roundoff;
  bool zero_found = false;
  for (const mode::Guard& guard : outline.guards) {
    const double value = guard.at(X);
    if (value < -roundings * static_cast<double>(outline.system.rows()) * guard.size(magnitude)) return false;
    zero_found = zero_found || value == 0.0;
  }
  if (!zero_found) return true;
  const auto m = outline.system.rows();
  mode::Vector term = Eigen::Map<const mode::Vector>(X, m), size = Eigen::Map<const mode::Vector>(magnitude, m);
  std::vector<const mode::Guard*> open;  // those that start with a zero
  for (const mode::Guard& guard : outline.guards) open.push_back(&guard);
  for (int n = 0;; ++n) {
    std::vector<const mode::Guard*> zero;
    for (const mode::Guard* guard : open) {
      const double value = guard->row.dot(term);
      const double noise = roundings * static_cast<double>(m) * guard->row.cwiseAbs().dot(size);
      if (value < -noise) return false;
      if (value == 0.0) zero.push_back(guard);
    }
    if (zero.empty() || n == 2) return true;
    open.swap(zero);
    term = outline.system * term;
    size = outline.system_size * size;
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

double rounding_of(const mode::Mode& mode, const mode::Guard& guard, const double* magnitude) {
  return rest_factor * mode.noise_factor() * guard.size(magnitude);
}

int start_order(const mode::Mode& mode, int guard, const double* X, const double* magnitude, int known) {
  const mode::Guard& h = mode.guards()[guard];
  if (known == 0) {
    const double value = h.single >= 0 ? h.factor * X[h.single] : h.at(X);
    const double bound = h.single >= 0 ? 0.0 : rounding_of(mode, h, magnitude);
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

namespace {

/// What every contact offers at X, in the order of the digits of a mode id.
class Choice {
 public:
  Choice(const CompiledSystem& system, const double* X, const double* magnitude) {
    const Model& model = system.model();
    for (int i = 0; i < static_cast<int>(model.stops.size()); ++i)
      add(stop_candidates(gap(system, i, X), approach_velocity(system, i, X)), 2);
    for (int i = 0; i < static_cast<int>(model.frictions.size()); ++i)
      add(friction_candidates(sliding_velocity(system, i, X), model.frictions[i].normal.has_value()),
          system.friction_states(static_cast<std::size_t>(i)), sliding_velocity(system, i, X) != 0.0);
    for (int i = 0; i < static_cast<int>(model.compliant_stops.size()); ++i)
      add(compliant_candidates(depth(system, i, X), model.compliant_stops[i]),
          system.compliant_states(static_cast<std::size_t>(i)), model.compliant_stops[i].bounded);
    for (int i = 0; i < static_cast<int>(model.characteristics.size()); ++i)
      add(piece_candidates(system, i, X, magnitude), static_cast<int>(model.characteristics[i].corners.size()) + 1,
          true);
  }

  [[nodiscard]] ModeId id() const {
    ModeId id = 0;
    for (int c = 0; c < count_; ++c) id += stride_[c] * offered_[c].digit[choice_[c]];
    return id;
  }

  /// The next combination: those in which few contacts differ from what they prefer come first, each with all sides of
  /// the lines that are being crossed: a corner is no reason to let go. False if there is no further one.
  bool next() {
    if (next_side() || next_digits()) return true;
    if (!next_changed()) return false;
    for (int k = 0; k < changes_; ++k) choice_[several_[changed_[k]]] = 1;
    return true;
  }

  [[nodiscard]] bool only_one() const { return several_count_ == 0 && crossed_count_ == 0; }

 private:
  /// @param crosses  whether its candidates are the sides of a line (see mode::of_crossing)
  void add(const Candidates& candidates, int base, bool crosses = false) {
    if (candidates.count > 1) (crosses ? crossed_[crossed_count_++] : several_[several_count_++]) = count_;
    offered_[count_] = candidates;
    choice_[count_] = 0;
    stride_[count_++] = next_stride_;
    next_stride_ *= base;
  }

  bool next_side() {
    for (int k = crossed_count_ - 1; k >= 0; --k) {
      const int c = crossed_[k];
      if (++choice_[c] < offered_[c].count) return true;
      choice_[c] = 0;
    }
    return false;
  }

  /// The next choice of the contacts that differ, among their candidates after the first.
  bool next_digits() {
    for (int k = changes_ - 1; k >= 0; --k) {
      const int c = several_[changed_[k]];
      if (++choice_[c] < offered_[c].count) return true;
      choice_[c] = 1;
    }
    return false;
  }

  /// The next set of contacts that differ: of the same size in the order of their numbers, then of one more.
  bool next_changed() {
    for (int k = 0; k < changes_; ++k) choice_[several_[changed_[k]]] = 0;
    int k = changes_ - 1;
    while (k >= 0 && changed_[k] == several_count_ - changes_ + k) --k;
    if (k < 0) {
      if (++changes_ > several_count_) return false;
      for (int i = 0; i < changes_; ++i) changed_[i] = i;
      return true;
    }
    ++changed_[k];
    for (int i = k + 1; i < changes_; ++i) changed_[i] = changed_[i - 1] + 1;
    return true;
  }

  std::array<Candidates, most_contacts> offered_;
  std::array<int, most_contacts> several_;  ///< contacts with more than one candidate
  std::array<int, most_contacts> changed_;  ///< those of `several_` that do not have their first, ascending
  std::array<int, most_contacts> crossed_;  ///< contacts at a line that is being crossed
  int several_count_ = 0, changes_ = 0, crossed_count_ = 0;
  std::array<ModeId, most_contacts> stride_;
  std::array<int, most_contacts> choice_;
  ModeId next_stride_ = 1;
  int count_ = 0;
};

}  // namespace

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

ModeId select_mode(const CompiledSystem& system, const double* X, const double* magnitude, std::span<int> orders) {
  Choice choice(system, X, magnitude);
  do {
    const ModeId id = choice.id();
    const mode::Mode* known = system.known_mode(id);
    if (known == nullptr && !system.few_modes() && !choice.only_one() && !may_fit(*system.outline(id), X, magnitude))
      continue;
    if (fits(known != nullptr ? *known : system.mode(id), X, magnitude, orders)) return id;
  } while (choice.next());
  return -1;
}

}  // namespace slapstick::flow
