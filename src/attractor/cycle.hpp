#pragma once
/// Stroboscopic motion with its events per period, and the record of one cycle.
#include "slapstick/attractor/classify.hpp"
#include "slapstick/flow/stage.hpp"

namespace slapstick::attractor {

/// Events within one forcing period, of all contacts; engagements of compliant stops are impacts (section/stop_choice.hpp).
struct PeriodEvents {
  int impacts = 0, sticks = 0, chatters = 0;
  friend bool operator==(const PeriodEvents&, const PeriodEvents&) = default;
};

/// A wish to stop; null: there is none. Whatever stops early for it returns something meaningless: the caller looks at the flag itself.
using Stop = const std::atomic<bool>*;

/// Runs to the end of the present period and counts.
PeriodEvents run_one_period(Motion& motion, Stop stop);

/// p and u of the extended state.
Eigen::VectorXd contact_state(const Motion& motion);
/// The user's state of contact coordinates (p, u).
State user_state(const System& system, const Eigen::VectorXd& contact);

/// Distance of two contact states, positions and velocities each relative to `scale` (same layout).
double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Eigen::VectorXd& scale);

/// Runs `n` periods from `state` and fills in what the cycle holds: impacts and chatter of the chosen stops, stick, label.
void record_cycle(const System& system, const State& state, int n, const StopChoice& stops, Stop stop,
                  Classification& out);

/// Chatter of a sequence of impacts: incomplete if at least four in a row come ever slower and ever sooner.
bool has_burst(const std::vector<double>& times, const std::vector<double>& speeds);

}  // namespace slapstick::attractor
