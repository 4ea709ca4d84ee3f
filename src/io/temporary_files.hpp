#pragma once
/// The temporary files that exist now, for a signal handler that ends the program: it may neither allocate nor lock.
#include <filesystem>

namespace slapstick {

/// Notes a temporary file, best before it is made. @returns what to forget it by; -1 if there are already 64, or the
/// name is too long
[[nodiscard]] int note_temporary(const std::filesystem::path& path) noexcept;

/// The file has been renamed or removed. -1 is ignored.
void forget_temporary(int note) noexcept;

}  // namespace slapstick
