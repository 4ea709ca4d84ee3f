#pragma once
/// A published number of a known system, and how the engine is asked for it.
///
/// An entry of cases.json:
///
///     "id", "expected", "tolerance"   the number; `quantity` and `source` say what and whose it is
///     "model", "set", "start"         see case.hpp
///     "settle"                        run this long first (expressions know the parameters and T, the forcing period)
///     "orbit"                         then solve for a cycle of this many periods by Newton's method, and go on from
///                                     it
///     "marks"                         then run to these events: ["impact", 2] is the second from here, "impact@stop"
///                                     names the contact, "turn" is any velocity reversal, "event" anything
///     "record"                        then count events for this long
///     "value"                         what is compared with `expected`
///
/// `value` knows, besides: t_at1, phase_at1 (radians), w_at1 and the state x_at1 .. just before the first mark, and so
/// on; the state and `time` at the end; impacts, sticks, turns, chatters, engagements (numbers of) and largest_stick
/// (largest |first coordinate| at a stick) of the record; multiplier (largest modulus), multiplier2, trace, det,
/// exponent (per unit of time) of the orbit.
///
///     "tangents": "1000 * T"          the sum of all exponents over this long instead of a record: `exponents`, and
///                                     the record's counts
///     "critical"                      {parameter, zero}: solve for the parameter and the cycle where `zero` vanishes;
///                                     the value is the parameter
///     "boundary"                      {parameter, from, to}: bisect for the value of the parameter where `value`
///                                     changes its sign
///     "disagrees"                     {value, tolerance, why}: the engine's number, where `expected` is known to be
///                                     off by more than its tolerance
#include "library/case.hpp"

namespace slapstick::library {

/// The published cases (cases.json), then those of our own for models that the published list has not (own_cases.json),
/// in the files' order.
const std::vector<Entry>& all_cases();

/// What `value` of the entry comes to.
double measured(const Entry& entry);

/// The value after settle, orbit, marks and record, for one set of parameters.
double plain_value(Setup& setup);

/// Newton's method for a cycle with a condition; @returns the parameter.
double critical_value(const Entry& entry);

}  // namespace slapstick::library
