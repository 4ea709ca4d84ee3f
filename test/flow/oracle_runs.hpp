#pragma once
/// Runs of the 50-digit oracle in the form of runs.hpp.
#include <string>
#include <vector>

#include "flow/runs.hpp"
#include "mode/frame.hpp"
#include "oracle/oracle.hpp"

namespace slapstick::testing {

/// The engine's mode in the oracle's words.
inline oracle::Mode oracle_mode(const System& system, ModeId id) {
  const mode::ContactStates& states = system.compiled().mode(id).states();
  oracle::Mode mode;
  if (!states.frictions.empty()) mode.friction = static_cast<int>(states.frictions[0]);
  mode.closed = !states.stops.empty() && states.stops[0] == mode::StopState::closed;
  return mode;
}

/// A state of the engine, to its last bit, as the oracle's start of a segment.
inline oracle::SegmentStart oracle_start(const System& system, const double* X, ModeId mode_id, double fraction) {
  const mode::Frame& frame = system.compiled().frame();
  oracle::SegmentStart start;
  for (int i = 0; i < frame.n; ++i) {
    oracle::Real x = 0, v = 0;
    for (int j = 0; j < frame.n; ++j) {
      const oracle::Real w(frame.W_inverse(i, j));
      x += w * (oracle::Real(X[j]) + oracle::Real(frame.shift[j]));
      v += w * (oracle::Real(X[frame.u(j)]) + oracle::Real(frame.drift[j]));
    }
    start.state.push_back(x);
    start.state.push_back(v);
  }
  start.phase_fraction = fraction;
  start.mode = oracle_mode(system, mode_id);
  const auto zero_row = [&](const mode::ContactRow& contact, bool velocity) {
    return X[velocity ? frame.u(contact.own) : contact.own] == 0.0;
  };
  if (!frame.stops.empty()) start.touching = !start.mode.closed && zero_row(frame.stops[0], false);
  if (!frame.frictions.empty() && start.mode.friction != 0) {
    start.no_slip = zero_row(frame.frictions[0], true);
  }
  return start;
}

inline std::vector<Seen> oracle_events(oracle::Oracle& oracle, double time) {
  std::vector<Seen> seen;
  const oracle::Real start = oracle.time();
  for (const oracle::OracleEvent& event : oracle.run(start + oracle::Real(time)))
    seen.push_back({event.kind, event.contact == "stop", oracle::Real(event.time - start).convert_to<double>(),
                    event.w.convert_to<double>()});
  return seen;
}

}  // namespace slapstick::testing
