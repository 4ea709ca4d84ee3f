/// Figures that cannot be drawn or stored: one line of explanation, and the folder as it was.
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <limits>
#include <thread>

#include "figure/figure.hpp"
#include "slapstick/base/error.hpp"
#include "workshop.hpp"

namespace slapstick::figure {
namespace {

const Figure simple{.panels = {{.lines = {{.x = {0, 1}, .y = {0, 1}}}}}};

template <class Error>
std::string message(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing thrown";
}

/// PATH is only this folder while the object lives.
class OnlyPath {
 public:
  explicit OnlyPath(const std::string& folder) : before_(std::getenv("PATH")) { setenv("PATH", folder.c_str(), 1); }
  ~OnlyPath() { setenv("PATH", before_.c_str(), 1); }
  OnlyPath(const OnlyPath&) = delete;
  OnlyPath& operator=(const OnlyPath&) = delete;

 private:
  std::string before_;
};

void fake_gnuplot(const workshop::Folder& folder, const std::string& commands) {
  workshop::save(folder / "gnuplot", "#!/bin/sh\n" + commands);
  std::filesystem::permissions(folder / "gnuplot", std::filesystem::perms::owner_all);
}

TEST(FigureFailure, missing_folder_is_named) {
  const workshop::Folder folder;
  EXPECT_EQ(message<StorageError>([&] { write(simple, folder / "none/a"); }),
            "no such folder: " + (folder / "none").string());
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(FigureFailure, folder_that_cannot_be_written_is_named) {
  EXPECT_EQ(message<StorageError>([] { write(simple, "/proc/a"); }).rfind("cannot write into /proc: ", 0), 0u);
}

TEST(FigureFailure, without_gnuplot_nothing_is_left_behind) {
  const workshop::Folder folder, empty;
  const OnlyPath path(empty.path().string());
  EXPECT_EQ(message<StorageError>([&] { write(simple, folder / "a"); }), "gnuplot not found: install gnuplot-nox");
  EXPECT_EQ(message<StorageError>([] { demand_gnuplot(); }), "gnuplot not found: install gnuplot-nox");
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(FigureFailure, when_gnuplot_fails_the_earlier_figure_stays) {
  const workshop::Folder folder, bin;
  workshop::save(folder / "a.png", "earlier");
  fake_gnuplot(bin,
               "echo half > a.png; printf 'plot x\\n     ^\\n\"./a.gp\" line 3: no such thing\\n\\n' >&2; exit 1\n");
  const OnlyPath path(bin.path().string() + ":/bin:/usr/bin");
  EXPECT_EQ(message<StorageError>([&] { write(simple, folder / "a"); }),
            "gnuplot cannot draw a.gp: \"./a.gp\" line 3: no such thing");
  EXPECT_EQ(workshop::read(folder / "a.png"), "earlier");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(FigureFailure, a_killed_gnuplot_is_a_failure) {
  const workshop::Folder folder, bin;
  fake_gnuplot(bin, "echo half > a.png; kill -9 $$\n");
  const OnlyPath path(bin.path().string() + ":/bin:/usr/bin");
  EXPECT_EQ(message<StorageError>([&] { write(simple, folder / "a"); }),
            "gnuplot was ended by signal 9 while drawing a.gp");
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(FigureFailure, a_gnuplot_that_draws_nothing_is_a_failure) {
  const workshop::Folder folder, bin;
  fake_gnuplot(bin, "exit 0\n");
  const OnlyPath path(bin.path().string() + ":/bin:/usr/bin");
  EXPECT_THROW(write(simple, folder / "a"), StorageError);
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(FigureFailure, a_folder_in_the_place_of_a_file_is_found_before_anything_moves) {
  if (!workshop::gnuplot_exists()) GTEST_SKIP() << "gnuplot is not installed";
  const workshop::Folder folder;
  std::filesystem::create_directory(folder / "a.pdf");
  EXPECT_THROW(write(simple, folder / "a"), StorageError);
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(FigureFailure, the_caller_s_mistake_is_named_before_anything_is_written) {
  const workshop::Folder folder;
  const auto complaint = [&](const Figure& figure) {
    return message<InputError>([&] { write(figure, folder / "a"); });
  };
  EXPECT_EQ(complaint({}), "figure: no panels");
  EXPECT_EQ(complaint({.panels = {{}, {.lines = {{.x = {1, 2}, .y = {1}, .label = "v"}}}}}),
            "figure: panel 2, line 1 (v): x has 2 values, y has 1");
  EXPECT_EQ(complaint({.panels = {{.points = {{.x = {1}}}}}}), "figure: panel 1, points 1: x has 1 values, y has 0");
  EXPECT_NE(complaint({.panels = {{.x_range = Range{2, 1}}}}).find("panel 1: x range"), std::string::npos);
  EXPECT_NE(complaint({.panels = {{.y_range = Range{0, 1}, .log_y = true}}}).find("must be positive"),
            std::string::npos);
  EXPECT_NE(complaint({.panels = {{.x_range = Range{0, std::numeric_limits<double>::infinity()}}}}).find("x range"),
            std::string::npos);
  EXPECT_NE(complaint({.panels = {{}}, .width_cm = 1}).find("too narrow for panel 1"), std::string::npos);
  EXPECT_NE(complaint({.panels = {{}}, .height_cm = 1.2}).find("too low for row 1"), std::string::npos);
  EXPECT_NE(complaint({.panels = {{.marks = {{.label = "where?"}}}}}).find("a mark needs"), std::string::npos);
  EXPECT_NE(message<InputError>([&] { write(simple, folder.path() / ""); }).find("names no file"), std::string::npos);
  EXPECT_NE(message<InputError>([&] { write(simple, folder / "a\nb"); }).find("control character"), std::string::npos);
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(FigureFailure, figures_written_at_the_same_time_do_not_meet) {
  if (!workshop::gnuplot_exists()) GTEST_SKIP() << "gnuplot is not installed";
  const workshop::Folder folder;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back(
        [&folder, i] { write(simple, folder / (i < 2 ? "same" : "other" + std::to_string(i)), {.pdf = false}); });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(folder.entries(), 9u);  // three figures of script, table and PNG, and no scratch
  EXPECT_EQ(workshop::read(folder / "same.png"), workshop::read(folder / "other2.png"));
}

}  // namespace
}  // namespace slapstick::figure
