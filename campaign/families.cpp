/// Campaign `families`: what is near resonance, near critical damping, nearly equal, nearly rigid, by 2^-k,
/// k = 1 .. 52. The error does not grow towards the border.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "batches.hpp"
#include "exact_flow.hpp"
#include "flow/compiled_system.hpp"
#include "flow/engine.hpp"
#include "random.hpp"
#include "slapstick/flow/motion.hpp"

namespace campaign {
namespace {

using namespace slapstick;

constexpr int members = 52, samples = 256;

Model oscillator(double stiffness, double damping, double amplitude, double omega) {
  Model m;
  m.name = "oscillator";
  m.coordinates = {{"x", 1.0}};
  m.springs = {{0, ground, stiffness}};
  m.dampers = {{0, ground, damping}};
  m.forces = {{0, 1, amplitude, 0.0}};
  m.omega = omega;
  return m;
}

/// Two equal oscillators coupled by a spring that is nearly none: two pairs of eigenvalues nearly one.
Model nearly_equal(double d) {
  Model m = oscillator(1.0, 0.1, 1.0, 1.5);
  m.coordinates.push_back({"y", 1.0});
  m.springs.push_back({1, ground, 1.0});
  m.springs.push_back({0, 1, d});
  m.dampers.push_back({1, ground, 0.1});
  return m;
}

struct Family {
  const char* name;
  double duration;                  ///< time units
  std::function<Model(double)> at;  ///< at the distance d from the border
};

const std::array<Family, 6>& families() {
  static const std::array<Family, 6> all = {{
      {"above resonance", 100.0, [](double d) { return oscillator(1.0, 0.0, 1.0, 1.0 + d); }},
      {"below resonance", 100.0, [](double d) { return oscillator(1.0, 0.0, 1.0, 1.0 - d); }},
      {"overdamped", 20.0, [](double d) { return oscillator(1.0, 2.0 * (1.0 + d), 1.0, 1.5); }},
      {"underdamped", 20.0, [](double d) { return oscillator(1.0, 2.0 * (1.0 - d), 1.0, 1.5); }},
      {"nearly equal pairs", 100.0, nearly_equal},
      {"nearly rigid", 100.0, [](double d) { return oscillator(d, 0.0, 1.0, 1.5); }},
  }};
  return all;
}

/// Largest relative error, by family and k.
struct Tally {
  std::array<std::array<double, members>, 6> worst{};
  void add(const Tally& o) {
    for (std::size_t f = 0; f < worst.size(); ++f)
      for (int k = 0; k < members; ++k) worst[f][k] = std::max(worst[f][k], o.worst[f][k]);
  }
};

/// Runs from random states: largest error of any number, in units of what a relative error 1 of the start would come
/// to. Samples lie at 2^-n of a period apart, which the clock holds exactly.
double worst_error(const Family& family, int k, Random random, long starts) {
  const System system(family.at(std::ldexp(1.0, -k)));
  const double step =
      std::ldexp(1.0, static_cast<int>(std::floor(std::log2(family.duration / system.period() / samples))));
  Motion first(system, State(2 * system.model().size(), 0.0));
  const ExactFlow flow(system.compiled().mode(first.mode_id()), step * system.period(), samples);
  double worst = 0.0;
  for (long i = 0; i < starts; ++i) {
    State state(2 * system.model().size());
    for (double& x : state) x = random.uniform(-1.0, 1.0);
    Motion motion(system, state);
    const std::vector<double> X(motion.engine().extended().begin(), motion.engine().extended().end());
    double error = 0.0;
    for (int j = 1; j <= samples; ++j) {
      std::array<Quad, 32> exact;
      motion.advance(Instant{}.plus(j * step));
      flow.state<Quad>(j, X.data(), exact.data());
      for (int n = 0; n < 2 * system.compiled().frame().d; ++n) {
        error = std::max(error, std::abs(static_cast<double>(Quad(motion.engine().extended()[n]) - exact[n])));
      }
    }
    worst = std::max(worst, error / flow.reach(2 * system.compiled().frame().d, X.data()));
  }
  return worst;
}

}  // namespace

Report run_families(const Options& options) {
  Batches<Tally> batches(options, 10, "starts");
  const Tally all = batches.run([&](long batch, long n) {
    Tally tally;
    for (std::size_t f = 0; f < families().size(); ++f)
      for (int k = 1; k <= members && !options.stopped(); ++k)
        tally.worst[f][k - 1] = worst_error(families()[f], k, Random(options.seed, batch), n);
    return tally;
  });
  Report report;
  report.done = batches.done();
  report.passed = true;
  for (std::size_t f = 0; f < families().size(); ++f) {
    const auto [low, high] = std::minmax_element(all.worst[f].begin(), all.worst[f].end());
    Json json = Json::object();
    json.set("least", *low).set("largest", *high).set("ratio", *high / *low);
    json.set("by_k", Json::list(std::vector<double>(all.worst[f].begin(), all.worst[f].end())));
    report.figures.set(families()[f].name, json);
    report.passed = report.passed && *high <= 10.0 * *low;
  }
  return report;
}

}  // namespace campaign
