/// Names temporary files after their process, and removes those whose process is gone.
#include "io/abandoned_files.hpp"

#include <signal.h>  // NOLINT(modernize-deprecated-headers): kill is of POSIX
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <limits>
#include <string_view>
#include <system_error>

namespace slapstick {
namespace {

/// The number of the processes' name space: a container counts its processes from 1, as others do. 0 where the system
/// does not say.
std::uint64_t process_space() {
  struct stat status {};
  return ::stat("/proc/self/ns/pid", &status) == 0 ? status.st_ino : 0;
}

/// A hash (FNV-1a) of where a process number means a process: the machine's name and the processes' name space.
std::string machine() {
  std::array<char, 256> host{};
  (void)::gethostname(host.data(), host.size() - 1);
  std::uint32_t hash = 2166136261U;
  for (const char c : std::string(host.data()) + " " + std::to_string(process_space()))
    hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return std::to_string(hash);
}

/// ".tmp-MACHINE-": what stands before the process in the names of this machine.
const std::string& mark() {
  static const std::string text = ".tmp-" + machine() + "-";
  return text;
}

bool is_number(std::string_view text) {
  return !text.empty() && text.size() <= 10 && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// Is this the name of a temporary file of this machine, of a process that is gone?
bool abandoned(const std::string& name) {
  const std::size_t at = name.rfind(mark());
  if (at == std::string::npos || at == 0) return false;
  const std::string rest = name.substr(at + mark().size());
  const std::size_t end = rest.find('-');
  if (end == std::string::npos || !is_number(rest.substr(0, end)) || !is_number(rest.substr(end + 1))) return false;
  const long long process = std::stoll(rest);
  if (process == 0 || process > std::numeric_limits<pid_t>::max()) return false;
  return ::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH;
}

}  // namespace

std::filesystem::path temporary_name(const std::filesystem::path& target) {
  static std::atomic<unsigned> serial{0};
  auto name = target;
  name += mark() + std::to_string(::getpid()) + "-" + std::to_string(serial++);
  return name;
}

void remove_abandoned_beside(const std::filesystem::path& target) noexcept {
  try {
    const auto folder = target.has_parent_path() ? target.parent_path() : std::filesystem::path(".");
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (abandoned(entry.path().filename().string()) &&
          entry.symlink_status().type() == std::filesystem::file_type::regular)
        ::unlink(entry.path().c_str());
  } catch (const std::exception&) {
    return;  // rubbish is no reason not to write
  }
}

}  // namespace slapstick
