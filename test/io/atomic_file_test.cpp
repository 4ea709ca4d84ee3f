/// Output files appear whole or not at all, whichever system call fails.
#include "io/atomic_file.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <functional>
#include <iterator>

#include "io/abandoned_files.hpp"
#include "slapstick/base/error.hpp"

namespace {

namespace fs = std::filesystem;

/// Counts down over the system calls below; the one at which it reaches zero fails with ENOSPC.
int calls_until_failure = 0;

bool fails_now() {
  if (calls_until_failure == 0 || --calls_until_failure != 0) return false;
  errno = ENOSPC;
  return true;
}

/// A process with this set is killed at its next call of rename, before or after the file has its name.
enum class Kill { no, before, after } kill_at_rename = Kill::no;

}  // namespace

// The library is static: these stand in front of the C library's for the code under test.
extern "C" ssize_t write(int descriptor, const void* data, std::size_t size) {
  return fails_now() ? -1 : ::syscall(SYS_write, descriptor, data, size);
}
extern "C" int fsync(int descriptor) { return fails_now() ? -1 : static_cast<int>(::syscall(SYS_fsync, descriptor)); }
extern "C" int rename(const char* from, const char* to) noexcept {
  if (kill_at_rename == Kill::before) ::raise(SIGKILL);
  const int result = fails_now() ? -1 : static_cast<int>(::syscall(SYS_renameat2, -100, from, -100, to, 0));
  if (kill_at_rename == Kill::after) ::raise(SIGKILL);
  return result;
}

namespace slapstick {
namespace {

struct AtomicFileTest : testing::Test {
  void SetUp() override {
    folder = fs::temp_directory_path() / ("slapstick-atomic-" + std::to_string(::getpid()));
    fs::create_directories(folder);
    path = folder / "out.csv";
  }
  void TearDown() override {
    calls_until_failure = 0;
    fs::remove_all(folder);
  }
  static std::string content(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }
  static std::string message(const fs::path& file) {
    try {
      write_atomically(file, "x");
    } catch (const StorageError& error) {
      return error.what();
    }
    return "written";
  }
  fs::path folder, path;
};

TEST_F(AtomicFileTest, bytes_arrive_whole_and_nothing_else_is_left) {
  std::string big(300000, 'a');
  big += std::string("\0\r\n", 3);
  write_atomically(path, big);
  EXPECT_EQ(content(path), big);
  write_atomically(path, "");
  EXPECT_EQ(content(path), "");
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFileTest, streamed_pieces_are_invisible_until_commit) {
  write_atomically(path, "old");
  AtomicFile file(path);
  for (int i = 0; i < 50000; ++i) file.write("0123456789");
  EXPECT_EQ(content(path), "old");
  file.commit();
  EXPECT_EQ(content(path).size(), 500000U);
  EXPECT_THROW(file.write("late"), StorageError);
  EXPECT_THROW(file.commit(), StorageError);
  EXPECT_EQ(content(path).size(), 500000U);
}

TEST_F(AtomicFileTest, abandoned_file_leaves_the_old_one) {
  write_atomically(path, "old");
  {
    AtomicFile file(path);
    file.write(std::string(200000, 'n'));
  }
  EXPECT_EQ(content(path), "old");
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFileTest, every_failing_system_call_keeps_old_or_new_and_no_rubbish) {
  const std::string fresh(200000, 'n');
  int failures = 0;
  for (int call = 1;; ++call) {
    calls_until_failure = 0;
    write_atomically(path, "old");
    calls_until_failure = call;
    try {
      write_atomically(path, fresh);
      break;
    } catch (const StorageError& error) {
      ++failures;
      EXPECT_NE(std::string(error.what()).find("No space left on device"), std::string::npos) << error.what();
      const auto now = content(path);
      EXPECT_TRUE(now == "old" || now == fresh) << "call " << call;
      EXPECT_EQ(files(), 1U) << "call " << call;
    }
  }
  EXPECT_GE(failures, 4);  // write, fsync, rename, fsync of the folder
}

TEST_F(AtomicFileTest, message_is_one_line_with_path_and_reason) {
  write_atomically(path, "a file");
  EXPECT_EQ(message(folder), "cannot write '" + folder.string() + "': Is a directory");
  EXPECT_EQ(message(path / "below"), "cannot write '" + (path / "below").string() + "': Not a directory");
  EXPECT_EQ(message(folder / "none" / "x"),
            "cannot write '" + (folder / "none" / "x").string() + "': No such file or directory");
  EXPECT_EQ(message(""), "cannot write '': No such file or directory");
  EXPECT_EQ(message("/dev/full"), "cannot write '/dev/full': No space left on device");
  EXPECT_EQ(message(folder / "none" / "a\nb").find('\n'), std::string::npos);
}

TEST_F(AtomicFileTest, device_is_written_and_not_replaced) {
  write_atomically("/dev/null", "x");
  struct stat status {};
  ASSERT_EQ(::stat("/dev/null", &status), 0);
  EXPECT_TRUE(S_ISCHR(status.st_mode));
}

TEST_F(AtomicFileTest, symbolic_link_and_permissions_survive) {
  const auto link = folder / "link.csv";
  write_atomically(path, "old");
  ASSERT_EQ(::chmod(path.c_str(), 0640), 0);
  fs::create_symlink(path, link);
  write_atomically(link, "new");
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(content(path), "new");
  EXPECT_EQ(static_cast<unsigned>(fs::status(path).permissions()), 0640U);
}

/// A process of its own that does something. @returns its number
pid_t begin(const std::function<void()>& something) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  something();
  ::_exit(0);
}

/// @returns the signal that ended the process, or 0
int end_of(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

TEST_F(AtomicFileTest, kill_at_the_moment_of_renaming_leaves_old_or_new_and_the_next_run_clears_up) {
  for (const Kill moment : {Kill::before, Kill::after}) {
    write_atomically(path, "old");
    const pid_t child = begin([&] {
      kill_at_rename = moment;
      write_atomically(path, "new");
    });
    ASSERT_EQ(end_of(child), SIGKILL);
    EXPECT_EQ(content(path), moment == Kill::before ? "old" : "new");
    EXPECT_EQ(files(), moment == Kill::before ? 2U : 1U);
    write_atomically(folder / "other.csv", "x");
    EXPECT_EQ(files(), 2U) << "the file and the other";
    EXPECT_EQ(content(path), moment == Kill::before ? "old" : "new");
    fs::remove(folder / "other.csv");
  }
}

TEST_F(AtomicFileTest, file_of_a_process_that_lives_stays_until_it_is_killed) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = begin([&] {
    AtomicFile file(path);
    file.write("half");
    (void)!::write(ready[1], "x", 1);
    ::pause();
  });
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  AtomicFile own(path);
  write_atomically(folder / "other.csv", "x");
  EXPECT_EQ(files(), 3U) << "the child's, our own and the other";
  ::kill(child, SIGKILL);
  ASSERT_EQ(end_of(child), SIGKILL);
  write_atomically(folder / "other.csv", "x");
  EXPECT_EQ(files(), 2U) << "our own and the other";
  own.write("whole");
  own.commit();
  EXPECT_EQ(content(path), "whole");
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST_F(AtomicFileTest, only_names_of_this_machine_and_of_this_form_are_removed) {
  const pid_t gone = begin([] {});
  ASSERT_EQ(end_of(gone), 0);
  const std::string name = temporary_name(path).filename().string();  // out.csv.tmp-MACHINE-PROCESS-SERIAL
  const std::string machine = name.substr(0, name.rfind("-" + std::to_string(::getpid()) + "-") + 1);
  const std::string dead = std::to_string(gone), other = machine.substr(0, machine.size() - 1) + "0-";
  const std::vector<std::string> strangers = {"out.csv.tmp-" + dead + "-0",
                                              other + dead + "-0",
                                              machine + dead,
                                              machine + dead + "-",
                                              machine + dead + "-0x",
                                              machine + dead + "-0-0",
                                              machine + "0-0",
                                              machine + "-1-0",
                                              machine + "99999999999-0",
                                              "out.csv.tmp",
                                              machine.substr(7) + dead + "-0"};
  for (const std::string& stranger : strangers) std::ofstream(folder / stranger) << "x";
  fs::create_directory(folder / (machine + dead + "-1"));
  for (const char* serial : {"-0", "-17"}) std::ofstream(folder / (machine + dead + serial)) << "x";
  write_atomically(path, "x");
  for (const std::string& stranger : strangers) EXPECT_TRUE(fs::exists(folder / stranger)) << stranger;
  EXPECT_EQ(files(), strangers.size() + 2);  // with the folder and the file
}

}  // namespace
}  // namespace slapstick
