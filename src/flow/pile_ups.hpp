#pragma once
/// What the pile-ups of one instant have taught: a set of stops that one impact has disturbed, and that came to rest by
/// impacts of its own without end, does so again when the same stop disturbs it again.
///
/// From rest the velocities of the set are proportional to the impulse that disturbs it, and so is all that follows:
/// the law is homogeneous where no restitution depends on the speed. So the limit is taken at once the second time.
/// Without this each impact of the fourth body of a row would cost the second and third the impacts of a whole pile-up.
/// Each of the fifth would cost those of the fourth, and so on.
#include <array>
#include <cstdint>

namespace slapstick::flow {

class PileUps {
 public:
  void forget() { count_ = 0; }

  /// These stops have got an impulse.
  void strike(std::uint32_t stops) {
    for (int i = 0; i < count_; ++i) {
      const std::uint32_t others = stops & ~piles_[i].stops;
      if (others != 0) piles_[i].disturbed_by = piles_[i].disturbed_by == 0 && single(others) ? others : many;
    }
  }

  /// These stops have come to rest together. @param scales  whether no restitution of theirs depends on the speed
  void rest(std::uint32_t stops, bool scales) {
    bool known = false;
    for (int i = 0; i < count_; ++i) {
      Pile& pile = piles_[i];
      if (pile.stops == stops && single(pile.disturbed_by)) pile.taught |= pile.disturbed_by;
      known = known || pile.stops == stops;
      if ((pile.stops & ~stops) == 0)
        pile.disturbed_by = 0;
      else if ((stops & ~pile.stops) != 0)
        pile.disturbed_by = many;
    }
    if (!known && scales && count_ < static_cast<int>(piles_.size())) piles_[count_++] = {stops, 0, 0};
  }

  /// The largest set with this stop that is known to come to rest after what has disturbed it; else 0.
  [[nodiscard]] std::uint32_t known(int stop) const {
    std::uint32_t best = 0;
    for (int i = 0; i < count_; ++i) {
      const Pile& pile = piles_[i];
      const bool holds =
          (pile.stops >> stop & 1U) != 0 && pile.disturbed_by != many && (pile.disturbed_by & pile.taught) != 0;
      if (holds && (best & ~pile.stops) == 0) best = pile.stops;
    }
    return best;
  }

 private:
  static constexpr std::uint32_t many = ~std::uint32_t{0};  ///< more than one impact
  [[nodiscard]] static bool single(std::uint32_t stops) {
    return stops != 0 && stops != many && (stops & (stops - 1)) == 0;
  }

  struct Pile {
    std::uint32_t stops = 0;
    std::uint32_t disturbed_by = 0;  ///< the stop outside of it that was struck since it rested: its bit
    std::uint32_t taught = 0;        ///< the stops after whose impacts it has come to rest
  };
  std::array<Pile, 16> piles_{};
  int count_ = 0;
};

}  // namespace slapstick::flow
