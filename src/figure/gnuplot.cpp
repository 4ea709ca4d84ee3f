/// Runs gnuplot.
#include "gnuplot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <system_error>

#include "figure/figure.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::figure {
namespace {

constexpr const char* log_name = "gnuplot.log";

/// Working folder and streams of the child: nothing to read, everything it says into the log.
class FileActions {
 public:
  explicit FileActions(const std::string& folder) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, log_name, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
  }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

/// In a process group of its own: a Ctrl-C in the terminal asks the program to stop, which then lets gnuplot finish.
class Attributes {
 public:
  Attributes() {
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
  }
  ~Attributes() { posix_spawnattr_destroy(&attributes_); }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;
  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_{};
};

/// gnuplot echoes the line, points at the place and then says what is wrong: the last line that is not empty.
std::string complaint(const std::filesystem::path& log) {
  std::ifstream in(log);
  std::string line, last;
  while (std::getline(in, line))
    if (line.find_first_not_of(" \t^\r") != std::string::npos) last = line;
  return last.empty() ? "no message" : last.substr(last.find_first_not_of(" \t"));
}

int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR)
      throw StorageError(std::string("gnuplot: cannot wait for it: ") + std::generic_category().message(errno));
  return status;
}

constexpr const char* not_found = "gnuplot not found: install gnuplot-nox";

}  // namespace

void demand_gnuplot() {
  const char* path = std::getenv("PATH");
  std::stringstream folders(path != nullptr ? path : "/bin:/usr/bin");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path program = std::filesystem::path(folder.empty() ? "." : folder) / "gnuplot";
    std::error_code ignored;
    if (std::filesystem::is_regular_file(program, ignored) && ::access(program.c_str(), X_OK) == 0) return;
  }
  throw StorageError(not_found);
}

void run_gnuplot(const std::filesystem::path& folder, const std::string& script_name) {
  std::string program = "gnuplot", option = "-d", script = "./" + script_name;
  char* const arguments[] = {program.data(), option.data(), script.data(), nullptr};
  const FileActions actions(folder.string());
  const Attributes attributes;
  pid_t child = 0;
  const int error = posix_spawnp(&child, program.c_str(), actions.get(), attributes.get(), arguments, environ);
  if (error == ENOENT) throw StorageError(not_found);
  if (error != 0) throw StorageError(std::string("gnuplot does not start: ") + std::generic_category().message(error));
  const int status = wait_for(child);
  if (WIFSIGNALED(status))
    throw StorageError("gnuplot was ended by signal " + std::to_string(WTERMSIG(status)) + " while drawing " +
                       script_name);
  if (WEXITSTATUS(status) == 127) throw StorageError(not_found);
  if (status != 0) throw StorageError("gnuplot cannot draw " + script_name + ": " + complaint(folder / log_name));
}

}  // namespace slapstick::figure
