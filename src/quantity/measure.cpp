/// Integrates quantities along a motion, and finds their least and greatest values.
#include "slapstick/quantity/measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flow/compiled_system.hpp"
#include "quantity/first_extreme.hpp"
#include "quantity/harmonics.hpp"
#include "quantity/leg_trace.hpp"
#include "quantity/quadrature.hpp"
#include "quantity/tracer.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {
namespace quantity {
namespace {

/// A sum of many terms with what its roundings left out. Source: Neumaier (1974).
struct LongSum {
  double sum = 0.0, rest = 0.0;
  void add(double term) {
    const double next = sum + term;
    rest += std::abs(sum) >= std::abs(term) ? (sum - next) + term : (term - next) + sum;
    sum = next;
  }
  [[nodiscard]] double value() const { return sum + rest; }
};

/// Both extremes, and where they are.
struct Extremes {
  FirstExtreme least = FirstExtreme::least(), greatest = FirstExtreme::greatest();
  double least_at = 0.0, greatest_at = 0.0;

  void note(double value, double at, double near) {
    if (least.note(value, at, near)) least_at = at;
    if (greatest.note(value, at, near)) greatest_at = at;
  }
  void write(Statistics& into) const {
    into.least = least.value(), into.least_at = least_at;
    into.greatest = greatest.value(), into.greatest_at = greatest_at;
  }
};

/// Sums of a quantity.
struct Sums {
  LongSum integral, square;
  Extremes extremes;
};

void add_step(const Polynomial& f, double begin, double length, double period, Sums& sums) {
  sums.integral.add(length * f.integral());
  double square = 0.0;
  const auto values = at_nodes(f);
  for (std::size_t k = 0; k < nodes; ++k) square += gauss().weight[k] * values[k] * values[k];
  sums.square.add(length * square);
  if (has_no_length(length, period)) return;
  const double around = f.size(1);
  const double least = sums.extremes.least.value(), greatest = sums.extremes.greatest.value();
  if (f.a[0] - around >= least && f.a[0] + around <= greatest) return;
  const event::Bernstein hull(f);
  if (hull.least() >= least && hull.most() <= greatest) return;
  event::possible_extremes(f, [&](double x, double value) {
    sums.extremes.note(value, begin + x * length, FirstExtreme::part_of_step * length);
  });
}

class Statistician : public Listener {
 public:
  /// @param frequency  of the harmonics, turns per time; 0: of what is no cycle
  Statistician(const Model& model, const std::vector<Quantity>& of, double frequency)
      : of_(of),
        sums_(of.size()),
        harmonics_(of.size(), Harmonics({frequency, 0.0})),
        found_{0.0, std::vector<Statistics>(of.size()), {}, true} {
    for (const Stop& stop : model.stops) found_.stops.push_back({stop.name, {}, {}, {}});
    for (const CompliantStop& stop : model.compliant_stops) found_.stops.push_back({stop.name, {}, {}, {}, true});
    period_ = model.forcing_period();
    rigid_ = static_cast<int>(model.stops.size());
    between_ = static_cast<int>(model.frictions.size());
  }

  void step(const Step& step) override {
    for (std::size_t k = 0; k < of_.size(); ++k) {
      if (of_[k].at_impacts()) continue;
      add_step(step.values[k], step.begin, step.length, period_, sums_[k]);
      harmonics_[k].add(step.values[k], nullptr, step);
    }
  }

  void jump(const VelocityJump& jump) override {
    for (std::size_t k = 0; k < of_.size(); ++k) {
      const double impulse = jump.impulses[k].value;
      if (impulse == 0.0) continue;
      harmonics_[k].add(jump.impulses[k], jump.time);
      found_.of[k].impulse += impulse;
      ++found_.of[k].impulses;
    }
    for (const Struck& one : jump.impacts) {
      StopStatistics& stop =
          found_.stops[static_cast<std::size_t>(one.contact < rigid_ ? one.contact : one.contact - between_)];
      const double time = jump.time.value;
      add(one.w.value, time, stop.w);
      add(one.impulse.value, time, stop.impulse);
      add(one.loss.value, time, stop.loss);
      for (std::size_t k = 0; k < of_.size(); ++k)
        if (of_[k].at_impacts()) add(value_at(of_[k], one).value, time, found_.of[k]);
    }
  }

  [[nodiscard]] Measured result(double duration, bool complete) {
    found_.duration = duration;
    found_.complete = complete;
    for (std::size_t k = 0; k < of_.size(); ++k) {
      Statistics& one = found_.of[k];
      if (of_[k].at_impacts()) {
        finish(one);
        continue;
      }
      one.mean = (sums_[k].integral.value() + one.impulse) / duration;
      one.rms = std::sqrt(sums_[k].square.value() / duration);
      sums_[k].extremes.write(one);
      one.harmonics = harmonics_[k].over({duration, 0.0}).value;
    }
    for (StopStatistics& stop : found_.stops)
      for (Statistics* one : {&stop.w, &stop.impulse, &stop.loss}) finish(*one);
    return std::move(found_);
  }

 private:
  /// least_at and greatest_at are kept up while values come.
  static void add(double value, double at, Statistics& into) {
    if (std::isnan(value)) return;
    if (into.values.empty()) into.least = into.greatest = value, into.least_at = into.greatest_at = at;
    const double tie = FirstExtreme::ties * std::max({std::abs(value), std::abs(into.least), std::abs(into.greatest)});
    if (into.least - value > tie) into.least_at = at;
    if (value - into.greatest > tie) into.greatest_at = at;
    into.least = std::min(into.least, value);
    into.greatest = std::max(into.greatest, value);
    into.values.push_back(value);
  }

  static void finish(Statistics& one) {
    double sum = 0.0, square = 0.0;
    for (const double value : one.values) sum += value, square += value * value;
    one.impulse = sum;
    one.impulses = static_cast<long>(one.values.size());
    const auto count = static_cast<double>(one.values.size());
    one.mean = sum / count;  // NaN if there are none
    one.rms = std::sqrt(square / count);
    if (one.values.empty()) one.least = one.greatest = std::numeric_limits<double>::quiet_NaN();
    std::sort(one.values.begin(), one.values.end());
  }

  const std::vector<Quantity>& of_;
  std::vector<Sums> sums_;
  std::vector<Harmonics> harmonics_;
  Measured found_;
  double period_ = 1.0;
  int rigid_ = 0, between_ = 0;  ///< stops, and the friction contacts that are numbered behind them
};

}  // namespace
}  // namespace quantity

Measured measure(Motion motion, Instant end, const std::vector<Quantity>& of, const std::atomic<bool>* stop,
                 const std::function<void(double periods)>& progress) {
  if (end <= motion.time()) throw InputError("measure: the end is not later than the start");
  const Instant start = motion.time();
  const System system = motion.system();
  quantity::Statistician listener(system.model(), of, 0.0);
  quantity::Tracer tracer(system.model(), system.compiled().frame(), {system.period(), 0.0}, of, listener);
  const bool complete = quantity::trace(motion, end, tracer, stop, progress);
  return listener.result(motion.time().since(start) * system.period(), complete);
}

Measured measure(const orbit::Problem& problem, const orbit::Orbit& orbit, const std::vector<Quantity>& of) {
  const quantity::Cycle cycle(problem, orbit);
  quantity::Statistician listener(cycle.model(), of, cycle.frequency().value);
  quantity::Tracer tracer(cycle.model(), cycle.frame(), cycle.period(), of, listener);
  cycle.trace(tracer);
  Measured found = listener.result(cycle.duration().value, true);
  const auto in_cycle = [&](Statistics& one) {
    for (double* at : {&one.least_at, &one.greatest_at}) *at -= found.duration * std::floor(*at / found.duration);
  };
  for (Statistics& one : found.of) in_cycle(one);
  for (StopStatistics& stop : found.stops)
    for (Statistics* one : {&stop.w, &stop.impulse, &stop.loss}) in_cycle(*one);
  return found;
}

}  // namespace slapstick
