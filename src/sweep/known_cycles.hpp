#pragma once
/// Cycles of one model that are known before a motion begins, and how a motion is seen to come to one of them.
///
///     KnownCycles cycles(system, options);
///     cycles.add(finding, state);                 // of a first look, pixel by pixel
///     KnownCycles::Watch watch(cycles);
///     const Classification* found = watch.see(x);  // at every point of the section
///
/// Distances are in units in which two cycles are one at 1e-6 (attractors.hpp): each number counts by its own range
/// over the cycle. A trial begins where a motion comes within 0.05 of the cycle. The motion belongs to the cycle once
/// both hold: its distance has fallen a thousandfold, or to rounding; and in each stage before, the motion has lost
/// what a motion loses that is drawn (section/approach.hpp). After a stage that loses less a new trial begins.
/// Newton's method has confirmed the cycle once; no motion asks it again.
/// Cost: a motion's point is compared with one point of each cycle, some nanoseconds each.
#include <vector>

#include "section/approach.hpp"
#include "slapstick/sweep/map.hpp"
#include "sweep/attractors.hpp"

namespace slapstick::sweep {

class KnownCycles {
 public:
  /// @param options  whose stops count; must live as long
  KnownCycles(const System& system, const ClassifyOptions& options);

  /// Notes the cycle that a motion has come to. Left out are cycles that are noted already, free ones, and those
  /// beside which no linear map says how fast motions come: of a continuum, at a graze, or with another class at
  /// Newton's point than the motion found.
  /// @param state  on the cycle, as Classification::state
  void add(const Finding& found, const State& state);
  [[nodiscard]] std::size_t size() const { return all_.size(); }

  /// One motion.
  class Watch {
   public:
    explicit Watch(const KnownCycles& cycles) : cycles_(cycles), trials_(cycles.all_.size()) {}
    /// @param x  the motion's contact state at the next point of the section
    /// @returns what it has come to; null: nothing known yet
    const Classification* see(const Eigen::Ref<const Eigen::VectorXd>& x);
    /// Is it beside a cycle, and no stage there has lost too little? Then nothing else needs to be looked for.
    [[nodiscard]] bool beside() const;

   private:
    struct Trial {
      bool runs = false;
      bool doubted = false;  ///< a stage has lost too little
      long since = 0;        ///< the point at which the stage began
      section::Approach::Look before{};
      double there = 0.0;  ///< distance at which the trial ends
    };
    [[nodiscard]] bool comes(std::size_t cycle, const Eigen::Ref<const Eigen::VectorXd>& x);

    const KnownCycles& cycles_;
    std::vector<Trial> trials_;
    long points_ = 0;
  };

 private:
  struct Known {
    section::Approach approach;
    int n;
    Classification found;
  };

  const System& system_;
  const ClassifyOptions& options_;
  section::Stroboscopic map_;
  Attractors attractors_;
  bool driven_;
  std::vector<Known> all_;
};

}  // namespace slapstick::sweep
