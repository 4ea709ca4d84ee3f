#pragma once
/// A parallel loop over an index, for work that is no diagram.
///
///     std::vector<Result> results(n);
///     sweep::for_each_index(n, threads, [&](int i) { results[i] = compute(i); });
///
/// Results belong under their index; then they are the same bits for any number of threads.
#include <atomic>
#include <functional>

namespace slapstick::sweep {

/// Calls `body(i)` once for every i in [0, count), on `threads` threads (0: all). A body may itself loop in parallel.
/// The order is not defined; the first indices are begun first, so put the long work there.
/// @param cancel  when set, no further body is begun; those that run are finished
/// @returns true if every body was called
/// @throws InputError for a negative count or number of threads; what a body throws (the first that is noticed)
bool for_each_index(int count, int threads, const std::function<void(int)>& body,
                    const std::atomic<bool>* cancel = nullptr);

}  // namespace slapstick::sweep
