/// Runs a loop over an index: each index is a chain of one cell.
#include "slapstick/sweep/parallel.hpp"

#include "slapstick/base/error.hpp"
#include "sweep/executor.hpp"

namespace slapstick::sweep {

bool for_each_index(int count, int threads, const std::function<void(int)>& body, const std::atomic<bool>* cancel) {
  if (count < 0 || threads < 0) throw InputError("for_each_index: count and threads must not be negative");
  return run_chains(
      {.chains = count}, threads, [&](const Cell& cell, const Starts&, const HandOn&) { body(cell.chain); }, cancel);
}

}  // namespace slapstick::sweep
