#pragma once
/// The orbit that a user means, as the program and Python ask for it, and what is said where there is no such orbit.
///
///     const Chosen found = find_orbit(*problem, system, state, {.orbit = "1-1-I", .stable = false});
///
/// `choose` (search.hpp) does the work; here are a user's words, the limits of a search that nobody stated, and the
/// sentences. Threads and bits: as `choose`.
#include <functional>
#include <string>
#include <string_view>

#include "slapstick/orbit/search.hpp"

namespace slapstick::orbit {

/// Which orbit is meant.
struct OrbitWish {
  std::string orbit = {};  ///< "1-1", "2-inf", "1-1-II", "3" or "": N-P-I, `inf` for a complete chatter, II with stick;
                           ///< "free-1-II" with any N of a free motion
  std::optional<bool> stable = {}, symmetric = {};
  bool nearest = false;    ///< to the start, of those that a search finds
  long transient = 500;    ///< forcing periods, or returns of a free motion, before the first try
  int starts = 0;          ///< motions that a search looks through; 0: SearchOptions::starts, as far as time allows
  double seconds = 0.0;    ///< a search ends then; 0: after 10, or with `starts` never
  std::uint32_t seed = 1;  ///< of the starts
};

/// How the caller's users write an option, so that messages name what they can type: "--starts" for "starts".
using Spelling = std::function<std::string(std::string_view option)>;

/// @param start  for `nearest`
/// @throws InputError naming the option, for an orbit that is not of the form N-P-I or negative seconds
[[nodiscard]] OrbitChoice choice_of(const OrbitWish& wish, const State& start, const Spelling& spelling);

/// The limits of a search that begins now.
[[nodiscard]] SearchOptions search_options(const OrbitWish& wish, const std::atomic<bool>* stop);

/// Chosen::orbit is there.
/// @throws InputError as choice_of, and for "free" where there is a drive; NumericalError saying what was
/// tried and found instead
[[nodiscard]] Chosen find_orbit(const Problem& problem, const System& system, const State& start, const OrbitWish& wish,
                                const std::atomic<bool>* stop, const Spelling& spelling);

/// What a search tried: "64 motions, 812 near returns, 530 runs of Newton's method (..)".
[[nodiscard]] std::string tried(const SearchReport& report, const OrbitWish& wish, const Spelling& spelling);

}  // namespace slapstick::orbit
