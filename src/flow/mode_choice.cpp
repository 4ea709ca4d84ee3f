/// What contacts offer at a state, and the order in which their combinations are tried.
#include "flow/mode_choice.hpp"

#include <algorithm>
#include <cmath>

#include "flow/mode_graph.hpp"

namespace slapstick::flow {
namespace {

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
    return std::abs(row_product(row, X)) <= 2.0 * rounding_of(row, magnitude);
  };
  const auto digit = static_cast<std::int16_t>(piece);
  if (piece < corners.size() && near(piece))
    return in_order(system, i, X, {{digit, static_cast<std::int16_t>(digit + 1)}, 2});
  if (piece > 0 && near(piece - 1)) return in_order(system, i, X, {{digit, static_cast<std::int16_t>(digit - 1)}, 2});
  return {{digit}, 1};
}

constexpr int no_load = 3, loaded = -1;  ///< of a friction contact; with a load it may stick or slip

/// The state of a contact behind the zero of its guard.
/// @param digit  its state before
int digit_behind(mode::GuardKind guard, int digit) {
  using enum mode::GuardKind;
  switch (guard) {
    case press:
    case leave:
    case stick_below:
      return 0;
    case gap:
    case slip:
    case engage:
    case push:
    case beyond:
      return 1;
    case let_go:
    case stick_above:
      return 2;
    case bound:
      return 3;
    case load:
      return no_load;
    case unloaded:
      return loaded;
    case corner_above:
      return digit + 1;
    case corner_below:
      return digit - 1;
  }
  return digit;
}

}  // namespace

Choice::Choice(const CompiledSystem& system, const double* X, const double* magnitude) : system_(system) {
  const Model& model = system.model();
  place_.fill(-1);
  for (int i = 0; i < static_cast<int>(model.stops.size()); ++i)
    add(stop_candidates(gap(system, i, X), approach_velocity(system, i, X)), 2);
  for (int i = 0; i < static_cast<int>(model.frictions.size()); ++i)
    add(friction_candidates(sliding_velocity(system, i, X), model.frictions[i].normal.has_value()),
        system.friction_states(static_cast<std::size_t>(i)), sliding_velocity(system, i, X) != 0.0);
  for (int i = 0; i < static_cast<int>(model.compliant_stops.size()); ++i)
    add(compliant_candidates(depth(system, i, X), model.compliant_stops[i]),
        system.compliant_states(static_cast<std::size_t>(i)), model.compliant_stops[i].bounded);
  for (int i = 0; i < static_cast<int>(model.characteristics.size()); ++i)
    add(piece_candidates(system, i, X, magnitude), static_cast<int>(model.characteristics[i].corners.size()) + 1, true);
}

void Choice::add(const Candidates& candidates, int base, bool crosses) {
  const int contact = count_++;
  offered_[contact] = candidates;
  crosses_[contact] = crosses;
  choice_[contact] = 0;
  stride_[contact] = next_stride_;
  next_stride_ *= base;
  if (candidates.count > 1) list(contact, system_.group(contact));
}

/// Puts a contact with something to choose into a group.
void Choice::list(int contact, int name) {
  if (place_[name] < 0) {
    place_[name] = static_cast<std::int8_t>(groups_);
    Group& begun = group_[groups_++];
    begun.several_count = begun.changes = begun.crossed_count = 0;
  }
  Group& group = group_[place_[name]];
  const auto number = static_cast<std::int8_t>(contact);
  if (crosses_[contact])
    group.crossed[group.crossed_count++] = number;
  else
    group.several[group.several_count++] = number;
}

ModeId Choice::id() const {
  ModeId id = 0;
  for (int c = 0; c < count_; ++c) id += stride_[c] * offered_[c].digit[choice_[c]];
  return id;
}

bool Choice::next(int contact) {
  if (groups_ == 0) return false;
  if (groups_ == 1) return next(group_[0]);
  const int place = place_[system_.group(contact)];
  if (place < 0 || !next(group_[place])) join();
  return true;
}

bool Choice::go_behind(mode::GuardKind guard, int contact) {
  const Candidates& offered = offered_[contact];
  const int wanted = digit_behind(guard, offered.digit[choice_[contact]]);
  for (std::int8_t k = 0; k < offered.count; ++k) {
    if (wanted == loaded ? offered.digit[k] == no_load : offered.digit[k] != wanted) continue;
    choice_[contact] = k;
    return true;
  }
  return false;
}

/// All contacts are one group, at its first combination.
void Choice::join() {
  groups_ = 0;
  place_.fill(-1);
  for (int contact = 0; contact < count_; ++contact) {
    choice_[contact] = 0;
    if (offered_[contact].count > 1) list(contact, 0);
  }
}

bool Choice::next(Group& group) {
  if (next_side(group) || next_digits(group)) return true;
  if (!next_changed(group)) return false;
  for (int k = 0; k < group.changes; ++k) choice_[group.several[group.changed[k]]] = 1;
  return true;
}

bool Choice::next_side(const Group& group) {
  for (int k = group.crossed_count - 1; k >= 0; --k) {
    const int c = group.crossed[k];
    if (++choice_[c] < offered_[c].count) return true;
    choice_[c] = 0;
  }
  return false;
}

/// The next choice of the contacts that differ, among their candidates after the first.
bool Choice::next_digits(const Group& group) {
  for (int k = group.changes - 1; k >= 0; --k) {
    const int c = group.several[group.changed[k]];
    if (++choice_[c] < offered_[c].count) return true;
    choice_[c] = 1;
  }
  return false;
}

/// The next set of contacts that differ: of the same size in the order of their numbers, then of one more.
bool Choice::next_changed(Group& group) {
  for (int k = 0; k < group.changes; ++k) choice_[group.several[group.changed[k]]] = 0;
  int k = group.changes - 1;
  while (k >= 0 && group.changed[k] == group.several_count - group.changes + k) --k;
  if (k < 0) {
    if (++group.changes > group.several_count) return false;
    for (int i = 0; i < group.changes; ++i) group.changed[i] = static_cast<std::int8_t>(i);
    return true;
  }
  ++group.changed[k];
  for (int i = k + 1; i < group.changes; ++i) group.changed[i] = static_cast<std::int8_t>(group.changed[i - 1] + 1);
  return true;
}

}  // namespace slapstick::flow
