/// Which guards of a shorter orbit are zero where legs of the longer one have died.
#include "change/touches.hpp"

#include <algorithm>
#include <cmath>

#include "base/ranges.hpp"
#include "orbit/leg_flow.hpp"

namespace slapstick::orbit {
namespace {

using mode::FrictionState;
using mode::GuardKind;

/// Dying legs next to each other: the first, and how many; both modulo the number of legs.
struct DyingRun {
  std::size_t first, count;
};

std::vector<DyingRun> runs(const std::vector<bool>& dying) {
  const std::size_t legs = dying.size();
  std::vector<DyingRun> all;
  for (std::size_t i = 0; i < legs; ++i) {
    if (!dying[i] || dying[(i + legs - 1) % legs]) continue;
    std::size_t count = 1;
    while (dying[(i + count) % legs] && count < legs) ++count;
    all.push_back({i, count});
  }
  return all;
}

/// Is the contact of a guard in one state in both?
bool same_state(const mode::ContactStates& a, const mode::ContactStates& b, GuardKind kind, int contact) {
  const auto i = static_cast<std::size_t>(contact);
  if (mode::of_friction(kind) || mode::of_load(kind)) return a.frictions[i] == b.frictions[i];
  if (mode::of_corner(kind)) return a.pieces[i] == b.pieces[i];
  if (kind == GuardKind::gap || kind == GuardKind::press) return a.stops[i] == b.stops[i];
  return a.compliant[i] == b.compliant[i];
}

class Search {
 public:
  Search(const ModeSet& set, const Orbit& near, const Shortened& shorter) : set_(set), near_(near), shorter_(shorter) {}

  /// @returns a touch without guards if nothing is left
  [[nodiscard]] Touch touch(const DyingRun& run) const {
    const std::size_t legs = near_.legs();
    Touch touch;
    const Orbit& left = shorter_.orbit;
    for (std::size_t e = 0; e < shorter_.starts.size(); ++e) {  // an event that stays
      const std::size_t off = (shorter_.starts[e] + legs - run.first) % legs;
      if (off > run.count) continue;
      const std::size_t before = (e + left.legs() - 1) % left.legs();
      touch = at({Touch::Place::end, before, left.t[before + 1], {}}, run);
      if (touch.guards.empty()) touch = at({Touch::Place::start, e, left.t[e], {}}, run);
      return touch;
    }
    if (shorter_.starts.empty()) {
      const double t = near_.t[run.first];
      return at({Touch::Place::within, 0, t - std::floor(t / left.shape.n) * left.shape.n, {}}, run);
    }
    for (std::size_t back = 1; back < legs; ++back) {
      const std::size_t start = (run.first + legs - back) % legs;
      const auto leg = ranges::find(shorter_.starts, start);
      if (leg == shorter_.starts.end()) continue;
      const auto i = static_cast<std::size_t>(leg - shorter_.starts.begin());
      double after = near_.t[run.first] - near_.t[start];
      if (after < 0.0) after += near_.t.back() - near_.t.front();
      return at({Touch::Place::within, i, left.t[i] + after, {}}, run);
    }
    return touch;
  }

 private:
  [[nodiscard]] const std::vector<mode::Guard>& guards_of(const Touch& touch) const {
    return set_.mode(shorter_.orbit.shape.legs[touch.leg].states).outline.guards;
  }

  void add(GuardKind kind, int contact, Touch& touch) const {
    const auto is = [&](const auto& guard) { return guard.kind == kind && guard.contact == contact; };
    const Leg& leg = shorter_.orbit.shape.legs[touch.leg];
    const Leg& before = shorter_.orbit.shape.legs[(touch.leg + shorter_.orbit.legs() - 1) % shorter_.orbit.legs()];
    const Leg& event = touch.place == Touch::Place::start ? before : leg;  // at whose end
    const bool stays = touch.place != Touch::Place::within && event.kind == kind && event.contact == contact;
    if (!stays && ranges::any_of(guards_of(touch), is) && ranges::none_of(touch.guards, is))
      touch.guards.push_back({kind, contact});
  }

  /// The limit of the holding force that is nearer.
  void add_limit(int contact, Touch& touch) const {
    const Orbit& orbit = shorter_.orbit;
    const Eigen::VectorXd X = state_within(set_, orbit, touch.leg, touch.t - orbit.t[touch.leg]);
    const mode::Guard* least = nullptr;
    for (const mode::Guard& guard : guards_of(touch)) {
      const bool limit = guard.kind == GuardKind::stick_above || guard.kind == GuardKind::stick_below;
      if (!limit || guard.contact != contact) continue;
      if (least == nullptr || guard.row.dot(X) < least->row.dot(X)) least = &guard;
    }
    if (least != nullptr) add(least->kind, contact, touch);
  }

  [[nodiscard]] Touch at(Touch touch, const DyingRun& run) const {
    const std::size_t legs = near_.legs();
    const mode::ContactStates& left = shorter_.orbit.shape.legs[touch.leg].states;
    for (std::size_t k = 0; k <= run.count; ++k) {
      const Leg& before = near_.shape.legs[(run.first + legs + k - 1) % legs];
      if (before.ending == Ending::guard && same_state(before.states, left, before.kind, before.contact))
        add(before.kind, before.contact, touch);
      if (k == run.count || before.ending != Ending::guard || before.kind != GuardKind::slip) continue;
      const Leg& slip = near_.shape.legs[(run.first + k) % legs];
      const auto contact = static_cast<std::size_t>(before.contact);
      if (slip.states.frictions[contact] != FrictionState::stick && left.frictions[contact] == FrictionState::stick)
        add_limit(before.contact, touch);
    }
    return touch;
  }

  const ModeSet& set_;
  const Orbit& near_;
  const Shortened& shorter_;
};

}  // namespace

std::optional<std::vector<Touch>> touches(const ModeSet& set, const Orbit& near, const std::vector<bool>& dying,
                                          const Shortened& shorter) {
  const Search search(set, near, shorter);
  std::vector<Touch> all;
  for (const DyingRun& run : runs(dying)) {
    all.push_back(search.touch(run));
    if (all.back().guards.empty()) return std::nullopt;
  }
  return all;
}

}  // namespace slapstick::orbit
