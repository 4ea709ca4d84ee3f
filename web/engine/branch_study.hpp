#pragma once
/// The branch of an orbit over a diagram, the branches that begin at its special points, and the curves of these in two
/// parameters: what `slapstick continue` and `slapstick curve` compute.
///
///     BranchStudy study(choice, wish);
///     study.branches(0);              // the first
///     study.follow_born(0, 2);        // what begins at the third special point of it
///     study.curve(0, 2, second);      // where that point is when a second parameter varies too
///
/// Each is one piece of work: a worker that must hear of a newer wish is ended, and its study is gone.
/// Results are objects for the page; the keys are those of web/src/protocol.ts. Errors as the library's.
#include <functional>
#include <memory>
#include <vector>

#include "choice.hpp"
#include "io/json.hpp"
#include "slapstick/continuation/branch.hpp"

namespace slapstick::web {

struct BranchWish {
  std::string parameter;
  double from = 0.0, to = 1.0;
  std::string shown = "w";  ///< as DiagramWish
  std::string at = "impacts";
};

/// A second parameter, and the ranges of both.
struct CurveWish {
  std::string second;
  double from = 0.0, to = 1.0, second_from = 0.0, second_to = 1.0;
};

/// What a diagram shows of an orbit: a number for each impact of a cycle, or for each of its periods.
class ShownOfOrbit {
 public:
  /// @throws InputError for what has no number at an impact or a period
  ShownOfOrbit(const Model& model, const BranchWish& wish);
  [[nodiscard]] std::vector<double> of(const orbit::Problem& problem, const orbit::Orbit& orbit) const;

 private:
  [[nodiscard]] double value(const std::vector<orbit::EventOfOrbit>& impacts, std::size_t i,
                             const orbit::Orbit& orbit) const;

  std::string shown_;
  bool by_periods_;
  int index_ = -1;  ///< in the state; -1: of impacts
};

class BranchStudy {
 public:
  using Progress = std::function<void(long points)>;

  /// Follows the orbit that the motion settles on.
  /// @param progress  called after every point of a branch or curve, here and later
  /// @throws NumericalError where the motion settles on no orbit
  BranchStudy(const Choice& choice, const BranchWish& wish, Progress progress);

  /// The branches from this one on.
  [[nodiscard]] Json branches(std::size_t first) const;
  /// Follows what begins at a special point. @returns the branches that were not known
  Json follow_born(std::size_t branch, std::size_t special);
  /// @throws InputError if the present value of the second parameter is out of range
  [[nodiscard]] Json curve(std::size_t branch, std::size_t special, const CurveWish& wish) const;

 private:
  [[nodiscard]] const orbit::SpecialPoint& point(std::size_t branch, std::size_t special) const;
  [[nodiscard]] Json branch_json(const orbit::Branch& branch) const;

  Choice choice_;
  System system_;
  ShownOfOrbit shown_;
  Progress progress_;
  orbit::ContinuationOptions how_;
  std::string parameter_;
  std::shared_ptr<const orbit::Problem> problem_;
  std::vector<orbit::Branch> branches_;
};

}  // namespace slapstick::web
