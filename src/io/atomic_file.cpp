/// Writes output files that appear whole or not at all.
#include "io/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "base/text.hpp"
#include "io/abandoned_files.hpp"
#include "io/temporary_files.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 16;

std::string reason(int error) { return std::generic_category().message(error); }

/// O_EXCL settles what the name leaves open of the question whose file it is.
int open_new(const std::filesystem::path& target, std::filesystem::path& temporary, int& note) {
  for (int attempt = 0; attempt < 1000; ++attempt) {
    temporary = temporary_name(target);
    note = note_temporary(temporary);
    const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) return descriptor;
    forget_temporary(note);
    note = -1;
    if (errno != EEXIST && errno != EINTR) return descriptor;
  }
  return -1;
}

/// Makes a rename durable. Some file systems cannot sync a folder and say EINVAL: nothing more can be done there.
int sync_folder(const std::filesystem::path& target) {
  const auto folder = target.has_parent_path() ? target.parent_path() : std::filesystem::path(".");
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return 0;  // a folder that may be written but not read
  const int error = ::fsync(descriptor) != 0 && errno != EINVAL ? errno : 0;
  ::close(descriptor);
  return error;
}

}  // namespace

AtomicFile::AtomicFile(const std::filesystem::path& path) : shown_(path), target_(path) {
  if (path.empty()) fail(ENOENT);
  struct stat status {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) fail(errno);
  if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
  if (exists && !S_ISREG(status.st_mode)) {
    descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  std::error_code ignored;
  if (exists) target_ = std::filesystem::canonical(path, ignored);
  if (target_.empty()) target_ = path;
  remove_abandoned_beside(target_);
  descriptor_ = open_new(target_, temporary_, note_);
  if (descriptor_ < 0) {
    const int error = errno;
    temporary_.clear();  // not ours
    fail(error);
  }
  if (exists && ::fchmod(descriptor_, status.st_mode & 07777) != 0) fail(errno);
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::write(std::string_view bytes) {
  if (descriptor_ < 0) fail(EBADF);
  buffer_.append(bytes);
  if (buffer_.size() >= buffer_size) flush();
}

void AtomicFile::flush() {
  std::size_t done = 0;
  while (done < buffer_.size()) {
    const ssize_t count = ::write(descriptor_, buffer_.data() + done, buffer_.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(errno);
    if (count == 0) fail(EIO);
    done += static_cast<std::size_t>(count);
  }
  buffer_.clear();
}

void AtomicFile::commit() {
  if (descriptor_ < 0) fail(EBADF);
  flush();
  const bool direct = temporary_.empty();
  if (!direct && ::fsync(descriptor_) != 0)
    fail(errno);  // never retried: a second fsync may "succeed" with the data lost
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0 && errno != EINTR) fail(errno);
  if (direct) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
  forget_temporary(note_);
  note_ = -1;
  if (const int error = sync_folder(target_); error != 0) fail(error);
}

void AtomicFile::discard() noexcept {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
  forget_temporary(note_);
  note_ = -1;
}

void AtomicFile::fail(int error) {
  discard();
  throw StorageError("cannot write " + in_quotes(shown_.string()) + ": " + reason(error));
}

void write_atomically(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace slapstick
