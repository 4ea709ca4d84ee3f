/// Operations that the kernels do in a forcing period of the paper's system, and what share of the processor's peak
/// that is.
///
///     bench_roofline       one line of `key=value` an omega
///
/// The operations are counted by kernels that count and then call the real ones: this program defines event::kernels()
/// itself, so that the linker does not take the library's. An operation is a + - x / or comparison of doubles. Not
/// counted is what is done outside of kernels (clock, mode graph, bookkeeping). The peak is that of as many additions
/// as products, without FMA, in twelve independent chains: one in each of twelve registers.
#include <cmath>
#include <cstdio>

#include "event/kernels.hpp"
#include "runs.hpp"

namespace slapstick::event {

namespace scalar {
extern const Kernels table;
}

namespace {

double operations = 0.0;

constexpr double lanes = 8.0;
double product(int blocks, int m) { return lanes * blocks * (2.0 * m - 1.0); }
/// A polynomial of 24 terms: two nested products and sums of lanes, one product, seven sums. Its derivative: two more
/// products of lanes.
constexpr double polynomial = 4.0 * lanes + lanes + 7.0, powers = 3.0 * lanes + 4.0, derivative = 3.0 * lanes;

Root count_first_root(const GuardWindow& guard, double x_end, long& evaluations) {
  const long before = evaluations;
  const Root root = scalar::table.first_root(guard, x_end, evaluations);
  const auto count = static_cast<double>(evaluations - before);
  operations += 2.0 * derivative + 3.0 * lanes + count * (3.0 * polynomial + powers + 12.0);
  return root;
}
void count_multiply(const Lane8* data, int blocks, int m, const double* x, Lane8* out) {
  operations += product(blocks, m);
  scalar::table.multiply(data, blocks, m, x, out);
}
void count_pass(const Lane8* step, int blocks, int m, const Lane8* x, const Lane8* floor, bool fresh, Lane8* out,
                Lane8* magnitude, Lane8* largest, double* sizes) {
  operations += product(blocks, m) + 6.0 * lanes * blocks;
  scalar::table.pass(step, blocks, m, x, floor, fresh, out, magnitude, largest, sizes);
}
double count_magnitudes(const Lane8* x, const Lane8* floor, int blocks, Lane8* magnitude) {
  operations += 3.0 * lanes * blocks;
  return scalar::table.magnitudes(x, floor, blocks, magnitude);
}
bool count_hull(const Lane8* rows, const Lane8* errors, int m, const double* x, const double* magnitude, double more,
                Hull* out) {
  operations += 2.0 * product(1, m) + lanes;
  return scalar::table.hull(rows, errors, m, x, magnitude, more, out);
}
bool count_all_above(const Lane8* data, int m, const double* x, double bound) {
  operations += product(1, m) + lanes;
  return scalar::table.all_above(data, m, x, bound);
}
void count_evaluate(const Lane8* rows, int d, int m, const double* X, double x, double* values, double* slopes) {
  operations += powers + d * (product(3, m) + 2.0 * polynomial + derivative);
  scalar::table.evaluate(rows, d, m, X, x, values, slopes);
}

}  // namespace

const Kernels& kernels() {
  static const Kernels counting = [] {
    Kernels table = scalar::table;
    table.first_root = count_first_root;
    table.multiply = count_multiply;
    table.pass = count_pass;
    table.magnitudes = count_magnitudes;
    table.hull = count_hull;
    table.all_above = count_all_above;
    table.evaluate = count_evaluate;
    return table;
  }();
  return counting;
}

Root first_root(const GuardWindow& guard, double x_end, long& evaluations) {
  return kernels().first_root(guard, x_end, evaluations);
}

}  // namespace slapstick::event

namespace slapstick::bench {
namespace {

/// A register of this processor. More numbers than registers hold would measure memory.
#if defined(__AVX512F__)
using Register = event::Lane8;
#elif defined(__AVX__)
using Register = event::Lane4;
#else
using Register = event::Lane2;
#endif
constexpr int width = sizeof(Register) / sizeof(double);

/// Operations a second: `chains` of x = x a + b, as a product and a sum.
double peak() {
  constexpr int chains = 12;
  constexpr long rounds = 2'000'000;
  double best = 0.0;
  for (int trial = 0; trial < 5; ++trial) {
    Register x[chains] = {};
    for (int k = 0; k < chains; ++k)
      for (int lane = 0; lane < width; ++lane) x[k][lane] = 1.0 + 0.01 * k + 0.001 * lane;
    const double begun = cpu_time();
    for (long round = 0; round < rounds; ++round) {
#pragma GCC unroll 12
      for (int k = 0; k < chains; ++k) x[k] = x[k] * 0.999 + 0.001;
    }
    const double spent = cpu_time() - begun;
    double sum = 0.0;
    for (const Register& chain : x)
      for (int lane = 0; lane < width; ++lane) sum += chain[lane];
    if (!(std::abs(sum) < 1e3)) return 0.0;  // keeps the loop
    best = std::max(best, 2.0 * width * chains * rounds / spent);
  }
  return best;
}

}  // namespace
}  // namespace slapstick::bench

int main() {
  using namespace slapstick::bench;
  std::printf("peak=%.4g\n", peak());
  constexpr int periods = 500;
  for (const char* omega : {"2.2", "1.5", "4.9", "0.552"}) {
    slapstick::event::operations = 0.0;
    (void)run_slapstick(
        {"slapstick", omega, std::to_string(periods), "1"});  // the motion runs twice: once for its modes
    std::printf("omega=%s operations=%.6g\n", omega, slapstick::event::operations / (2.0 * periods));
  }
  return 0;
}
