#pragma once
/// The study of the seed paper in one call: figures 2 to 8, the claims C1 to C9 checked, and a page that shows both
/// beside the paper's words.
///
/// Files in `folder`:
///
///     figN.png .pdf .gp      the figure and the script that draws it
///                            (figN-plot.csv: curves; figN-raster<k>.png: point clouds)
///     figN-*.csv             every computed point behind it, 17 digits
///     branches.*, bounds.*   the same of the continued branches 1-1 to 5-1
///                            and of what bounds their windows over friction
///     claims.json            the claims, with every number; the same bytes for any number of threads
///     index.html             the page: figures, words, claims, timing; needs no other file
///
/// Everything is computed by the engine with the defaults of the built-in model `vibro-impact`; parameters that the
/// print lacks or has wrong are stated on the page. Window edges are found by following the attractor from inside in
/// ever shorter steps until the edge is enclosed in 5e-5 of omega; of each place the decimals that are known are
/// printed.
#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "reproduce/claim.hpp"

namespace slapstick::paper {

/// Where a run stands.
struct Progress {
  std::string part;        ///< "Fig. 2"
  double fraction = 0.0;   ///< of the whole run, by expected time
  double elapsed_s = 0.0;  ///< since its start
  double left_s = 0.0;     ///< estimate
};

/// How long a part took.
struct Part {
  std::string name;
  double seconds = 0.0;  ///< by the clock on the wall
};

struct Options {
  std::filesystem::path folder = "out";  ///< made if it is missing
  int threads = 0;                       ///< 0: all
  bool quick = false;                    ///< the same study on coarser grids, for tests: seconds instead of minutes
  std::string command;                   ///< shown on the page
  std::function<void(const Progress&)> progress;   ///< from any of the threads, but never two at once
  std::function<void(const Part&)> part_finished;  ///< likewise
  const std::atomic<bool>* cancel = nullptr;       ///< set it and the run returns soon
};

struct Reproduction {
  bool complete =
      true;  ///< false if cancelled: the files written so far are whole, the page and claims.json are not written
  std::vector<Claim> claims;
  std::vector<Part> parts;
  std::vector<std::filesystem::path> files;  ///< what was written
};

/// Runs the study. An existing file of the same name is replaced as a whole or not at all.
/// @throws StorageError  the folder cannot be made or written (before anything is computed), or gnuplot is missing
/// @throws InputError    threads < 0
/// Cost: about two minutes on two cores; quick: some seconds. The page says where the time went.
[[nodiscard]] Reproduction reproduce(const Options& options);

}  // namespace slapstick::paper
