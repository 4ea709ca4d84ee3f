// The reference of tools/budget: what compiling and running this file costs is one unit.
// It resembles what ./dev test does: g++ on standard templates first, loops of doubles then. A change here moves every
// budget of tools/budget.json.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

namespace {

template <int N>
struct Key {
  int number;
  std::string name;
  friend bool operator<(const Key& a, const Key& b) { return std::tie(a.number, a.name) < std::tie(b.number, b.name); }
};

// One family of containers and algorithms; each N makes the compiler do it again.
template <int N>
double containers(int size) {
  std::map<Key<N>, std::vector<double>> table;
  for (int i = 0; i < size; ++i) {
    std::vector<double> row(static_cast<std::size_t>(i % 7 + 1));
    std::generate(row.begin(), row.end(), [x = 0.5 * i]() mutable { return x = std::fmod(1.7 * x + N, 3.0); });
    std::sort(row.begin(), row.end(), [](double a, double b) { return std::abs(a) > std::abs(b); });
    table[{i % 13, std::to_string(i)}] = row;
  }
  std::vector<std::function<double(double)>> steps;
  for (const auto& [key, row] : table) {
    const double sum = std::accumulate(row.begin(), row.end(), 0.0);
    steps.push_back([shift = key.number, sum](double x) { return 0.3 * x + shift + sum; });
  }
  return std::accumulate(steps.begin(), steps.end(), 0.0, [](double x, const auto& step) { return step(x); });
}

// A forced oscillator with a stop, by small steps: products, sums, a rare branch.
double oscillator(long steps) {
  double x = 0.1, v = 0.0, s = 0.0, c = 1.0, impacts = 0.0;
  const double h = 1e-4, turn_s = std::sin(1.5 * h), turn_c = std::cos(1.5 * h);
  for (long i = 0; i < steps; ++i) {
    v += h * (c - x - 0.02 * v);
    x += h * v;
    const double next = c * turn_c - s * turn_s;
    s = s * turn_c + c * turn_s;
    c = next;
    if (x > 0.8 && v > 0.0) {
      v = -0.8 * v;
      impacts += std::sqrt(v * v + 1e-3);
    }
  }
  return x + impacts;
}

}  // namespace

int main() {
  const double sum = containers<1>(3000) + containers<2>(3000) + containers<3>(3000) + containers<4>(3000);
  std::printf("%.17g\n", sum + oscillator(100'000'000));
}
