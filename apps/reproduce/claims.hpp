#pragma once
/// The claims C1 to C9, the comparison with the print, and coexisting attractors: what is computed and how it is
/// judged.
#include <optional>

#include "reproduce/claim.hpp"
#include "reproduce/window.hpp"

namespace slapstick::paper {

/// Attractors over [0.56, 10] with one set of parameters, carried up, and the windows of n-1 motion in them.
struct Case {
  Overrides with;
  std::vector<Found> survey;
  Window windows[7];  ///< [n], n = 1 to 6
};

/// The basis of all claims. Computed once, in parallel.
struct Surveys {
  std::vector<Case> frictions;              ///< in the order of `friction_values`
  Case printed, weak_kinetic;               ///< r = 0.08; f_k = 0.1
  std::vector<Found> down, rest;            ///< the paper's parameters carried down, and each value from rest
  [[nodiscard]] const Case& paper() const;  ///< the paper's parameters: f_s = 0.15
};
[[nodiscard]] Surveys make_surveys(const Study& study);

/// What a claim is computed from.
struct Evidence {
  const Study& study;
  const Surveys& surveys;
};

[[nodiscard]] Claim claim_1(const Evidence& evidence);
[[nodiscard]] Claim claim_2(const Evidence& evidence);
[[nodiscard]] Claim claim_3(const Evidence& evidence);
[[nodiscard]] Claim claim_4(const Evidence& evidence);
[[nodiscard]] Claim claim_5(const Evidence& evidence);
[[nodiscard]] Claim claim_6(const Evidence& evidence);
[[nodiscard]] Claim claim_7(const Evidence& evidence);
[[nodiscard]] Claim claim_8(const Evidence& evidence);
[[nodiscard]] Claim claim_9(const Evidence& evidence);
[[nodiscard]] Claim claim_print(const Evidence& evidence);
[[nodiscard]] Claim coexisting(const Evidence& evidence);

/// All of them, in parallel, in this order.
[[nodiscard]] std::vector<Claim> check_claims(const Study& study);

// Common tools, in claim_tools.cpp.

/// The value of the survey that lies in the middle of the longest run of the wanted kind.
[[nodiscard]] std::optional<Found> middle_of_longest(const std::vector<Found>& survey, const Wanted& wanted);
/// The value of the survey nearest to omega.
[[nodiscard]] const Found& nearest(const std::vector<Found>& survey, double omega);
/// The window of n-1 motion, from the middle of its longest run in the survey.
[[nodiscard]] Window staircase_window(const Study& study, const Overrides& with, const std::vector<Found>& survey,
                                      int n);
/// Steps on from a state until the wanted kind appears.
[[nodiscard]] std::optional<Found> scan(const Study& study, const Overrides& with, double omega, const State& state,
                                        double step, double limit, const Wanted& wanted);
/// Share of a survey's values within [from, to] for which `of` holds.
[[nodiscard]] double share(const std::vector<Found>& survey, double from, double to, const Wanted& of);

[[nodiscard]] std::string fixed(double value, int digits);
/// A place that is known to `within`, with those decimals for which the number printed is off by at most one unit of
/// its last. What is known exactly (0) has all its digits.
[[nodiscard]] std::string place(double value, double within);
[[nodiscard]] std::string place(const Edge& edge);
/// A value of a grid, to the decimals that tell the grid's values apart.
[[nodiscard]] std::string grid_value(double value, double step);
/// "1-1-I -> 2-2-I at ..., multiplier -0.9999: period doubling".
[[nodiscard]] std::string describe(const Edge& edge);
[[nodiscard]] Quantity edge_quantity(const std::string& name, const std::string& printed, const Edge& edge);
[[nodiscard]] Quantity class_quantity(const std::string& name, const std::string& printed, const Found& found);
[[nodiscard]] Quantity number_quantity(const std::string& name, const std::string& printed, double value, int digits,
                                       const std::string& note = "");

}  // namespace slapstick::paper
