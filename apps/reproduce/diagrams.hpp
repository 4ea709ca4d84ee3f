#pragma once
/// Bifurcation diagrams along omega, as the figures of the study use them.
#include "reproduce/study.hpp"
#include "slapstick/sweep/diagram.hpp"

namespace slapstick::paper {

struct Range {
  double from, to;
  int values, impacts;
  int transient_periods = 500;
};

/// Up and down through the range, carrying the state. `share`: which part of the current part's progress this is.
/// @throws Interrupted
[[nodiscard]] sweep::Diagram diagram(const Study& study, const Overrides& with, const Range& range, int share = 0,
                                     int shares = 1);

}  // namespace slapstick::paper
