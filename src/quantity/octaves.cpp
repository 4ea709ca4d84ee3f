/// Bands of octaves and thirds, and the weighting A.
#include <algorithm>
#include <cmath>

#include "slapstick/base/error.hpp"
#include "slapstick/quantity/spectrum.hpp"

namespace slapstick {
namespace {

/// Centres 1000 G^(x / parts) Hz, G = 10^(3/10): octaves, and thirds of them. Edges half a band to either side.
std::vector<Band> bands(double lowest, double highest, int parts) {
  if (parts != 1 && parts != 3) throw InputError("octaves: parts are 1 or 3");
  std::vector<Band> all;
  if (!(lowest > 0.0 && highest >= lowest)) return all;
  const double G = std::pow(10.0, 0.3), half = std::pow(G, 0.5 / parts);
  const auto place = [&](double hertz) { return parts * std::log(hertz / 1000.0) / std::log(G); };
  for (double x = std::floor(place(lowest) + 0.5); x <= std::floor(place(highest) + 0.5); ++x) {
    const double centre = 1000.0 * std::pow(G, x / parts);
    all.push_back({centre, centre / half, centre * half, 0.0, 0.0, true});
  }
  return all;
}

/// A mean square at a frequency, and with the weight of that frequency: the weighting is steep beside a band.
void add(double mean_square, double hertz, Band& band) {
  band.mean_square += mean_square;
  band.weighted += mean_square * std::pow(10.0, 0.1 * a_weighting(hertz));
}

}  // namespace

std::vector<Band> octaves(const LineSpectrum& of, int parts, double unit_of_time) {
  if (of.lines.size() < 2) return {};
  std::vector<Band> all = bands(of.lines[1].frequency / unit_of_time, of.lines.back().frequency / unit_of_time, parts);
  for (const SpectralLine& line : of.lines) {
    const double hertz = line.frequency / unit_of_time;
    for (Band& band : all)
      if (hertz >= band.from && hertz < band.to) add(2.0 * std::norm(line.c), hertz, band);
  }
  const double next = of.lines.back().frequency + of.lines[1].frequency;  // the first line that is left out
  for (Band& band : all) band.whole = next / unit_of_time >= band.to;
  return all;
}

/// A point stands for the frequencies that are nearest to it.
std::vector<Band> octaves(const DensitySpectrum& of, int parts, double unit_of_time) {
  if (of.frequency.empty()) return {};
  constexpr double noise_bandwidth = 1.5;  // of the resolution, in steps of the frequencies
  const double step = of.frequency.size() > 1 ? of.frequency[1] - of.frequency[0] : of.resolution / noise_bandwidth;
  const double half = 0.5 * step / unit_of_time;
  std::vector<Band> all = bands(of.frequency.front() / unit_of_time, of.frequency.back() / unit_of_time, parts);
  for (std::size_t k = 0; k < of.frequency.size(); ++k) {
    const double hertz = of.frequency[k] / unit_of_time;
    for (Band& band : all) {
      const double from = std::max(band.from, hertz - half), to = std::min(band.to, hertz + half);
      if (to > from) add((to - from) * unit_of_time * of.density[k], 0.5 * (from + to), band);
    }
  }
  for (Band& band : all)
    band.whole =
        of.frequency.front() / unit_of_time - half <= band.from && of.frequency.back() / unit_of_time + half >= band.to;
  return all;
}

double a_weighting(double hertz) {
  constexpr double f1 = 20.598997, f2 = 107.65265, f3 = 737.86223, f4 = 12194.217;
  const double f = hertz * hertz;
  const double gain = f4 * f4 * f * f / ((f + f1 * f1) * std::sqrt((f + f2 * f2) * (f + f3 * f3)) * (f + f4 * f4));
  return 20.0 * std::log10(gain) + 1.9997;
}

}  // namespace slapstick
