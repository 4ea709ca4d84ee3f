#pragma once
/// What the worker can measure: each run answers with its CPU time and what it counted.
#include <ctime>
#include <map>
#include <string>
#include <vector>

#include "slapstick/sweep/batch.hpp"

namespace slapstick::bench {

/// In the order in which they are printed.
using Answer = std::vector<std::pair<std::string, double>>;
using Words = std::vector<std::string>;

/// CPU time of this process, or of all its threads, in seconds.
inline double cpu_time() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// OMEGA PERIODS REPEATS: the paper's oscillator from x1 = -0.5, else 0. `cpu` is the mean of the repeats.
Answer run_slapstick(const Words& words);
/// OMEGA REPEATS: a new parameter value, up to a `System`, and with the modes that 50 periods meet.
Answer run_system(const Words& words);
/// COORDINATES CONTACTS PERIODS REPEATS: a chain of masses, every odd contact a stop, every even one friction, after
/// 200 periods.
Answer run_chain(const Words& words);
/// THREADS OMEGA PERIODS: a motion on each thread, of one System. `wall` beside `cpu`.
Answer run_threads(const Words& words);
/// OMEGA PERIODS: 64 such motions in the lanes of one thread, from starts that are 0.001 apart.
Answer run_lanes(const Words& words);
/// ROWS PERIODS THREADS EXPONENT: ROWS x ROWS values of omega 1..6 and friction 0.05..0.3 in refilled lanes.
/// EXPONENT 1: with the largest exponent of each run.
Answer run_chart(const Words& words);

/// What the two run.
sweep::BatchProblem lanes_of_starts(double omega, int periods);
sweep::BatchProblem lanes_of_chart(int rows, int periods);

}  // namespace slapstick::bench
