#pragma once
/// The failure catalogue as data: catalogue.json and models/*.toml beside it; README of its keys.
///
/// An entry:
///
///     "id", "title", "danger"     K02, "near graze, hit", what goes wrong where this is not looked after
///     "source"                    where the expected values are from
///     "for"                       a family: {"k": "1..52", "r": [0.5, 0.8]} (all combinations), or a list of {name:
///                                 value}; one test a member. {k} in a text is replaced by its value, which is all that
///                                 happens to a name in "texts"
///     "let"                       further names, from those before
///     "model", "set", "start"     as in ../library/case.hpp; numbers are numbers or expressions
///     "options"                   chatter_tolerance, most_events_per_period of the motion
///     "settle"                    run this long first, unnoticed
///     "run", "most_events"        then run this long, or up to this number of events; durations are in time units, or
///                                 {"periods": n}
///     "window_caps": true         all of it again for twenty bounds on the engine's internal step
///                                 (System::longest_window)
///     "cuts"                      all of it again in pieces of these lengths
///
/// What is expected:
///
///     "events"                    the kinds of all events in their order; alternatives between " | "
///     "never"                     kinds that must not occur
///     "mode", "start_mode"        the mode's name at the end, at the start
///     "expect"                    list of {"value", "is", "within" (0)}: expressions of parameters, T, members and
///                                 what was noted (below)
///     "each"                      list of {"kind", "value", "is", "within", "last" (all)}: for the n-th event of a
///                                 kind, of n, t, w and the state before it
///     "same"                      keys of another entry that override this one's for a second run: the same events,
///                                 times and states. "within" (0: the same bits), "factor" (-1: all coordinates
///                                 mirrored), "kind" (only these events, without the states)
///     "oracle"                    the 50-digit reference has the same events, at times within this (for C++ only)
///     "refused", "fails"          InputError before the first step, NumericalError on the way, with all these words in
///                                 its one line
///     "guards"                    {"mode", "are"}: the guards that end this mode
///
/// Noted: the state at the start as x_start; t, phase, w and the state before event i as t_at1, w_at1, x_at1 .. (the
/// first forty), of the first event of a kind as t_impact, t_slip_plus, .., of the last one as t_last; error_chatter;
/// the state and time at the end; the counts of ../library/notes.hpp; events, grazes, most_at_once (events at one
/// instant), least_step (between two of them otherwise), most_evaluations (of guards in one segment), phase_drift
/// (largest difference of impact phases). "watch" adds balances (watch.hpp).
#include <string>
#include <vector>

#include "library/case.hpp"

namespace slapstick::catalogue {

using library::Entry;
using library::Values;

/// One member of a family, its names put in.
struct Member {
  std::string name;  ///< K02_near_graze_hit_k_7
  Entry entry;
  Values given;  ///< the member's names
};

const std::vector<Member>& all_members();

}  // namespace slapstick::catalogue
