#pragma once
/// Output files that appear whole or not at all.
#include <filesystem>
#include <string>
#include <string_view>

namespace slapstick {

/// A file that exists under its name only after `commit`.
///
/// The bytes go to a new file in the same folder; `commit` syncs it to disk and renames it over the old one, which
/// keeps its permissions. Without `commit` (an exception, an early return) the destructor removes the new file and the
/// old one is untouched. What killed programs have left in that folder is removed (io/abandoned_files.hpp). A symbolic
/// link is followed. A device or pipe (/dev/stdout) cannot be renamed over: it is
/// written directly. Every failure is a StorageError of one line, "cannot write 'PATH': REASON"; after one, the object
/// is closed and nothing is left.
class AtomicFile {
 public:
  /// @throws StorageError if the path is a folder or the new file cannot be made
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends bytes (buffered). @throws StorageError on a failed write, e.g. a full disk, or after `commit`
  void write(std::string_view bytes);

  /// Puts the file in place. Call once. @throws StorageError
  void commit();

 private:
  void flush();
  void discard() noexcept;
  [[noreturn]] void fail(int error);

  std::filesystem::path shown_;      // as the user gave it, for messages
  std::filesystem::path target_;     // links resolved
  std::filesystem::path temporary_;  // empty when written directly
  std::string buffer_;
  int descriptor_ = -1;
  int note_ = -1;  // among the temporary files that exist
};

/// Removes the temporary files of all AtomicFiles, for a signal handler that ends the program next: safe in one, at any
/// moment, on any thread. No AtomicFile can be used afterwards. (Of more than 64 at once the rest stays.)
void remove_temporary_files() noexcept;

/// Writes a whole file as AtomicFile does. @throws StorageError
void write_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace slapstick
