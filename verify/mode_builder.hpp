#pragma once
/// One combination of contact states as a linear system, with all that the laws demand of it.
///
/// Slip: the force s f_k N against the motion, N the normal force or 1. Compliant stops that act: stiffness delta +
/// damping delta', or 2 stiffness delta where that is less. Polylines: the force of their piece. Contacts that hold:
/// forces f with u' = 0 on their pairs, f = (G B G^T)^-1 G a, B = W M^-1 W^T. Which pairs depend on others is read off
/// the graph whose edges are the pairs: no number is compared with zero.
#include "mechanics.hpp"

namespace verify {

class ModeBuilder {
 public:
  ModeBuilder(Mechanics& mechanics, const ContactStates& states);
  Mode build();

 private:
  /// Contacts that hold one pair, by one force along its number.
  struct Held {
    std::size_t number;
    std::vector<std::size_t> stops, frictions;
  };

  void slipping();
  void springs();
  void gather_held();
  void hold();
  void share_forces(const std::vector<std::size_t>& tree);
  void motion_conditions();
  void compliant_conditions();
  void force_conditions();
  void corners();
  void demand(Condition::Kind kind, std::size_t contact, const std::string& name, Balls row);
  Held& held_pair(std::size_t number);
  [[nodiscard]] Balls unit(std::size_t column, double value) const;
  [[nodiscard]] Balls force_of(std::size_t compliant) const;
  [[nodiscard]] Balls excess_of_spring(std::size_t compliant) const;
  [[nodiscard]] Balls acting_force_of(std::size_t compliant) const;
  [[nodiscard]] Balls load_of(std::size_t friction) const;
  void load_conditions();
  [[nodiscard]] Balls force_of_piece(const Polyline& line, int piece) const;
  void push(std::size_t number, const Ball& factor, const Balls& force);

  Mechanics& m_;
  const ContactStates& states_;
  std::vector<Held> held_;
  Matrix acceleration_;  ///< u', rows over X
  Matrix force_;         ///< f of each held pair, rows over X
  Mode mode_;
};

}  // namespace verify
