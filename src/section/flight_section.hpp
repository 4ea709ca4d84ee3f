#pragma once
/// The section of a free motion: the middle, in time, of its flights of one kind.
///
/// At an event a state is on the border of two modes, and in the user's coordinates rounding decides on which side. In
/// the middle of a flight in which least is held a motion can be begun anew. The middles are a section all the same:
/// the instants of both events are smooth functions of the state.
///
/// The map P of a state x is followed to its n-th flight of the kind, and there to where c . (X - x) = 0, c the flow at
/// x: a section at right angles to the flow. With J the derivative at fixed time and f the flow at the image,
///     DP = (I - f c^T / (c . f)) J.
/// At a cycle DP has the multipliers of the cycle, and 0 for the direction f, whose multiplier is 1 in J.
#include "section/flights.hpp"

namespace slapstick::section {

class FlightSection final : public ReturnMap {
 public:
  FlightSection(const System& system, const FlightKind& kind) : ReturnMap(system), kind_(kind) {}

  [[nodiscard]] std::optional<Instant> next(const Motion& motion, Stop stop) const override;
  [[nodiscard]] MapValue value(const Eigen::VectorXd& x, int n, Stop stop) const override;
  [[nodiscard]] std::vector<std::complex<double>> multipliers(const Eigen::MatrixXd& jacobian) const override;
  [[nodiscard]] Eigen::VectorXd on_section(const Eigen::VectorXd& x, int n, Stop stop) const override;
  void take_out_flow(const Motion& motion, Eigen::MatrixXd& tangents) const override;

 private:
  [[nodiscard]] Eigen::VectorXd numbers(const Motion& motion) const;
  [[nodiscard]] Eigen::VectorXd flow(const Motion& motion) const;
  [[nodiscard]] Flight flight_after(Motion motion, int n, Stop stop) const;

  FlightKind kind_;
};

/// Of the kinds of flights that a motion keeps having: in which least is held, of these the rarest, so that a cycle has
/// few points of the section; of equals the longest. Looked at are 400 changes, and up to 25 600 until there is a kind
/// that comes back within a sixth of them: a cycle may have thousands of changes.
/// @returns nothing if the motion has fewer
[[nodiscard]] std::optional<FlightKind> choose_flights(const Motion& motion, Stop stop);

}  // namespace slapstick::section
