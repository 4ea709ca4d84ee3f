/// CPU time per forcing period of one trajectory of the paper's system, slapstick and the peers in one run.
/// Start x1 = -0.5, else 0. The counter `us_per_period` is CPU microseconds.

#include <benchmark/benchmark.h>

#include <cstdio>

#include "peers.hpp"
#include "runner.hpp"

namespace {

using slapstick::bench::PeerRun;

using slapstick::bench::omegas;
using slapstick::bench::periods;

void run_peer(benchmark::State& state, PeerRun (*peer)(double, int, double), double omega, double tolerance) {
  PeerRun run;
  for ([[maybe_unused]] auto _ : state) {
    run = peer(omega, periods, tolerance);
    benchmark::DoNotOptimize(run.impact_times.data());
  }
  using benchmark::Counter;
  state.counters["us_per_period"] = Counter(periods * 1e-6, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["impacts"] = static_cast<double>(run.impact_times.size());
  state.counters["evals_per_period"] = static_cast<double>(run.evaluations) / periods;
}

void register_peer(const char* name, PeerRun (*peer)(double, int, double), double tolerance) {
  for (const double omega : omegas) {
    char title[64];
    std::snprintf(title, sizeof title, "%s/omega:%g", name, omega);
    benchmark::RegisterBenchmark(title, [=](benchmark::State& state) {
      run_peer(state, peer, omega, tolerance);
    })->Unit(benchmark::kMillisecond);
  }
}

}  // namespace

int main(int argc, char** argv) {
  slapstick::bench::register_slapstick();
  slapstick::bench::register_chains();
  register_peer("odeint_rkf78_1e-12", slapstick::bench::run_odeint, 1e-12);
  register_peer("cvode_adams_1e-9", slapstick::bench::run_cvode, 1e-9);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
