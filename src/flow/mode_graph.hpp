#pragma once
/// The mode graph: which mode may start at a state.
///
/// Every event ends in the same question. Each contact offers candidates in order of preference:
///
///     | contact  | at this instant             | candidates, first that fits is taken |
///     |----------|-----------------------------|--------------------------------------|
///     | friction | w > 0                       | slip+                                |
///     | friction | w < 0                       | slip-                                |
///     | friction | w = 0                       | stick, slip+, slip-                  |
///     | friction | any, N linear in the state  | those above, unloaded                |
///     | stop     | gap > 0, or separating      | open                                 |
///     | stop     | gap = 0 and at rest         | closed, open                         |
///     | stop     | gap = 0 and approaching     | none: an impact comes first          |
///     | compliant| delta < 0                   | off                                  |
///     | compliant| delta = 0                   | off, on, detached                    |
///     | compliant| delta > 0                   | on; detached too if it cannot pull   |
///     | bounded  | delta = 0; delta > 0        | off or these; on, bounded, detached  |
///     | charact. | between two corners         | the piece there                      |
///     | charact. | at a corner                 | the pieces on both sides             |
///
/// and a combination *fits* if every guard it arms is positive at once: h > 0, or h = 0 with a positive first non-zero
/// derivative (h = 0 for good too). For the paper's system this is the table of docs/explanation/mode_graph.md: after
/// w = 0, stick if |f0| <= f_s, else slip with s = sgn f0; on the closed stop the only guard is f0 + f_s, so release
/// needs f0 < -f_s however large f0 grows.
///
/// With several contacts at rest this is the complementarity problem of rigid-body dynamics (Pfeiffer and Glocker 1996,
/// chapter 5), solved by going through the combinations: first those in which one contact differs from what it prefers,
/// then two, and so on; so a contact lets go only where it must, and a release costs as many tries as there are
/// contacts, not as there are combinations. Each combination is tried on all sides of the lines that are being crossed
/// before the next. Contacts that do not act on each other choose by themselves (flow/mode_choice.hpp). Where many
/// combinations have failed, contacts that do not fit go over one by one instead.
/// Among redundant contacts one that would have to pull is left open, at rest all the same.
/// Combinations that certainly do not fit are refused before their mode is built.
#include <span>

#include "flow/compiled_system.hpp"

namespace slapstick::flow {

/// Order of the zero of a guard at a state: 0 if h > 0; p if the first p derivatives vanish (within `rest_factor` times
/// their rounding bound) and the next is positive; `never` if all below `never` vanish: a window's series says no more
/// of h than that it is zero; `negative` if h starts downwards.
inline constexpr int never = event::terms;
inline constexpr int negative = -1;
/// So much of a guard's value may be rounding.
/// @param m     numbers of X
/// @param size  sum of the sizes of the value's terms
double rounding_of(int m, double size);
/// .. of row . X
double rounding_of(const mode::RowVector& row, const double* magnitude);

/// @param known derivatives below this order are known to vanish, whatever their stored values say (after a graze: 2).
int start_order(const mode::Mode& mode, int guard, const double* X, const double* magnitude, int known = 0);

/// The mode that may start at X (with |X| in magnitude); writes the start order of each of its guards.
/// A friction contact is at rest if its stored relative velocity is exactly zero, a stop touches if its gap is.
/// @returns mode id, or -1 if no combination fits.
ModeId select_mode(const CompiledSystem& system, const double* X, const double* magnitude, std::span<int> orders);

/// The mode of a state that is about to hit a stop: all stops open, the other contacts by their displacements and
/// velocities.
ModeId approaching_mode(const CompiledSystem& system, const double* X);

/// row . X
double row_product(const mode::RowVector& row, const double* X);

/// The piece of a characteristic that the stored value lies in.
int piece_at(const CompiledSystem& system, int characteristic, const double* X);

/// w of a friction contact, gap of a stop and the rate at which it closes, depth delta of a compliant stop, at X: each
/// one stored number.
double sliding_velocity(const CompiledSystem& system, int contact, const double* X);
double gap(const CompiledSystem& system, int stop, const double* X);
double approach_velocity(const CompiledSystem& system, int stop, const double* X);
double depth(const CompiledSystem& system, int compliant, const double* X);

}  // namespace slapstick::flow
