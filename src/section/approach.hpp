#pragma once
/// How a motion that is drawn to a cycle comes nearer.
///
/// Let x* be a fixed point of the map of one cycle, J its Jacobian there, and w the left eigenvector of the multiplier
/// mu of largest modulus. In the linear part of the map the amplitude a_k = |w . (x_k - x*)| falls by |mu| each cycle,
/// however other directions fall. After M cycles a motion that is drawn has lost
///     a_0 - a_M = a_0 (1 - |mu|^M) (1 + O(a_0^2 / (1 - |mu|)));
/// beside an orbit that repels and bounds the basin the loss is smaller and changes its sign there, on an invariant
/// curve it is zero. So half of the linear loss is asked for. Round a cycle with complex multipliers a curve may lie
/// between the motion and the cycle: farther away than 1e-2 of its size the motion may lose no more than twice as much.
/// A stage lasts until the amplitude should have halved. One such loss may be chance: a chaotic motion comes nearer now
/// and then. Who asks looks at several stages.
#include "section/return_map.hpp"

namespace slapstick::section {

/// No stage lasts longer, points of the section.
inline constexpr double longest_trial = 256.0;

class Approach {
 public:
  /// @param n  points of the section in the cycle: of a driven motion forcing periods
  /// @param scale  unit of each number, as of section::distance: the size of the motion, or own ranges
  Approach(const flow::Translations& translations, const FixedPoint& cycle, int n, const Eigen::VectorXd& scale);

  /// What is seen of a motion at a point.
  struct Look {
    double distance = 0.0;   ///< from the cycle, relative to the size
    double amplitude = 0.0;  ///< along the slowest direction
  };
  /// @param x  representative of its class (flow/translations.hpp)
  [[nodiscard]] Look at(const Eigen::VectorXd& x) const;
  [[nodiscard]] double distance(const Eigen::Ref<const Eigen::VectorXd>& x) const;

  /// Points of a stage.
  [[nodiscard]] long stage() const { return stage_; }
  /// Has a motion lost in one stage what a motion loses that is drawn to the cycle?
  /// @param there  distance below which the motion is at the cycle
  [[nodiscard]] bool loses(const Look& before, const Look& after, double there) const;

 private:
  const flow::Translations& translations_;
  Eigen::VectorXd x_, scale_, numbers_;  ///< of the cycle; numbers: of x without free displacements
  Eigen::VectorXcd w_;                   ///< of norm 1 over |x_i| <= scale_i
  double left_ = 1.0;                    ///< of an amplitude after a stage, in the linear part of the map
  bool turns_ = false;                   ///< the slowest multiplier is complex
  long stage_ = 2;
};

}  // namespace slapstick::section
