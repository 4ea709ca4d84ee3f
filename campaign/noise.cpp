/// Campaign `noise`: computed values and slopes of guards against exact ones. The bound is never exceeded, and is not
/// empty.
#include <array>
#include <cmath>

#include "batches.hpp"
#include "event/first_root.hpp"
#include "flow/compiled_system.hpp"
#include "flow/mode_graph.hpp"
#include "mode/mode.hpp"
#include "scene.hpp"

namespace campaign {
namespace {

using slapstick::Json;
using slapstick::mode::Mode;

/// |error| / bound over many evaluations.
struct Ratio {
  long count = 0, exceeded = 0;
  double sum = 0.0, largest = 0.0;

  void note(double error, double bound) {
    const double ratio = bound > 0.0 ? error / bound : (error > 0.0 ? INFINITY : 0.0);
    ++count;
    exceeded += ratio <= 1.0 ? 0 : 1;
    sum += ratio;
    largest = std::max(largest, ratio);
  }
  void add(const Ratio& o) {
    count += o.count, exceeded += o.exceeded, sum += o.sum;
    largest = std::max(largest, o.largest);
  }
  [[nodiscard]] double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0.0; }
  [[nodiscard]] Json json() const {
    Json json = Json::object();
    json.set("evaluations", count).set("exceeded", exceeded).set("mean", mean()).set("largest", largest);
    return json;
  }
};

struct Tally {
  Ratio value, slope, value_113;
  void add(const Tally& o) { value.add(o.value), slope.add(o.slope), value_113.add(o.value_113); }
};

/// One guard on one window: the engine's polynomial with its bounds, and the exact function.
class Window {
 public:
  static constexpr int pieces = 16;

  Window(const Mode& mode, const ExactFlow& flow, int guard, int order, const double* X)
      : flow_(flow), guard_(guard), order_(order), X_(X) {
    std::array<double, 32> magnitude{};
    for (int i = 0; i < mode.size(); ++i) magnitude[i] = std::abs(X[i]);
    mode.enclose(guard, order, X, magnitude.data(), hull_);
    mode.taylor(guard, order, X, value_);
    slope_ = slapstick::event::derivative(value_);
  }

  /// At some places of piece j, on which the exact function is one polynomial.
  template <class T>
  void compare(int j, int places, Random& random, Ratio& value, Ratio* slope) const {
    std::array<T, 32> state;
    std::array<T, ExactFlow::terms> a;
    flow_.state<T>(j, X_, state.data());
    flow_.polynomial<T>(guard_, state.data(), a.data());
    for (int i = 0; i < places; ++i) {
      const double x = (j + random.uniform(0.0, 1.0)) / pieces;
      const T y = T(x) * pieces - j;
      T h = 0, h1 = 0, lift = 1;
      for (int n = ExactFlow::useful<T> - 1; n >= 0; --n) h1 = h1 * y + h, h = h * y + a[n];
      for (int n = 0; n < order_; ++n) lift *= T(x);
      const T g = h / lift, g1 = (h1 * pieces - order_ * h / T(x)) / lift;
      note(x, g, g1, value, slope);
    }
  }

 private:
  [[nodiscard]] double value_bound(double x) const {
    using namespace slapstick::event;
    return hull_.bounds[noise_0] + x * (hull_.bounds[noise_1] + x * hull_.bounds[noise_2]);
  }
  [[nodiscard]] double slope_bound(double x) const {
    using namespace slapstick::event;
    return hull_.bounds[noise_1] + x * hull_.bounds[slope_noise];
  }

  template <class T>
  void note(double x, T g, T g1, Ratio& value, Ratio* slope) const {
    const slapstick::event::Powers p(x);
    value.note(std::abs(static_cast<double>(T(slapstick::event::value(value_, p)) - g)), value_bound(x));
    if (slope == nullptr) return;
    slope->note(std::abs(static_cast<double>(T(slapstick::event::value(slope_, p)) - g1)), slope_bound(x));
  }

  const ExactFlow& flow_;
  int guard_, order_;
  const double* X_;
  slapstick::event::Hull hull_{};
  slapstick::event::Coefficients value_{}, slope_{};
};

/// Evaluations of one scene's modes, in states of which a quarter are in contact.
Tally examine(Random random, long count) {
  constexpr int places = 8;
  Tally tally;
  Scene scene(random);
  std::map<slapstick::ModeId, ExactFlow> flows;
  while (tally.value.count < count) {
    std::array<double, 32> X{};
    scene.enter(scene.state(random), random.uniform(0.0, 1.0), X.data());
    const slapstick::ModeId id = slapstick::flow::approaching_mode(scene.system().compiled(), X.data());
    const Mode& mode = scene.system().compiled().mode(id);
    if (mode.guard_count() == 0) return tally;
    const ExactFlow& flow = flows.try_emplace(id, mode, mode.window() / Window::pieces, Window::pieces).first->second;
    const int g = random.below(mode.guard_count());
    const auto& guard = mode.guards()[g];
    const bool contact = guard.kind == slapstick::mode::GuardKind::gap && guard.single >= 0 && random.one_in(4);
    if (contact) X[guard.single] = 0.0;
    const Window window(mode, flow, g, contact ? 1 : 0, X.data());
    const int j = contact ? 1 + random.below(Window::pieces - 1) : random.below(Window::pieces);
    window.compare<long double>(j, places, random, tally.value, &tally.slope);
    if (random.one_in(100)) window.compare<Quad>(j, places, random, tally.value_113, nullptr);
  }
  return tally;
}

}  // namespace

Report run_noise(const Options& options) {
  Batches<Tally> batches(options, 200'000, "evaluations");
  const Tally all = batches.run([&](long k, long n) { return examine(Random(options.seed, k), n); });
  Report report;
  report.done = all.value.count;
  report.passed = all.value.exceeded + all.slope.exceeded + all.value_113.exceeded == 0 && all.value.mean() >= 0.01;
  report.figures.set("value_against_64_bits", all.value.json());
  report.figures.set("value_against_113_bits", all.value_113.json());
  report.figures.set("slope_against_64_bits", all.slope.json());
  return report;
}

}  // namespace campaign
