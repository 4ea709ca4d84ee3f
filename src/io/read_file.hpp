#pragma once
/// The bytes of a file that a user names: a model, a matrix, a signal.
#include <cstddef>
#include <string>

namespace slapstick {

/// Largest file of numbers that is read. The limit bounds time and memory for hostile files.
inline constexpr std::size_t numbers_size_limit = std::size_t{1} << 24;

/// At most `limit` + 1 bytes of a regular file: a pipe or a device could block or never end.
/// @param what  what messages call the file, with a blank: "model file "
/// @throws StorageError for a file that is not there or cannot be read
[[nodiscard]] std::string read_file(const std::string& path, const std::string& what, std::size_t limit);

/// The path as seen from the folder of another file; an absolute path stays.
[[nodiscard]] std::string beside(const std::string& file, const std::string& path);

}  // namespace slapstick
