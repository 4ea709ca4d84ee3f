/// slapstick's own rows: the same run as the peers', on a System that is compiled once, as every analysis uses it.
#include <benchmark/benchmark.h>

#include <cstdio>

#include "runner.hpp"
#include "slapstick/flow/motion.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick::bench {
namespace {

Model paper_model(double omega) { return load_model("vibro-impact").build({{"omega", omega}}); }

const State start = {-0.5, 0.0, 0.0, 0.0};

void run_motion(benchmark::State& state, double omega) {
  const System system(paper_model(omega));
  Counters counters;
  for ([[maybe_unused]] auto _ : state) {
    Motion motion(system, start);
    while (motion.advance({periods, 0.0}) == Outcome::event) {
    }
    counters = motion.counters();
  }
  using benchmark::Counter;
  state.counters["us_per_period"] = Counter(periods * 1e-6, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["impacts"] = static_cast<double>(counters.impacts);
  state.counters["evals_per_period"] = static_cast<double>(counters.evaluations) / periods;
  state.counters["windows_per_period"] = static_cast<double>(counters.windows) / periods;
}

/// What a new parameter value costs before its first step.
void compile_system(benchmark::State& state) {
  const Model model = paper_model(2.2);
  for ([[maybe_unused]] auto _ : state) {
    System system(model);
    benchmark::DoNotOptimize(system.period());
  }
}

}  // namespace

void register_slapstick() {
  for (const double omega : omegas) {
    char title[64];
    std::snprintf(title, sizeof title, "slapstick/omega:%g", omega);
    benchmark::RegisterBenchmark(title, [=](benchmark::State& state) {
      run_motion(state, omega);
    })->Unit(benchmark::kMillisecond);
  }
  benchmark::RegisterBenchmark("slapstick_compile_system", compile_system)->Unit(benchmark::kMicrosecond);
}

}  // namespace slapstick::bench
