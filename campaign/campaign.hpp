#pragma once
/// The campaigns: long random examinations of the engine, each with targets (docs/developers/campaigns.md).
#include <atomic>
#include <cstdint>
#include <vector>

#include "io/json.hpp"

namespace campaign {

struct Options {
  long count = 0;  ///< in the campaign's unit
  std::uint64_t seed = 1;
  int threads = 1;
  bool progress = true;
  const std::atomic<bool>* stop = nullptr;  ///< set: come to an end with what there is

  [[nodiscard]] bool stopped() const { return stop != nullptr && stop->load(std::memory_order_relaxed); }
};

struct Report {
  long done = 0;        ///< of `count`
  bool passed = false;  ///< all targets are met by what was done
  slapstick::Json figures = slapstick::Json::object();
};

struct Campaign {
  const char* name;
  const char* summary;
  const char* unit;
  long count;  ///< of the long version
  Report (*run)(const Options&);
};

/// Those of this program.
const std::vector<Campaign>& campaigns();

/// Reads the command line, runs one campaign and writes its report. Exit status: 0 passed, 1 not, 2 bad input, 3 the
/// numerics did not succeed, 4 the report could not be written, 130 ended by Ctrl-C (the report says how far it came).
int campaign_main(int count, char** arguments);

Report run_segments(const Options& options);
Report run_wide(const Options& options);
Report run_balls(const Options& options);
Report run_forgeries(const Options& options);
Report run_noise(const Options& options);
Report run_orbit(const Options& options);
Report run_families(const Options& options);
Report run_branches(const Options& options);
Report run_classes(const Options& options);
Report run_charts(const Options& options);
Report run_lanes(const Options& options);
Report run_lane_grazes(const Options& options);
Report run_neutral(const Options& options);
Report run_peers(const Options& options);

}  // namespace campaign
