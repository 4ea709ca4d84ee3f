#pragma once
/// The one executor of grids: chains of cells on all cores.
///
/// A cell is a piece of work with a number of its own: a value of a diagram, some pixels of a map. The cells of a chain
/// begin one after the other, each where the one before handed on; a chain of one cell is a task by itself. A body may
/// hand on before it ends (a diagram does so after the transient, and then records): the next cell then begins on
/// another thread.
///
///     const auto body = [&](const Cell& cell, const Starts& start, const HandOn& hand_on) {
///       Result& mine = results[cell.chain * columns + cell.step];
///       mine = compute(start);
///       hand_on({mine.state});
///     };
///     run_chains({.chains = rows, .length = columns}, threads, body);
///
/// What a cell gives depends on its number and its start only, never on threads. So results that are kept under the
/// cell's number have the same bits for any number of threads. The executor knows neither results nor files.
#include <atomic>
#include <functional>
#include <vector>

#include "slapstick/flow/motion.hpp"

namespace slapstick::sweep {

/// A start that one cell hands to the next.
struct Carried {
  State state;            ///< user's coordinates; empty: none, begin anew
  double fraction = 0.0;  ///< phase of the forcing
  int periods = 0;        ///< of a transient that have passed already
  friend bool operator==(const Carried&, const Carried&) = default;
};

/// One for each motion of a cell; empty at the first cell of a chain.
using Starts = std::vector<Carried>;

struct Chains {
  int chains = 0;
  int length = 1;  ///< cells of each
};

struct Cell {
  int chain = 0, step = 0;
};

/// Call once at most. A body that has not handed on by its end hands on the start that it was given.
using HandOn = std::function<void(Starts)>;
using Body = std::function<void(const Cell&, const Starts&, const HandOn&)>;

/// Runs every cell once. Chains that have begun go before new ones, and the lowest goes first.
/// @param threads  0: all
/// @param cancel  when set, no further cell is begun; those that run are finished
/// @returns true if every cell was run
/// @throws InputError for a negative number; what a body throws (the first that is noticed), after the others have
/// ended
bool run_chains(const Chains& chains, int threads, const Body& body, const std::atomic<bool>* cancel = nullptr);

}  // namespace slapstick::sweep
