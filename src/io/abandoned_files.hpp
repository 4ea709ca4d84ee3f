#pragma once
/// Temporary files that a killed program has left: their names say whose they are.
#include <filesystem>
#include <string>

namespace slapstick {

/// A name beside `target` that no other thread, process or machine uses: TARGET.tmp-MACHINE-PROCESS-SERIAL.
[[nodiscard]] std::filesystem::path temporary_name(const std::filesystem::path& target);

/// Removes the temporary files in the folder of `target` whose process is gone. A file stays if its process lives, if
/// its name is of another machine, or if the name has a form that `temporary_name` does not give. Errors are passed
/// over. Cost: one reading of the folder.
void remove_abandoned_beside(const std::filesystem::path& target) noexcept;

}  // namespace slapstick
