#pragma once
/// The record of one cycle: its impacts, stick and chatter.
#include "flow/contact_state.hpp"
#include "section/settling.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/flow/stage.hpp"

namespace slapstick::attractor {

using flow::contact_state, flow::user_state;
using section::distance, section::PeriodEvents, section::Stop;

/// Runs `duration` periods from `state` and fills in what the cycle holds: n, impacts and chatter of the chosen stops,
/// stick, label.
void record_cycle(const System& system, const State& state, double duration, const StopChoice& stops, Stop stop,
                  Classification& out);

/// Fills in all that a cycle says of a motion except its drift.
/// @param state  of the user, on the cycle
void describe(const System& system, const section::Cycle& cycle, const State& state, const ClassifyOptions& options,
              Classification& out);

/// Chatter of a sequence of impacts: incomplete if at least four in a row come ever slower and ever sooner.
bool has_burst(const std::vector<double>& times, const std::vector<double>& speeds);

}  // namespace slapstick::attractor
