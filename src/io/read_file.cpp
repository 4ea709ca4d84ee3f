/// Reads regular files whole.
#include "io/read_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "base/text.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {

std::string read_file(const std::string& path, const std::string& what, std::size_t limit) {
  const std::string where = what + in_quotes(path) + ": ";
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) throw StorageError(where + "no such file");
  if (error) throw StorageError(where + error.message());
  if (std::filesystem::is_directory(status)) throw StorageError(where + "a folder, not a file");
  if (!std::filesystem::is_regular_file(status)) throw StorageError(where + "not a regular file");
  const auto size = std::filesystem::file_size(path, error);
  std::ifstream in(path, std::ios::binary);
  if (!in) throw StorageError(where + std::generic_category().message(errno));
  // a file may grow, and one of /proc says 0
  const std::uintmax_t wanted = error ? limit : std::max<std::uintmax_t>(size, 4096);
  std::string text(static_cast<std::size_t>(std::min<std::uintmax_t>(limit, wanted)) + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) throw StorageError(where + "cannot be read");
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

std::string beside(const std::string& file, const std::string& path) {
  return (std::filesystem::path(file).parent_path() / path).string();
}

}  // namespace slapstick
