/// Prints a hash of the runs of a batch, and compares it with the one that stands in the repository: the same bits in
/// every lane of every machine.
///
///     test_batch_bits [FILE]     exit status 1 if FILE says something else, or the kernel is not that of
///                                SLAPSTICK_TARGET
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "hash.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/io/model_file.hpp"
#include "slapstick/sweep/batch.hpp"

namespace slapstick {
namespace {

void add(Hash& hash, const BatchRun& run) {
  for (const Event& event : run.events) {
    hash.add(static_cast<std::uint64_t>(event.kind));
    hash.add(static_cast<std::uint64_t>(event.contact));
    hash.add(static_cast<std::uint64_t>(event.time.period));
    hash.add(event.time.fraction);
    hash.add(event.w);
  }
  for (const double x : run.end) hash.add(x);
  hash.add(run.speeds);
}

/// Runs a model at `count` values of a parameter, with exponents or without.
std::string line(const std::string& model, const std::string& parameter, double from, double to, std::size_t count,
                 int periods, sweep::Batch& batch, bool exponent = false) {
  const ModelDefinition definition = load_model(model);
  sweep::BatchProblem problem;
  problem.count = count;
  problem.model_at = [&](std::size_t i) {
    return definition.build(
        {{parameter, from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1)}});
  };
  problem.start_at = [&](std::size_t) { return definition.start(); };
  problem.plan = {.periods = periods, .events = true, .exponent = exponent};
  batch = run_batch(problem);
  Hash hash;
  long lanes = 0, motions = 0;
  for (const BatchRun& run : batch.runs) {
    if (!run.failure.empty()) throw NumericalError(run.failure);
    add(hash, run);
    if (exponent) hash.add(run.exponent);
    lanes += run.lane_events;
    motions += run.motion_events;
  }
  if (lanes < 10 * static_cast<long>(count))
    throw NumericalError("hardly an event of " + model + " was decided in a lane");
  char text[160];
  std::snprintf(text, sizeof text, "%s %s=%g..%g periods %d%s lane events %ld motion events %ld bits %016llx",
                model.c_str(), parameter.c_str(), from, to, periods, exponent ? " exponents" : "", lanes, motions,
                static_cast<unsigned long long>(hash.value()));
  return text;
}

int run(int arguments, char** values) {
  sweep::Batch batch;
  const std::vector<std::string> lines = {line("vibro-impact", "omega", 1.0, 6.0, 60, 100, batch),
                                          line("vibro-impact", "omega", 0.5, 1.0, 20, 30, batch),
                                          line("stick-slip-impact", "omega", 0.8, 3.0, 20, 60, batch),
                                          line("two-blocks-on-belt", "belt_speed", 0.2, 1.0, 10, 60, batch),
                                          line("vibro-impact", "omega", 0.5, 6.0, 60, 60, batch, true)};
  const char* const forced = std::getenv("SLAPSTICK_TARGET");
  std::cout << "kernel: " << batch.kernel << ", " << batch.lanes << " lanes\n";
  std::ifstream stored(arguments > 1 ? values[1] : "");
  bool same = true;
  for (const std::string& found : lines) {
    std::string expected;
    std::getline(stored, expected);
    std::cout << found << "\n";
    if (arguments > 1 && found != expected) {
      std::cout << "stored: " << expected << "\n";
      same = false;
    }
  }
  return same && (forced == nullptr || forced == batch.kernel) ? 0 : 1;
}

}  // namespace
}  // namespace slapstick

int main(int arguments, char** values) {
  try {
    return slapstick::run(arguments, values);
  } catch (const std::exception& error) {
    std::cout << error.what() << "\n";
    return 2;
  }
}
