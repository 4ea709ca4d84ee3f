/// Statistics by name.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/nearest.hpp"
#include "base/text.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/quantity/measure.hpp"

namespace slapstick {
namespace {

const std::vector<std::string>& names() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> made;
    for (const StatisticRule& rule : statistic_rules())
      if (rule.name[0] != 'q' && rule.name[0] != 'h') made.emplace_back(rule.name);
    return made;
  }();
  return all;
}

/// The part in [0, 1] of "q05" .. "q95", or -1.
double part_of(const std::string& name) {
  const bool digits = name.size() == 3 && name[0] == 'q' &&
                      std::all_of(name.begin() + 1, name.end(), [](char c) { return c >= '0' && c <= '9'; });
  return digits ? ((name[1] - '0') * 10 + (name[2] - '0')) / 100.0 : -1.0;
}

/// "h3" and "h3:phase".
struct Harmonic {
  int k = 0;  ///< 0: another name
  bool phase = false;
};

Harmonic harmonic_of(const std::string& name) {
  const auto colon = name.find(':');
  const bool phase = colon != std::string::npos;
  for (int k = 1; k <= most_harmonics; ++k)
    if (name.substr(0, colon) == "h" + std::to_string(k) && (!phase || name.substr(colon) == ":phase"))
      return {k, phase};
  return {};
}

[[noreturn]] void refuse_harmonic(const std::string& name) {
  throw InputError(in_quotes(name) + ": a harmonic is of a cycle: orbit, continue and measure have it");
}

/// amplitude cos(k w t + phase) = Re(c exp(i k w t)), as the lines of a spectrum.
double value_of(const std::vector<std::complex<double>>& harmonics, Harmonic of) {
  const std::complex<double> c = harmonics[static_cast<std::size_t>(of.k - 1)];
  return of.phase ? std::arg(c) : std::abs(c);
}

/// |c|' = Re(conj(c) c') / |c|, arg(c)' = Im(c' / c).
double rate_of(const std::vector<std::complex<double>>& harmonics, const std::vector<std::complex<double>>& rates,
               Harmonic of) {
  const auto at = static_cast<std::size_t>(of.k - 1);
  const std::complex<double> part = rates[at] / harmonics[at];
  return of.phase ? part.imag() : part.real() * std::abs(harmonics[at]);
}

}  // namespace

std::span<const StatisticRule> statistic_rules() {
  static constexpr std::array rules = {
      StatisticRule{"mean", "integral over the time by the time, impulses included"},
      StatisticRule{"rms", "root of the mean square between impacts"},
      StatisticRule{"min", "least value"},
      StatisticRule{"max", "greatest value"},
      StatisticRule{"min_at", "instant of the least value, from phase 0 on"},
      StatisticRule{"max_at", "instant of the greatest value, from phase 0 on"},
      StatisticRule{"peak_to_peak", "max - min"},
      StatisticRule{"crest", "largest absolute value over rms"},
      StatisticRule{"impulse", "sum of the impulses"},
      StatisticRule{"number", "how many impulses there are"},
      StatisticRule{"h1 .. h16",
                    "of cycles: amplitude of a harmonic of omega, without forcing of the cycle's frequency"},
      StatisticRule{"h1:phase .. h16:phase", "its phase: amplitude cos(k omega t + phase), as in spectrum"},
      StatisticRule{"q05 .. q95", "of quantities at impacts: quantiles, the part in percent"},
  };
  return rules;
}

double Statistics::crest() const { return std::max(std::abs(least), std::abs(greatest)) / rms; }

double Statistics::quantile(double q) const {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double place = std::ceil(q * static_cast<double>(values.size())) - 1.0;
  return values[static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(values.size() - 1)))];
}

/// Mean, rms, least, greatest, their instants, impulses and values are linear in what they are derivatives of; the
/// others are not.
double statistic_rate(const Statistics& of, const Statistics& rate, const std::string& name) {
  if (const Harmonic harmonic = harmonic_of(name); harmonic.k > 0) {
    if (of.harmonics.empty()) refuse_harmonic(name);
    return rate_of(of.harmonics, rate.harmonics, harmonic);
  }
  if (name != "crest" && name != "number") return statistic(rate, name);
  if (name == "number") return 0.0;
  const bool below = std::abs(of.least) > std::abs(of.greatest);
  const double largest = below ? -rate.least : of.greatest < 0.0 ? -rate.greatest : rate.greatest;
  return (largest - of.crest() * rate.rms) / of.rms;
}

void check_statistic(const Quantity& quantity, const std::string& name) {
  if (std::find(names().begin(), names().end(), name) != names().end()) return;
  if (part_of(name) >= 0.0) {
    if (quantity.at_impacts()) return;
    throw InputError(in_quotes(quantity.name + ":" + name) + ": quantiles are of quantities at impacts");
  }
  if (harmonic_of(name).k > 0) {
    if (!quantity.at_impacts()) return;
    throw InputError(in_quotes(quantity.name + ":" + name) + ": a quantity at impacts has no harmonics");
  }
  throw InputError("no statistic " + in_quotes(name) + suggestion(name, names()));
}

void check_statistic_of_stretch(const Quantity& quantity, const std::string& name) {
  check_statistic(quantity, name);
  if (harmonic_of(name).k > 0) refuse_harmonic(quantity.name + ":" + name);
}

double statistic(const Statistics& of, const std::string& name) {
  if (name == "mean") return of.mean;
  if (name == "rms") return of.rms;
  if (name == "min") return of.least;
  if (name == "max") return of.greatest;
  if (name == "min_at") return of.least_at;
  if (name == "max_at") return of.greatest_at;
  if (name == "peak_to_peak") return of.peak_to_peak();
  if (name == "crest") return of.crest();
  if (name == "impulse") return of.impulse;
  if (name == "number") return static_cast<double>(of.impulses);
  if (part_of(name) >= 0.0) return of.quantile(part_of(name));
  if (const Harmonic harmonic = harmonic_of(name); harmonic.k > 0) {
    if (of.harmonics.empty()) refuse_harmonic(name);
    return value_of(of.harmonics, harmonic);
  }
  throw InputError("no statistic " + in_quotes(name) + suggestion(name, names()));
}

std::vector<std::string> usual_statistics(const Quantity& quantity) {
  if (quantity.kind == Quantity::Kind::parameter) return {"mean"};
  if (quantity.at_impacts()) return {"number", "mean", "rms", "min", "q05", "q25", "q50", "q75", "q95", "max"};
  std::vector<std::string> all = {"mean", "rms", "min", "min_at", "max", "max_at", "peak_to_peak", "crest"};
  using Kind = Quantity::Kind;
  if (quantity.kind == Kind::acceleration || quantity.kind == Kind::force || quantity.kind == Kind::power)
    all.emplace_back("impulse");
  return all;
}

}  // namespace slapstick
