#include "figure/figure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "workshop.hpp"

namespace slapstick::figure {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

class FigureTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!workshop::gnuplot_exists()) GTEST_SKIP() << "gnuplot is not installed";
  }
  workshop::Folder folder;
};

Points logistic_map(int parameters, int points_each, double start) {
  Points p{.label = "forward"};
  for (int k = 0; k < parameters; ++k) {
    const double r = 2.8 + 1.2 * k / (parameters - 1);
    double z = start;
    for (int i = -200; i < points_each; ++i) {
      z = r * z * (1 - z);
      if (i >= 0) p.x.push_back(r), p.y.push_back(z);
    }
  }
  return p;
}

Line sine(double amplitude, double length) {
  Line line{.label = "{/:Italic x}_1"};
  for (int i = 0; i <= 200; ++i) line.x.push_back(length * i / 200), line.y.push_back(amplitude * std::sin(0.1 * i));
  return line;
}

/// Ink on the outermost pixels means that something is cut off.
bool touches_the_edge(const std::filesystem::path& png) {
  const auto pixels = workshop::pixels(png);
  int right = 0, top = 0;
  for (const auto& p : pixels) right = std::max(right, p.column), top = std::max(top, p.row);
  return std::any_of(pixels.begin(), pixels.end(), [&](const workshop::Pixel& p) {
    return (p.column == 0 || p.row == 0 || p.column == right || p.row == top) && p.red + p.green + p.blue < 3 * 250;
  });
}

TEST_F(FigureTest, writes_script_data_and_both_formats) {
  const Files files = write({.panels = {{.x_label = "t", .lines = {sine(1, 9)}}}}, folder / "a");
  EXPECT_EQ(files.script, folder / "a.gp");
  EXPECT_EQ(files.data, folder / "a-plot.csv") << "a.csv is the name of a user's own table";
  EXPECT_EQ(workshop::read(files.png).substr(1, 3), "PNG");
  EXPECT_EQ(workshop::read(files.pdf).substr(0, 4), "%PDF");
  EXPECT_TRUE(files.svg.empty());
  EXPECT_TRUE(files.rasters.empty());
  EXPECT_EQ(folder.entries(), 4u);
}

TEST_F(FigureTest, an_author_redraws_the_same_picture_from_the_folder_alone) {
  const Figure figure{.panels = {{.points = {logistic_map(300, 100, 0.4)}}, {.lines = {sine(1, 9)}}}, .share_x = false};
  const Files files = write(figure, folder / "a", {true, true, true});
  workshop::Folder elsewhere;
  for (const auto& file : {files.script, files.data, files.rasters.at(0)})
    std::filesystem::copy(file, elsewhere / file.filename().string());
  ASSERT_TRUE(workshop::redraw(elsewhere.path(), "a.gp"));
  EXPECT_EQ(workshop::read(elsewhere / "a.png"), workshop::read(files.png));
  EXPECT_EQ(workshop::read(elsewhere / "a.svg"), workshop::read(files.svg));
  EXPECT_EQ(workshop::read(elsewhere / "a.pdf").size(), workshop::read(files.pdf).size());  // a PDF holds its date
}

TEST_F(FigureTest, many_points_become_one_small_image_and_no_table) {
  Points backward = logistic_map(500, 100, 0.6);
  backward.colour = colours::vermillion;
  const Files files = write({.panels = {{.points = {logistic_map(500, 100, 0.4), backward}}}}, folder / "a");
  EXPECT_EQ(files.rasters, std::vector{folder / "a-raster1.png"});
  EXPECT_TRUE(files.data.empty());
  EXPECT_LT(std::filesystem::file_size(files.pdf), 400000u);
}

TEST_F(FigureTest, where_two_named_clouds_overlap_in_an_image_the_legend_says_both) {
  Points a = logistic_map(300, 100, 0.4), b = logistic_map(300, 100, 0.6);
  a.label = "up", b.label = "down";
  a.colour = {255, 102, 0}, b.colour = {102, 255, 255};
  const auto says_both = [&](const std::vector<Points>& points) {
    const std::string script =
        workshop::read(write({.panels = {{.points = points}}}, folder / "a", {.pdf = false}).script);
    return script.find("lc rgb '#666600' title 'both'") != std::string::npos;
  };
  EXPECT_TRUE(says_both({a, b}));
  EXPECT_FALSE(says_both({a}));
  a.drawing = b.drawing = Drawing::discs;
  EXPECT_FALSE(says_both({a, b}));
}

/// Lines that mark a value go through the whole frame, also through a corner without data.
TEST_F(FigureTest, no_mark_crosses_the_legend) {
  const auto key = [&](const std::vector<Mark>& marks) {
    const Panel panel{
        .x_range = Range{0, 1}, .y_range = Range{0, 1}, .points = {{{0.5}, {0.5}, "data"}}, .marks = marks};
    const std::string script = workshop::read(write({.panels = {panel}}, folder / "a", {.pdf = false}).script);
    return script.substr(script.find("\n  set key ") + 11, 25);
  };
  EXPECT_EQ(key({}), "inside vertical top right");
  EXPECT_EQ(key({{.x = 0.4}}), "inside vertical top right");
  EXPECT_EQ(key({{.x = 0.95}}), "inside vertical top left ");
  EXPECT_EQ(key({{.y = 0.95}}), "inside vertical bottom ri");
  EXPECT_EQ(key({{.x = 0.95}, {.x = 0.05}}).substr(0, 9), "at screen");
}

TEST_F(FigureTest, clouds_that_are_many_points_together_are_an_image) {
  const Points half{.x = std::vector<double>(raster_threshold / 2 + 1, 1), .y = half.x};
  EXPECT_EQ(write({.panels = {{.points = {half, half}}}}, folder / "a", {.pdf = false}).rasters.size(), 1U);
  EXPECT_EQ(write({.panels = {{.points = {half}}}}, folder / "b", {.pdf = false}).rasters.size(), 0U);
  EXPECT_NO_THROW(write({.panels = {{.points = std::vector<Points>(9, half)}}}, folder / "c", {.pdf = false}));
}

/// Few marked points over a dense cloud are not lost in its image.
TEST_F(FigureTest, discs_beside_an_image_stay_discs) {
  const Points marked{.x = {3.0, 3.5}, .y = {0.5, 0.4}, .drawing = Drawing::discs, .diameter_mm = 0.9};
  const Files files = write({.panels = {{.points = {logistic_map(400, 100, 0.3), marked}}}}, folder / "a");
  EXPECT_EQ(files.rasters.size(), 1U);
  EXPECT_NE(workshop::read(files.script).find("with points pt 7"), std::string::npos);
  EXPECT_NE(workshop::read(files.data).find("3.5,0.4"), std::string::npos);
}

TEST_F(FigureTest, numbers_of_an_axis_have_at_most_eight_digits) {
  for (const double span : {1e-3, 1e-5, 2e-6, 1e-7, 1e-8, 2e-9}) {
    const Points p{.x = {0.4859871, 0.4859871 + span}, .y = {-1.4582, -1.4582 - span}};
    const std::string script =
        workshop::read(write({.panels = {{.points = {p}}}}, folder / "a", {.pdf = false}).script);
    for (const std::string axis : {"set format x '%.", "set format y '%."})
      EXPECT_LE(std::stoi(script.substr(script.find(axis) + axis.size())), 8) << span;
  }
}

TEST_F(FigureTest, same_figure_same_bytes) {
  const Figure figure{.panels = {{.points = {logistic_map(300, 100, 0.4)}, .lines = {sine(1, 3)}}}};
  const Files a = write(figure, folder / "a", {.pdf = false});
  const std::string png = workshop::read(a.png), script = workshop::read(a.script),
                    raster = workshop::read(a.rasters[0]);
  const Files again = write(figure, folder / "a", {.pdf = false});
  EXPECT_EQ(workshop::read(again.png), png);
  EXPECT_EQ(workshop::read(again.script), script);
  EXPECT_EQ(workshop::read(again.rasters[0]), raster);
}

TEST_F(FigureTest, empty_constant_and_undrawable_series_do_not_break_ranges) {
  const std::vector<std::vector<double>> columns{{},
                                                 {0, 0, 0},
                                                 {-3, -3, -3},
                                                 {1e-300, 1e-300, 1e-300},
                                                 {1e149, 1e149, 1e149},
                                                 {nan, infinity, -infinity},
                                                 {1e200, -1e200, 0},
                                                 {1, 1 + 1e-15, 1},
                                                 {5}};
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (const bool log : {false, true}) {
      const Points p{.x = columns[i], .y = columns[i], .label = "p"};
      const Points raster{.x = columns[i], .y = columns[i], .drawing = Drawing::raster};
      const Line line{.x = columns[i], .y = columns[i]};
      Figure figure{.panels = {{.log_x = log, .log_y = log, .points = {p}, .lines = {line}},
                               {.log_x = log, .log_y = log, .points = {raster}}}};
      figure.png_dpi = 75;
      EXPECT_NO_THROW(write(figure, folder / "a")) << "column " << i << ", log " << log;
    }
}

TEST_F(FigureTest, a_panel_with_nothing_in_it_has_axes) { EXPECT_NO_THROW(write({.panels = {{}}}, folder / "a")); }

TEST_F(FigureTest, not_a_number_breaks_the_line_and_reaches_the_table_as_such) {
  const Line broken{.x = {0, 1, 2, 3, 4}, .y = {0, 1, nan, infinity, 4}};
  const Files files = write({.panels = {{.tag = "(a)", .lines = {broken}}}}, folder / "a", {.pdf = false});
  EXPECT_EQ(workshop::read(files.data), "\"(a) line 1 x\",\"(a) line 1 y\"\n0,0\n1,1\nNaN,NaN\nNaN,NaN\n4,4\n");
}

TEST_F(FigureTest, tables_of_unequal_columns_stay_rectangular_and_round_trip) {
  const Line one{.x = {0.1}, .y = {1.0 / 3}, .label = "a \"b\", c"}, two{.x = {1, 2}, .y = {3, 4}};
  const Files files = write({.panels = {{.lines = {one, two}}}}, folder / "a", {.pdf = false});
  EXPECT_EQ(workshop::read(files.data),
            "\"panel 1 a \"\"b\"\", c x\",\"panel 1 a \"\"b\"\", c y\",\"panel 1 line 2 x\",\"panel 1 line 2 y\"\n"
            "0.1,0.3333333333333333,1,3\n,,2,4\n");
}

TEST_F(FigureTest, labels_and_names_never_run_as_commands) {
  const std::string evil = "'; system('touch owned') # `touch owned` \"$(touch owned)\n} @x { \\";
  for (const std::string stem : {"a", "it's <a> |b `touch owned` $x", "<touch owned", "|touch owned", "-e"}) {
    Figure figure{.panels = {{.x_label = evil,
                              .y_label = evil,
                              .tag = evil,
                              .title = evil,
                              .points = {logistic_map(300, 100, 0.4)},
                              .lines = {sine(1, 3)},
                              .marks = {{.x = 1, .label = evil},
                                        {.x = 1, .x_end = 2, .label = evil},
                                        {.y = 0, .label = evil},
                                        {.x = 1, .y = 0, .label = evil}}}},
                  .width_cm = 17.5,
                  .caption = evil + "\nsystem('touch owned')"};
    figure.panels[0].points[0].label = figure.panels[0].lines[0].label = evil;
    const Files files = write(figure, folder / stem);
    EXPECT_TRUE(std::filesystem::exists(files.png));
    EXPECT_FALSE(std::filesystem::exists(folder / "owned"));
    EXPECT_FALSE(std::filesystem::exists("owned"));
  }
}

TEST_F(FigureTest, frames_of_a_column_align_however_wide_their_numbers) {
  const Figure figure{.panels = {{.y_label = "a", .lines = {sine(1, 9)}},
                                 {.lines = {sine(12345.678, 9)}},
                                 {.y_label = "c", .lines = {sine(1e-7, 9)}}},
                      .share_x = true};
  const std::string script = workshop::read(write(figure, folder / "a", {.pdf = false}).script);
  const std::string key = "set lmargin ";
  const std::size_t first = script.find(key);
  const std::string margins = script.substr(first, script.find('\n', first) - first);
  int times = 0;
  for (std::size_t at = script.find(margins); at != std::string::npos; at = script.find(margins, at + 1)) ++times;
  EXPECT_EQ(times, 3);
}

TEST_F(FigureTest, nothing_is_cut_off) {
  const Mark left{.x = 0, .label = "a long label at the left end"},
      right{.x = 9, .label = "a long label at the right end"};
  const std::vector<Panel> panels{
      {.x_label = "forcing frequency {/:Italic ω}",
       .y_label = "a name of a quantity taller than its axis [m/s]",
       .tag = "(a)",
       .lines = {sine(1, 9)}},
      {.x_label = "x", .y_label = "y", .lines = {sine(1e-7, 9e6)}},
      {.x_label = "x_{1,2}", .y_label = "y^{2}", .lines = {sine(12345, 0.00123)}},
      {.x_label = "x",
       .y_label = "y",
       .tag = "(b)",
       .title = "title",
       .lines = {sine(1, 9)},
       .marks = {left, right, {.x = 4, .x_end = 5, .label = "1-1-I"}},
       .legend = Legend::above},
      {.x_label = "x", .y_label = "y", .log_x = true, .log_y = true, .lines = {sine(1e-12, 1e12)}},
      {.lines = {sine(1, 9.0001)}}};
  for (const double width : {8.5, 5.0})
    for (std::size_t i = 0; i < panels.size(); ++i) {
      Figure figure{.panels = {panels[i]}, .width_cm = width};
      figure.png_dpi = 100;
      EXPECT_FALSE(touches_the_edge(write(figure, folder / "a", {.pdf = false}).png))
          << "panel " << i << ", width " << width;
    }
}

/// A legend of many entries takes paper of its own, in rows that stay on it.
TEST_F(FigureTest, a_legend_below_makes_the_figure_higher_and_not_the_frame_lower) {
  Panel panel{.x_label = "x", .y_label = "y", .lines = {sine(1, 9)}};
  const auto frame = [&](const Panel& of) {
    Figure figure{.panels = {of}};
    figure.png_dpi = 100;
    const Files files = write(figure, folder / "a", {.pdf = false});
    EXPECT_FALSE(touches_the_edge(files.png));
    int rows = 0;
    for (const auto& pixel : workshop::pixels(files.png)) rows = std::max(rows, pixel.row + 1);
    const std::string script = workshop::read(files.script);
    double b = 0, t = 0;
    std::sscanf(script.c_str() + script.find("set bmargin"), "set bmargin at screen %lf; set tmargin at screen %lf", &b,
                &t);
    return (t - b) * rows;
  };
  const double bare = frame(panel);
  panel.legend = Legend::below;
  for (int i = 0; i < 30; ++i) panel.keys.push_back({.label = std::to_string(i) + ": a branch", .group = i % 3});
  panel.lines[0].label = "a line with a name";
  EXPECT_NEAR(frame(panel), bare, 2.0);
  const std::string script = workshop::read(folder / "a.gp");
  for (const char* text : {"'0: a branch'", "'29: a branch'", "'a line with a name'"})
    EXPECT_NE(script.find(std::string("set label ") + text + " at screen"), std::string::npos) << text;
}

/// Of the marker on a line neither is hidden by the order of drawing.
TEST_F(FigureTest, markers_over_lines_are_drawn_last_and_have_their_shape) {
  Points marked{.x = {1}, .y = {0}, .drawing = Drawing::discs, .marker = Marker::delta, .over_lines = true};
  const std::string script = workshop::read(
      write({.panels = {{.points = {marked}, .lines = {sine(1, 9)}}}}, folder / "a", {.pdf = false}).script);
  const auto points = script.find("with points pt 8"), lines = script.find("with lines");
  ASSERT_NE(points, std::string::npos);
  EXPECT_GT(points, lines);
}

TEST_F(FigureTest, the_raster_lies_where_the_axes_say) {
  // A lone disc of points in the middle of the lower left quarter, on linear and on logarithmic axes.
  for (const bool log : {false, true}) {
    const double low = log ? std::pow(10.0, 0.25) : 0.25, max = log ? 10 : 1, min = log ? 1 : 0;
    const Points p{.x = {low}, .y = {low}, .colour = {255, 0, 0}, .drawing = Drawing::raster};
    const Range range{min, max};
    Figure figure{.panels = {{.x_range = range, .y_range = range, .log_x = log, .log_y = log, .points = {p}}}};
    figure.png_dpi = 100;
    const Files files = write(figure, folder / "a", {.pdf = false});
    const auto pixels = workshop::pixels(files.png);
    double x = 0, y = 0, n = 0;
    for (const auto& q : pixels)
      if (q.red > 200 && q.green < 100) x += q.column, y += q.row, n += 1;
    const std::string script = workshop::read(files.script);
    double l = 0, r = 0, b = 0, t = 0;
    std::sscanf(
        script.c_str() + script.find("set lmargin"),
        "set lmargin at screen %lf; set rmargin at screen %lf\n  set bmargin at screen %lf; set tmargin at screen %lf",
        &l, &r, &b, &t);
    const double width = 335, height = 220;  // pixels of 8.5 cm x 5.6 cm at 100 dpi
    ASSERT_GE(n, 4);
    EXPECT_NEAR(x / n, width * (l + 0.25 * (r - l)), 2.0);
    EXPECT_NEAR(y / n, height * (b + 0.25 * (t - b)), 2.0);
  }
}

}  // namespace
}  // namespace slapstick::figure
