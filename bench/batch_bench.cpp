/// What a period costs in the lanes of a batch: one frequency in all lanes, or a chart with refilled lanes.
///
///     bench_batch omega 2.2 4000        64 runs at omega from slightly different starts
///     bench_batch chart 80 300          80 x 80 values of omega 1..6 and friction 0.05..0.3, from rest
///     bench_batch chart 80 300 0 tangents   with the largest exponent of each run; 0: the widest lanes
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "runs.hpp"

namespace {

void print(const char* what, double seconds, const slapstick::sweep::Batch& batch, double periods) {
  double impacts = 0.0, lane_events = 0.0, motion_events = 0.0;
  std::size_t failed = 0;
  for (const slapstick::BatchRun& run : batch.runs) {
    impacts += static_cast<double>(run.impacts);
    lane_events += static_cast<double>(run.lane_events);
    motion_events += static_cast<double>(run.motion_events);
    failed += run.failure.empty() ? 0 : 1;
  }
  std::printf(
      "%s: %s, %d lanes, %zu runs, %.4f us a period, %.1f ns a lane step, %.3f lane steps, %.4f halved, %.5f doubtful "
      "events, "
      "of %.3f, %.4f impacts a period, %.0f%% of the lanes full, %zu failed\n",
      what, batch.kernel.c_str(), batch.lanes, batch.runs.size(), 1e6 * seconds / periods,
      1e9 * seconds / static_cast<double>(batch.lane_steps), static_cast<double>(batch.lane_steps) / periods,
      static_cast<double>(batch.halved) / periods, motion_events / periods, (lane_events + motion_events) / periods,
      impacts / periods, 100.0 * static_cast<double>(batch.lane_steps) / static_cast<double>(batch.steps) / batch.lanes,
      failed);
}

}  // namespace

int main(int arguments, char** values) {
  using namespace slapstick;
  const std::string what = arguments > 1 ? values[1] : "chart";
  const int periods = arguments > 3 ? std::atoi(values[3]) : 300;
  sweep::BatchProblem problem = what == "omega"
                                    ? bench::lanes_of_starts(std::atof(values[2]), periods)
                                    : bench::lanes_of_chart(arguments > 2 ? std::atoi(values[2]) : 80, periods);
  problem.lanes = arguments > 4 ? std::atoi(values[4]) : 0;
  problem.plan.exponent = arguments > 5 && std::string_view(values[5]) == "tangents";
  const double begun = bench::cpu_time();
  const sweep::Batch batch = sweep::run_batch(problem);
  const double seconds = bench::cpu_time() - begun;
  print(what.c_str(), seconds, batch, static_cast<double>(problem.count) * problem.plan.periods);
  for (const BatchRun& run : batch.runs)
    if (!run.failure.empty()) {
      std::printf("%s\n", run.failure.c_str());
      break;
    }
  return 0;
}
