/// Insets: where they lie, what they show, what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <random>
#include <tuple>

#include "figure/figure.hpp"
#include "figure/layout.hpp"
#include "slapstick/base/error.hpp"
#include "workshop.hpp"

namespace slapstick::figure {
namespace {

namespace fs = std::filesystem;

/// Cells in a square of side 1, a colour for each code.
Panel chart(int side, const std::function<int(int, int)>& code) {
  Cells cells{.x = {0, 1},
              .y = {0, 1},
              .columns = side,
              .rows = side,
              .codes = {},
              .colours = {{200, 0, 0}, {0, 200, 0}, {0, 0, 200}, {90, 90, 90}}};
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) cells.codes.push_back(static_cast<std::uint8_t>(code(i, j)));
  return {.x_label = "x", .y_label = "y", .x_range = Range{0, 1}, .y_range = Range{0, 1}, .cells = std::move(cells)};
}

Figure one(Panel panel) { return {.panels = {std::move(panel)}, .width_cm = 12, .row_cm = 8.5}; }

bool within(const Box& inner, const Box& outer) {
  return inner.left >= outer.left && inner.right <= outer.right && inner.bottom >= outer.bottom &&
         inner.top <= outer.top;
}
bool apart(const Box& a, const Box& b) {
  return a.right <= b.left || b.right <= a.left || a.top <= b.bottom || b.top <= a.bottom;
}
bool inside(const Box& box, double x, double y) {
  constexpr double rim = 1e-9;
  return x > box.left + rim && x < box.right - rim && y > box.bottom + rim && y < box.top - rim;
}

TEST(Inset, covers_no_rectangle_that_is_shown_and_its_lines_cross_neither_box) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0.0, 0.85), size(0.03, 0.15);
  for (int k = 0; k < 300; ++k) {
    Panel panel = chart(8, [](int i, int) { return i % 2; });
    for (int i = 0; i <= k % 2; ++i) {
      const double x = place(random), y = place(random);
      panel.insets.push_back({{x, x + size(random)}, {y, y + size(random)}});
    }
    const PanelLayout at = lay_out(one(panel)).panels[0];
    ASSERT_EQ(at.insets.size(), panel.insets.size());
    for (const InsetLayout& inset : at.insets) {
      EXPECT_TRUE(within(inset.outer, at.frame));
      EXPECT_TRUE(within(inset.frame, inset.outer));
      for (const InsetLayout& other : at.insets) {
        EXPECT_TRUE(apart(inset.outer, other.source));
        EXPECT_TRUE(&other == &inset || apart(inset.outer, other.outer));
      }
      EXPECT_EQ(inset.joined.size(), 2U);
      for (const int corner : inset.joined)
        for (int s = 1; s < 200; ++s) {
          const double f = s / 200.0;
          const double x = (1 - f) * corner_x(inset.source, corner) + f * corner_x(inset.frame, corner);
          const double y = (1 - f) * corner_y(inset.source, corner) + f * corner_y(inset.frame, corner);
          EXPECT_FALSE(inside(inset.source, x, y) || inside(inset.frame, x, y));
        }
    }
  }
}

TEST(Inset, lies_in_the_corner_that_hides_least) {
  const Inset middle{{0.47, 0.53}, {0.47, 0.53}};
  for (const int empty : {0, 1, 2, 3}) {
    Panel panel = chart(40, [&](int i, int j) { return 2 * (j / 20) + i / 20 == empty ? 3 : (i + j) % 2; });
    panel.insets = {middle};
    const InsetLayout at = lay_out(one(panel)).panels[0].insets[0];
    EXPECT_EQ(2 * at.top + at.right, empty);
  }
  Panel curve{
      .x_range = Range{0, 1}, .y_range = Range{0, 1}, .lines = {{.x = {0, 1}, .y = {0, 1}}}, .insets = {middle}};
  curve.points = {
      {.x = std::vector<double>(1000, 0.9), .y = std::vector<double>(1000, 0.1)}};  // many at one place hide one place
  const InsetLayout at = lay_out(one(curve)).panels[0].insets[0];
  EXPECT_FALSE(at.right);
  EXPECT_TRUE(at.top);
}

class InsetFiles : public testing::Test {
 protected:
  void SetUp() override {
    if (!workshop::gnuplot_exists()) GTEST_SKIP() << "gnuplot is not installed";
  }
  workshop::Folder folder;
};

/// Two by two cells of a chart of ten by ten: each is a quarter of the inset's image.
TEST_F(InsetFiles, shows_the_same_cells_enlarged) {
  Panel panel = chart(10, [](int i, int j) { return i / 5 + 2 * (j / 5); });
  panel.insets = {{{0.4, 0.6}, {0.4, 0.6}}};
  const Files files = write(one(panel), folder / "a", {.pdf = false});
  ASSERT_EQ(files.rasters.size(), 2U);
  EXPECT_EQ(files.rasters[1], folder / "a-raster1-inset1.png");
  const auto pixels = workshop::pixels(files.rasters[1]);
  int width = 0, height = 0;
  for (const auto& pixel : pixels) width = std::max(width, pixel.column + 1), height = std::max(height, pixel.row + 1);
  const std::vector<Colour>& colours = panel.cells->colours;
  for (const auto& pixel : pixels) {
    const int code = (2 * pixel.column >= width ? 1 : 0) + (2 * pixel.row >= height ? 2 : 0);
    const Colour& wanted = colours[static_cast<std::size_t>(code)];
    if (std::abs(2 * pixel.column - width) <= 2 || std::abs(2 * pixel.row - height) <= 2) continue;
    ASSERT_EQ(std::tie(pixel.red, pixel.green, pixel.blue), std::make_tuple(wanted.red, wanted.green, wanted.blue))
        << pixel.column << ' ' << pixel.row;
  }
}

TEST_F(InsetFiles, are_drawn_in_every_format_and_leave_the_next_panel_as_it_was) {
  Panel first = chart(10, [](int i, int j) { return (i + j) % 4; });
  first.insets = {{{0.1, 0.2}, {0.1, 0.2}}, {{0.7, 0.8}, {0.45, 0.55}}};
  first.lines = {{.x = {0, 0.5, 1}, .y = {0, 0.3, 1}}};
  Panel last{.x_label = "t", .y_label = "w", .lines = {{.x = {0, 1}, .y = {0, 1}}}};
  const Figure figure{.panels = {first, last}};
  const auto rest = [](const std::string& script) { return script.substr(script.find("# ---- panel 2")); };
  Figure without = figure;
  without.panels[0].insets.clear();
  const Files all = write(figure, folder / "a", {.svg = true}), plain = write(without, folder / "b", {.svg = true});
  std::string second = rest(workshop::read(plain.script));
  for (std::size_t at = second.find("./b-plot"); at != std::string::npos; at = second.find("./b-plot"))
    second.replace(at, 8, "./a-plot");
  EXPECT_EQ(rest(workshop::read(all.script)), second);
  for (const Formats formats :
       {Formats{.png = false, .pdf = false, .tex = true}, Formats{.png = false, .pdf = false, .py = true}}) {
    const Files files = write(figure, folder / "c", formats);
    EXPECT_TRUE(fs::exists(formats.tex ? files.tex : files.py));
  }
  const std::string script = workshop::read(folder / "c.py");
  EXPECT_NE(script.find("inset_axes"), std::string::npos);
  EXPECT_NE(script.find("c-raster1-inset2.png"), std::string::npos);
}

TEST(Inset, is_refused_where_it_cannot_be_drawn) {
  const auto refused = [](const Inset& inset, const std::string& why, bool log = false) {
    Panel panel{.x_range = Range{1, 2},
                .y_range = Range{1, 2},
                .log_x = log,
                .lines = {{.x = {1, 2}, .y = {1, 2}}},
                .insets = {inset}};
    try {
      demand_room(one(panel));
      ADD_FAILURE() << why;
    } catch (const InputError& error) {
      EXPECT_NE(error.message().find(why), std::string::npos) << error.message();
      EXPECT_NE(error.message().find("panel 1"), std::string::npos) << error.message();
    }
  };
  refused({{1, 2}, {1, 2}}, "finds no corner");
  refused({{3, 4}, {1, 1.2}}, "shows nothing");
  refused({{1.2, 1.1}, {1, 1.2}}, "min < max");
  refused({{1.1, 1.2}, {1.1, 1.2}}, "linear axes", true);
  Panel five{
      .x_range = Range{0, 1}, .y_range = Range{0, 1}, .insets = std::vector<Inset>(5, {{0.5, 0.51}, {0.5, 0.51}})};
  EXPECT_THROW(demand_room(one(five)), InputError);
}

}  // namespace
}  // namespace slapstick::figure
