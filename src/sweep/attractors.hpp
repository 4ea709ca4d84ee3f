#pragma once
/// Which of the attractors of one system a motion has come to: the one place that says when two are the same.
///
///     Attractors known(system);
///     known.reach(start);
///     int place = known.find(found.attractor, found.label, found.state);
///     if (place < 0) place = known.add(found);
///
/// Two cycles are the same if one's state lies on the other: of a driven motion at one of its instants of phase 0, of a
/// free one where its next event is. Two states of rest are the same if their displacements are.
/// Of motions without a cycle, of members of a continuum and of what friction holds at rest the class is all that is
/// compared: the starts that end on one continuum are one set.
#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "flow/translations.hpp"
#include "slapstick/attractor/classify.hpp"

namespace slapstick::sweep {

class Attractors {
 public:
  explicit Attractors(const System& system);

  /// Notes a start: a motion leaves a place of rest to rounding of how far it has come.
  void reach(const State& start);
  /// @param state  on the attractor, as Classification::state
  /// @returns the place of the attractor; -1: none of them
  [[nodiscard]] int find(Attractor kind, std::string_view label, const State& state) const;
  /// @returns its place. @throws NumericalError as Motion::advance
  int add(const Classification& found);
  /// By how much each number of a state on a cycle may differ from those of the same one.
  /// @param place  as of find; not of those that are compared by class
  [[nodiscard]] const Eigen::VectorXd& tolerance(int place) const {
    return all_[static_cast<std::size_t>(place)].tolerance;
  }
  /// Is a class all that is compared? Then several attractors may have one place.
  [[nodiscard]] static bool by_class(const Classification& found);

 private:
  using Vector = Eigen::VectorXd;
  struct Known {
    Attractor kind;
    std::string label;
    bool by_class = false;
    std::vector<Vector> points{};  ///< of its section: contact states modulo translations
    Vector tolerance{};            ///< of each of their numbers; at rest of displacements
    double rate = 0.0;             ///< at rest: the largest modulus of an eigenvalue
    double cycle = 0.0;            ///< of a free cycle, in periods of the clock
  };

  [[nodiscard]] Vector point(const Motion& motion) const;
  [[nodiscard]] Vector on_section(const State& state, const Known& known) const;
  [[nodiscard]] bool same(const Known& known, const Vector& here) const;
  [[nodiscard]] double reach_at_rest(const Known& known) const;
  void follow(const Classification& found, Known& known) const;

  flow::Translations translations_;
  bool driven_;
  std::vector<Known> all_;
  State least_, most_;  ///< of each number of the starts
};

}  // namespace slapstick::sweep
