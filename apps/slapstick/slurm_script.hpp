#pragma once
/// The script that computes a map on a cluster: a job array of shards, and the join of their stores.
#include "map_options.hpp"

namespace slapstick::app {

struct SlurmWish {
  int tasks = 1;
  std::string store;                       ///< of the whole; those of the shards lie beside it
  std::string out, plot, plot_size, show;  ///< of the whole, by `store export`; empty: none
  std::vector<std::string> insets;         ///< of the picture
};

/// A shell script for `sbatch`: each task computes one shard and goes on where an earlier attempt was ended; the task
/// that is finished last joins the stores. Without Slurm `bash SCRIPT I` does what task I does.
/// @throws InputError if the paths cannot be written into a script
[[nodiscard]] std::string slurm_script(const MapOptions& options, const std::vector<std::string>& words,
                                       const SlurmWish& wish);

}  // namespace slapstick::app
