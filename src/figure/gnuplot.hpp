#pragma once
/// Running gnuplot.
#include <filesystem>
#include <string>

namespace slapstick::figure {

/// Runs `gnuplot <script>` in `folder`, without a shell and without the user's start-up file, and waits for it.
/// @throws StorageError  "gnuplot not found: install gnuplot-nox", or its first message and the script it refers to
void run_gnuplot(const std::filesystem::path& folder, const std::string& script_name);

}  // namespace slapstick::figure
