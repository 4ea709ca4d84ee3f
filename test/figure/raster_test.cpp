#include "figure/raster.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "slapstick/base/error.hpp"
#include "workshop.hpp"

namespace slapstick::figure {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
const Window unit{};  // [0, 1] x [0, 1]

std::uint32_t at(const Counts& counts, int column, int row_from_top) {
  return counts.values[row_from_top * counts.width + column];
}

TEST(Raster, counts_every_point_once_and_puts_large_y_at_the_top) {
  const Counts c = count_points({0.1, 0.1, 0.9}, {0.1, 0.2, 0.9}, unit, 2, 2);
  EXPECT_EQ(c.values, (std::vector<std::uint32_t>{0, 1, 2, 0}));
}

TEST(Raster, a_point_on_an_inner_edge_belongs_to_one_pixel_and_the_outer_edges_are_inside) {
  const Counts c = count_points({0.0, 0.5, 1.0, 0.5}, {0.0, 0.5, 1.0, 0.0}, unit, 2, 2);
  EXPECT_EQ(c.values, (std::vector<std::uint32_t>{0, 2, 1, 1}));
}

TEST(Raster, points_outside_or_not_finite_are_left_out) {
  const Counts c =
      count_points({nan, 0.5, infinity, -infinity, 1.0001, 0.5}, {0.5, nan, 0.5, 0.5, 0.5, -1e-9}, unit, 3, 3);
  EXPECT_EQ(std::accumulate(c.values.begin(), c.values.end(), 0u), 0u);
}

TEST(Raster, decades_are_equally_wide_on_a_logarithmic_axis_and_zero_is_left_out) {
  const Window window{{1e-2, 1e1}, {0, 1}, true, false};
  const Counts c = count_points({0.05, 0.5, 5, 0, -1}, {0.5, 0.5, 0.5, 0.5, 0.5}, window, 3, 1);
  EXPECT_EQ(c.values, (std::vector<std::uint32_t>{1, 1, 1}));
}

TEST(Raster, total_is_kept_for_many_random_points) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0, 1);
  std::vector<double> x(100000), y(100000);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = place(random), y[i] = place(random);
  const Counts c = count_points(x, y, unit, 37, 23);
  EXPECT_EQ(std::accumulate(c.values.begin(), c.values.end(), 0u), 100000u);
}

TEST(Raster, spreading_reaches_all_eight_neighbours_and_no_further) {
  Counts c = count_points({0.5}, {0.5}, unit, 5, 5);
  spread_one_pixel(c);
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 5; ++column)
      EXPECT_EQ(at(c, column, row), std::max(std::abs(row - 2), std::abs(column - 2)) <= 1 ? 1u : 0u);
}

TEST(Raster, spreading_takes_the_maximum_and_does_not_wrap_around_the_edge) {
  Counts c{4, 1, {5, 0, 2, 0}};
  spread_one_pixel(c);
  EXPECT_EQ(c.values, (std::vector<std::uint32_t>{5, 5, 2, 2}));
  Counts corner{3, 3, {7, 0, 0, 0, 0, 0, 0, 0, 0}};
  spread_one_pixel(corner);
  EXPECT_EQ(corner.values, (std::vector<std::uint32_t>{7, 7, 0, 7, 7, 0, 0, 0, 0}));
}

TEST(Raster, tones_are_the_shares_of_the_non_empty_pixels) {
  const auto tone = equalised_tones({Counts{5, 1, {0, 1, 1, 3, 900}}});
  EXPECT_EQ(tone[0], 0.0);
  EXPECT_DOUBLE_EQ(tone[1], 0.5);
  EXPECT_DOUBLE_EQ(tone[3], 0.75);
  EXPECT_DOUBLE_EQ(tone[900], 1.0);
  EXPECT_TRUE(std::is_sorted(tone.begin(), tone.end()));
}

TEST(Raster, one_count_everywhere_gives_full_tone_and_none_gives_clear_paper) {
  EXPECT_EQ(equalised_tones({Counts{2, 1, {4, 0}}})[4], 1.0);
  const Raster empty = blend({Counts{2, 1, {0, 0}}}, {colours::black});
  EXPECT_EQ(empty.pixels, (std::vector<std::uint8_t>{0, 0}));
  EXPECT_EQ(empty.inks[0].opacity, 0);
}

/// What the eye sees on white paper.
std::array<double, 3> seen(const Ink& ink) {
  const double a = ink.opacity / 255.0;
  return {255 * (1 - a) + a * ink.colour.red, 255 * (1 - a) + a * ink.colour.green,
          255 * (1 - a) + a * ink.colour.blue};
}

double light(const Ink& ink) {
  const auto c = seen(ink);
  return c[0] + c[1] + c[2];
}

TEST(Raster, denser_is_darker_all_along_the_ramp) {
  Counts c{255, 1, std::vector<std::uint32_t>(255)};
  std::iota(c.values.begin(), c.values.end(), 1u);
  const Raster r = blend({c}, {colours::dark_blue});
  for (int i = 2; i < 255; ++i)
    EXPECT_LT(light(r.inks[r.pixels[i]]), light(r.inks[r.pixels[i - 2]])) << i;  // 2: 8 bits of opacity
}

TEST(Raster, full_tone_on_white_is_the_colour_asked_for) {
  for (const Colour colour : {colours::dark_blue, colours::vermillion, colours::black, colours::green}) {
    const Raster r = blend({Counts{1, 1, {3}}}, {colour});
    const auto c = seen(r.inks[r.pixels[0]]);
    EXPECT_NEAR(c[0], colour.red, 1.5);
    EXPECT_NEAR(c[1], colour.green, 1.5);
    EXPECT_NEAR(c[2], colour.blue, 1.5);
  }
}

TEST(Raster, what_only_one_sweep_finds_keeps_its_colour_and_what_both_find_is_dark) {
  const Raster r =
      blend({Counts{4, 1, {1, 0, 1, 0}}, Counts{4, 1, {0, 1, 1, 0}}}, {colours::dark_blue, colours::vermillion});
  const auto forward = seen(r.inks[r.pixels[0]]), backward = seen(r.inks[r.pixels[1]]);
  EXPECT_GT(forward[2], forward[0] + 100);
  EXPECT_GT(backward[0], backward[2] + 100);
  EXPECT_LT(light(r.inks[r.pixels[2]]), 60);
  EXPECT_EQ(r.pixels[3], 0);
}

TEST(Raster, the_order_of_the_sweeps_does_not_change_what_is_seen) {
  std::mt19937 random(3);
  Counts a{50, 40, std::vector<std::uint32_t>(2000)}, b = a;
  for (auto& v : a.values) v = static_cast<std::uint32_t>(random() % 5);
  for (auto& v : b.values) v = static_cast<std::uint32_t>(random() % 5);
  const Raster ab = blend({a, b}, {colours::dark_blue, colours::vermillion}),
               ba = blend({b, a}, {colours::vermillion, colours::dark_blue});
  for (std::size_t i = 0; i < a.values.size(); ++i) EXPECT_EQ(ab.inks[ab.pixels[i]], ba.inks[ba.pixels[i]]);
}

TEST(Raster, eight_series_still_fit_and_nine_are_refused) {
  const std::vector<Counts> eight(8, Counts{1, 1, {1}}), nine(9, Counts{1, 1, {1}});
  EXPECT_EQ(blend(eight, std::vector<Colour>(8)).pixels[0], 255);
  EXPECT_THROW(blend(nine, std::vector<Colour>(9)), InputError);
  EXPECT_THROW(blend({}, {}), InputError);
  EXPECT_THROW(blend({Counts{1, 1, {1}}, Counts{2, 1, {1, 1}}}, std::vector<Colour>(2)), InputError);
  EXPECT_THROW(count_points({1}, {}, unit, 2, 2), InputError);
}

/// Noise, long runs, repeated rows: every branch of the encoder.
Raster varied_image(int width, int height) {
  Raster r{width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height), {}};
  for (int i = 0; i < 256; ++i)
    r.inks.push_back({{static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(255 - i), 9}, 255});
  std::mt19937 random(11);
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      const bool noisy = i % 700 < 40 && j % 3 != 0, copied = j % 3 == 0 && j > 0 && i < width / 2;
      const std::size_t k = static_cast<std::size_t>(j) * width + i;
      r.pixels[k] = copied  ? r.pixels[k - width]
                    : noisy ? static_cast<std::uint8_t>(random())
                            : static_cast<std::uint8_t>(i / 600);
    }
  return r;
}

TEST(Raster, another_program_reads_back_every_pixel_of_the_png) {
  if (!workshop::gnuplot_exists()) GTEST_SKIP() << "gnuplot is not installed";
  for (const auto& [width, height] : {std::pair{2000, 30}, std::pair{3, 5}, std::pair{2, 2}, std::pair{40000, 3}}) {
    const workshop::Folder folder;
    const Raster r = varied_image(width, height);
    workshop::save(folder / "r.png", encode_png(r));
    const auto pixels = workshop::pixels(folder / "r.png");
    ASSERT_EQ(pixels.size(), r.pixels.size());
    for (const auto& p : pixels) {
      const int ink = r.pixels[static_cast<std::size_t>(height - 1 - p.row) * width + p.column];
      ASSERT_EQ(p.red, ink);
      ASSERT_EQ(p.green, 255 - ink);
    }
  }
}

Cells two_by_three() {
  return {.x = {0, 2},
          .y = {0, 3},
          .columns = 2,
          .rows = 3,
          .codes = {0, 1, 2, Cells::clear, 1, 0},
          .colours = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}}};
}

TEST(Raster, cells_stand_where_their_rectangle_says_with_the_lowest_row_below) {
  const Raster r = picture_of(two_by_three(), {{0, 2}, {0, 3}}, 4, 6);
  EXPECT_EQ(r.pixels,
            (std::vector<std::uint8_t>{2, 2, 1, 1, 2, 2, 1, 1, 3, 3, 0, 0, 3, 3, 0, 0, 1, 1, 2, 2, 1, 1, 2, 2}));
  EXPECT_EQ(r.inks.at(3), (Ink{{0, 0, 255}, 255}));
}

TEST(Raster, a_window_beyond_the_cells_shows_paper_there) {
  const Raster r = picture_of(two_by_three(), {{-2, 2}, {0, 6}}, 4, 6);
  EXPECT_EQ(r.pixels,
            (std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 1, 0, 0, 3, 0, 0, 0, 1, 2}));
}

TEST(Raster, cells_that_are_no_chart_are_refused) {
  const workshop::Folder folder;
  const auto refused = [&](const auto& change) {
    Figure figure{.panels = {Panel{.cells = two_by_three()}}};
    figure.panels[0].x_range = Range{0, 2}, figure.panels[0].y_range = Range{0, 3};
    change(figure.panels[0]);
    EXPECT_THROW(write(figure, folder / "c"), InputError);
  };
  refused([](Panel& panel) { panel.cells->codes.pop_back(); });
  refused([](Panel& panel) { panel.cells->codes[0] = 3; });
  refused([](Panel& panel) { panel.cells->rows = 0; });
  refused([](Panel& panel) { panel.log_x = true, panel.x_range = Range{1, 2}; });
  refused([](Panel& panel) { panel.points = {{.x = {1}, .y = {1}}}; });
}

}  // namespace
}  // namespace slapstick::figure
