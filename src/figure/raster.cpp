/// Counts points into the pixels of a density raster.
#include "figure/raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "slapstick/base/error.hpp"

namespace slapstick::figure {
namespace {

/// Maps a coordinate to a pixel index, or -1.
class PixelScale {
 public:
  PixelScale(Range range, bool log, int pixels)
      : log_(log),
        last_(pixels - 1),
        min_(place(range.min)),
        max_(place(range.max)),
        per_unit_(pixels / (max_ - min_)) {}

  int operator()(double value) const {
    const double at = place(value);
    if (!(at >= min_ && at <= max_)) return -1;  // also NaN
    return std::min(static_cast<int>((at - min_) * per_unit_), last_);
  }

 private:
  double place(double value) const { return log_ ? std::log10(value) : value; }
  bool log_;
  int last_;
  double min_, max_, per_unit_;
};

/// Opacity of an ink: tint for the rarest pixels, full for the most frequent.
double opacity(double tone) { return tone > 0 ? 0.30 + 0.70 * tone : 0.0; }

using Rgb = std::array<double, 3>;  // light reflected, 0..1

Rgb print(Rgb paper, Colour colour, double tone) {
  const double a = opacity(tone);
  const std::array<double, 3> ink{colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0};
  for (int i = 0; i < 3; ++i) paper[i] *= 1 - a + a * ink[i];
  return paper;
}

std::uint8_t byte(double unit) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(unit, 0.0, 1.0))); }

/// The most transparent ink that gives `seen` on white paper; shaded spans and grids below then shine through.
Ink ink_for(const Rgb& seen) {
  const double least = 1 - std::min({seen[0], seen[1], seen[2]});
  if (least <= 0) return {};
  const auto channel = [&](int i) { return byte((seen[i] - (1 - least)) / least); };
  return {{channel(0), channel(1), channel(2)}, byte(least)};
}

/// Tones per series such that all combinations, clear included, fit into 256 inks.
int tones_for(std::size_t series_count) {
  int tones = 255;
  const auto combinations = [&] { return std::pow(tones + 1, static_cast<double>(series_count)); };
  while (combinations() > 256.5) --tones;
  return tones;
}

std::vector<Ink> mix_inks(const std::vector<Colour>& colours, int tones) {
  std::size_t combinations = 1;
  for (std::size_t s = 0; s < colours.size(); ++s) combinations *= tones + 1;
  std::vector<Ink> inks(combinations);
  for (std::size_t i = 1; i < combinations; ++i) {
    Rgb seen{1, 1, 1};
    std::size_t rest = i;
    for (const Colour& colour : colours) {
      seen = print(seen, colour, static_cast<double>(rest % (tones + 1)) / tones);
      rest /= tones + 1;
    }
    inks[i] = ink_for(seen);
  }
  return inks;
}

}  // namespace

Counts count_points(const std::vector<double>& x, const std::vector<double>& y, const Window& window, int width,
                    int height) {
  if (width <= 0 || height <= 0) throw InputError("raster: width and height must be positive");
  if (x.size() != y.size()) throw InputError("raster: x and y differ in length");
  Counts counts{width, height, std::vector<std::uint32_t>(static_cast<std::size_t>(width) * height)};
  const PixelScale column(window.x, window.log_x, width), row(window.y, window.log_y, height);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const int across = column(x[i]), up = row(y[i]);
    if (across < 0 || up < 0) continue;
    auto& count = counts.values[static_cast<std::size_t>(height - 1 - up) * width + across];
    if (count < largest_count) ++count;
  }
  return counts;
}

void spread_one_pixel(Counts& counts) {
  const int width = counts.width, height = counts.height;
  std::vector<std::uint32_t> wide(counts.values.size());
  for (int j = 0; j < height; ++j) {  // along rows ...
    const auto* in = counts.values.data() + static_cast<std::size_t>(j) * width;
    auto* out = wide.data() + static_cast<std::size_t>(j) * width;
    for (int i = 0; i < width; ++i) out[i] = std::max({in[std::max(i - 1, 0)], in[i], in[std::min(i + 1, width - 1)]});
  }
  for (int j = 0; j < height; ++j) {  // ... then along columns
    const auto* above = wide.data() + static_cast<std::size_t>(std::max(j - 1, 0)) * width;
    const auto* here = wide.data() + static_cast<std::size_t>(j) * width;
    const auto* below = wide.data() + static_cast<std::size_t>(std::min(j + 1, height - 1)) * width;
    auto* out = counts.values.data() + static_cast<std::size_t>(j) * width;
    for (int i = 0; i < width; ++i) out[i] = std::max({above[i], here[i], below[i]});
  }
}

std::vector<double> equalised_tones(const std::vector<Counts>& series) {
  std::uint32_t largest = 0;
  for (const auto& counts : series)
    for (const auto count : counts.values) largest = std::max(largest, count);
  std::vector<double> tones(static_cast<std::size_t>(largest) + 1);
  for (const auto& counts : series)
    for (const auto count : counts.values) tones[count] += 1;
  tones[0] = 0;
  double sum = 0;
  for (auto& tone : tones) tone = sum += tone;
  if (sum > 0)
    for (auto& tone : tones) tone /= sum;
  return tones;
}

Raster blend(const std::vector<Counts>& series, const std::vector<Colour>& colours) {
  if (series.empty() || series.size() > largest_series_count)
    throw InputError("raster: 1 to 8 series can share an image");
  if (series.size() != colours.size()) throw InputError("raster: every series needs one colour");
  const int tones = tones_for(series.size());
  Raster raster{series[0].width, series[0].height, std::vector<std::uint8_t>(series[0].values.size()),
                mix_inks(colours, tones)};
  const auto tone = equalised_tones(series);
  int place = 1;  // of this series' tone in the index of the ink
  for (const auto& counts : series) {
    if (counts.width != raster.width || counts.height != raster.height)
      throw InputError("raster: series differ in size");
    std::vector<std::uint8_t> share(tone.size());
    for (std::size_t c = 1; c < tone.size(); ++c)
      share[c] = static_cast<std::uint8_t>(place * static_cast<int>(std::ceil(tone[c] * tones)));
    for (std::size_t i = 0; i < counts.values.size(); ++i)
      raster.pixels[i] = static_cast<std::uint8_t>(raster.pixels[i] + share[counts.values[i]]);
    place *= tones + 1;
  }
  return raster;
}

Raster picture_of(const Cells& cells, const Window& window, int width, int height) {
  Raster raster{width, height, {}, {}};
  raster.inks.push_back({});  // clear paper
  for (const Colour& colour : cells.colours) raster.inks.push_back({colour, 255});
  raster.pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  const auto place = [](const Range& shown, double share, const Range& of, int count) {
    const double at = shown.min + share * (shown.max - shown.min);
    const double cell = std::floor((at - of.min) / (of.max - of.min) * count);
    return cell >= 0.0 && cell < count ? static_cast<int>(cell) : -1;
  };
  std::vector<int> columns;
  for (int i = 0; i < width; ++i) columns.push_back(place(window.x, (i + 0.5) / width, cells.x, cells.columns));
  for (int j = 0; j < height; ++j) {
    const int row = place(window.y, (height - j - 0.5) / height, cells.y, cells.rows);
    for (int i = 0; i < width && row >= 0; ++i) {
      if (columns[static_cast<std::size_t>(i)] < 0) continue;
      const std::uint8_t code =
          cells.codes[static_cast<std::size_t>(row) * cells.columns + columns[static_cast<std::size_t>(i)]];
      if (code != Cells::clear)
        raster.pixels[static_cast<std::size_t>(j) * width + i] = static_cast<std::uint8_t>(code + 1);
    }
  }
  return raster;
}

}  // namespace slapstick::figure
