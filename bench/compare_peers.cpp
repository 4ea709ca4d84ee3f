/// Prints the impact times of the peers side by side and fails when they disagree by more than their tolerances
/// explain. Usage: compare_peers [--print] [periods, default 20]

#include "peers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

using slapstick::bench::PeerRun;

constexpr double odeint_tolerance = 1e-12;
constexpr double cvode_tolerance = 1e-9;
constexpr double reference_tolerance = 1e-15;

void print_times(const PeerRun& a, const PeerRun& b, const PeerRun& reference) {
  const std::size_t rows = std::max({a.impact_times.size(), b.impact_times.size(), reference.impact_times.size()});
  const auto print = [](const PeerRun& run, std::size_t row) {
    if (row < run.impact_times.size()) {
      std::printf(" %22.16g", run.impact_times[row]);
    } else {
      std::printf(" %22s", "-");
    }
  };
  for (std::size_t row = 0; row < rows; ++row) {
    std::printf("%5zu", row + 1);
    print(reference, row);
    print(a, row);
    print(b, row);
    std::printf("\n");
  }
}

/// Largest difference of an impact time; negative when the number of impacts differs.
double difference(const PeerRun& a, const PeerRun& b) {
  if (a.impact_times.size() != b.impact_times.size()) {
    return -1.0;
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < a.impact_times.size(); ++i) {
    largest = std::max(largest, std::abs(a.impact_times[i] - b.impact_times[i]));
  }
  return largest;
}

void report(const char* name, const PeerRun& run, const PeerRun& reference, int periods) {
  std::printf("  %-14s %5zu impacts, error %9.2g, per period: %7.1f evaluations, %6.1f steps, %5.1f phases\n", name,
              run.impact_times.size(), difference(run, reference), static_cast<double>(run.evaluations) / periods,
              static_cast<double>(run.steps) / periods, static_cast<double>(run.phases) / periods);
}

/// `allowed`: largest difference of CVODE from the reference; 0 where impacts may differ in number (chatter).
bool compare(double omega, int periods, double allowed, bool print) {
  const PeerRun reference = slapstick::bench::run_odeint(omega, periods, reference_tolerance);
  const PeerRun odeint = slapstick::bench::run_odeint(omega, periods, odeint_tolerance);
  const PeerRun cvode = slapstick::bench::run_cvode(omega, periods, cvode_tolerance);
  std::printf("omega %g, %d periods, reference: odeint at %g, %zu impacts\n", omega, periods, reference_tolerance,
              reference.impact_times.size());
  report("odeint 1e-12", odeint, reference, periods);
  report("cvode 1e-9", cvode, reference, periods);
  if (print) {
    print_times(odeint, cvode, reference);
  }
  const double odeint_error = difference(odeint, reference);
  const double cvode_error = difference(cvode, reference);
  const bool agreed =
      odeint_error >= 0.0 && odeint_error < 1e-3 * allowed && cvode_error >= 0.0 && cvode_error < allowed;
  return allowed == 0.0 || agreed;
}

}  // namespace

int main(int argc, char** argv) {
  const bool print = argc > 1 && std::string_view(argv[1]) == "--print";
  const int periods = argc > (print ? 2 : 1) ? std::atoi(argv[print ? 2 : 1]) : 20;
  bool agreed = compare(2.2, periods, 1e-7, print);
  agreed = compare(1.5, periods, 1e-7, print) && agreed;
  agreed = compare(4.9, periods, 0.0, print) && agreed;
  agreed = compare(0.552, periods, 0.0, print) && agreed;
  std::printf(agreed ? "agreed\n" : "DISAGREED\n");
  return agreed ? 0 : 1;
}
