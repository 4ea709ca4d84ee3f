#pragma once
/// Pictures of spectra: lines of a cycle, densities, bands.
#include <string>

#include "figure/figure.hpp"
#include "slapstick/quantity/spectrum.hpp"

namespace slapstick::app {

struct SpectrumLabels {
  std::string name, unit;
  bool decibels = true;
  double reference = 1.0;
  bool forced = true;
};

[[nodiscard]] figure::Figure lines_figure(const LineSpectrum& found, const SpectrumLabels& labels);
[[nodiscard]] figure::Figure density_figure(const DensitySpectrum& found, const SpectrumLabels& labels);
[[nodiscard]] figure::Figure bands_figure(const std::vector<Band>& bands, const SpectrumLabels& labels, bool weighted);

/// Decibels of a band's root mean square over the reference.
[[nodiscard]] double level(const Band& band, double reference, bool weighted);

}  // namespace slapstick::app
