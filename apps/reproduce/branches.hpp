#pragma once
/// Beyond the paper: the branches of n-1 orbits continued through stability and instability, what bounds its windows,
/// and how friction moves that.
#include "reproduce/claim.hpp"
#include "reproduce/study.hpp"
#include "slapstick/continuation/branch.hpp"

namespace slapstick::paper {

/// The branch of n-1 orbits along omega.
struct NBranch {
  int n = 1;
  orbit::Branch branch;
  std::vector<std::vector<double>> speeds;  ///< of the impacts of each point
};

/// A bound of the 1-1 or 2-1 window as a curve over omega and friction.
struct BoundCurve {
  std::string label;  ///< "1-1, PD"
  orbit::Curve curve;
};

struct Branches {
  std::vector<NBranch> all;      ///< n = 1 to 5
  std::vector<NBranch> doubled;  ///< of the doublings that end the windows of n = 1 to 3, and of their doublings
  std::vector<BoundCurve> bounds;
};

/// Runs them in parallel, in the present part of the course and two more. @throws Interrupted
[[nodiscard]] Branches make_branches(const Study& study);

void fig_branches(Study& study, const Branches& branches);  ///< over the brute-force diagram
void fig_bounds(Study& study, const Branches& branches);    ///< in the (omega, friction) plane

/// Every special point, and the type of what bounds each window.
[[nodiscard]] Claim claim_branches(const Study& study, const Branches& branches);
[[nodiscard]] Claim claim_bounds(const Study& study, const Branches& branches);

}  // namespace slapstick::paper
