#pragma once
/// The combinations of contact states that may start at a state, in order of preference. What each contact offers is
/// the table of flow/mode_graph.hpp.
///
/// Contacts of different groups (CompiledSystem::group) choose by themselves: where one does not fit its group alone
/// goes on. So k contacts that change at one instant without acting on each other cost a multiple of k combinations,
/// not a power. Where a group has no further combination, as where a derivative of higher order sees another group,
/// all contacts choose as one group, from the first combination on.
#include <array>

#include "flow/compiled_system.hpp"

namespace slapstick::flow {

/// What one contact offers, as digits of a mode id (stop: open 0, closed 1; friction: slip- 0, stick 1, slip+ 2,
/// unloaded 3; compliant: off 0, on 1, detached 2, bounded 3; characteristic: its piece, up to 200).
struct Candidates {
  std::array<std::int16_t, 4> digit;
  std::int8_t count;
};

class Choice {
 public:
  Choice(const CompiledSystem& system, const double* X, const double* magnitude);

  [[nodiscard]] ModeId id() const;
  /// The next combination of the group of a contact. False if there is no further one.
  bool next(int contact);
  /// The contact goes over to the state behind a guard of its own. False if that is not offered.
  bool go_behind(mode::GuardKind guard, int contact);
  [[nodiscard]] int contacts() const { return count_; }
  [[nodiscard]] bool only_one() const { return groups_ == 0; }
  /// Are there several groups with something to choose?
  [[nodiscard]] bool in_groups() const { return groups_ > 1; }

 private:
  /// The combinations of one group. Those in which few contacts differ from what they prefer come first, each with all
  /// sides of the lines that are being crossed: a corner is no reason to let go.
  struct Group {
    std::array<std::int8_t, System::most_contacts> several;  ///< contacts with more than one candidate
    std::array<std::int8_t, System::most_contacts> changed;  ///< of `several`, without their first candidate; ascending
    std::array<std::int8_t, System::most_contacts> crossed;  ///< contacts at a line that is being crossed
    int several_count, changes, crossed_count;
  };

  void add(const Candidates& candidates, int base, bool crosses = false);
  void list(int contact, int name);
  void join();
  bool next(Group& group);
  bool next_side(const Group& group);
  bool next_digits(const Group& group);
  bool next_changed(Group& group);

  const CompiledSystem& system_;
  std::array<Candidates, System::most_contacts> offered_;
  std::array<bool, System::most_contacts> crosses_;  ///< are the candidates the sides of a line (mode::of_crossing)?
  std::array<ModeId, System::most_contacts> stride_;
  std::array<std::int8_t, System::most_contacts> choice_;
  std::array<Group, System::most_contacts> group_;  ///< the first `groups_` of them, which have something to choose
  std::array<std::int8_t, System::most_contacts> place_;  ///< of a group among them by its name, or -1
  int groups_ = 0;
  ModeId next_stride_ = 1;
  int count_ = 0;
};

}  // namespace slapstick::flow
