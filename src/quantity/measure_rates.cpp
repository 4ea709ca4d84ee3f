/// Differentiates the statistics of a cycle by parameters: those of `measure`, with the derivative of each beside it.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "quantity/first_extreme.hpp"
#include "quantity/harmonics.hpp"
#include "quantity/leg_trace.hpp"
#include "quantity/quadrature.hpp"
#include "quantity/tracer.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/quantity/measure.hpp"

namespace slapstick {
namespace quantity {
namespace {

/// A value and where it is.
struct Place {
  Number value, at;
};

struct RateSums {
  Number integral, square, impulse;
  FirstExtreme least_value = FirstExtreme::least(), greatest_value = FirstExtreme::greatest();
  Place least, greatest;

  /// @param place  of the value, asked for where it is an extreme
  template <class PlaceOf>
  void note(double value, double at, double near, const PlaceOf& place) {
    const bool is_least = least_value.note(value, at, near), is_greatest = greatest_value.note(value, at, near);
    if (!is_least && !is_greatest) return;
    const Place one = place();
    if (is_least) least = one;
    if (is_greatest) greatest = one;
  }
};

/// An extreme at x of a step: in the step its value moves as q at fixed time, and its instant by -q_tp / q_tt. At an
/// end with a slope both move with the end.
Place extreme(const Polynomial& f, const Polynomial& rate, const Step& step, double x) {
  constexpr double flat = 1e-9;
  const Polynomial slope = f.slope();
  const double size = f.size(), rises = slope.at(x), bends = slope.slope().at(x);
  const double end = x == 0.0 ? step.from_rate : x == 1.0 ? step.to_rate : 0.0;
  const bool at_end = x == 0.0 || x == 1.0;
  const bool smooth = std::abs(bends) > flat * size && (!at_end || std::abs(rises) <= flat * size);
  double moves = smooth ? -step.length * rate.slope().at(x) / bends : end;
  if (!smooth && !at_end) moves = std::numeric_limits<double>::quiet_NaN();
  const double carried = at_end ? rises / step.length * end : 0.0;
  return {{f.at(x), rate.at(x) + carried}, {step.begin + x * step.length, step.piece_rate + moves}};
}

void add_step(const Polynomial& f, const Polynomial& rate, const Step& step, double period, RateSums& sums) {
  const double from = f.at(0.0), to = f.at(1.0);
  sums.integral +=
      {step.length * f.integral(), step.length * rate.integral() + to * step.to_rate - from * step.from_rate};
  Number square;
  const auto values = at_nodes(f), rates = at_nodes(rate);
  for (std::size_t k = 0; k < nodes; ++k)
    square += {gauss().weight[k] * values[k] * values[k], 2.0 * gauss().weight[k] * values[k] * rates[k]};
  sums.square +=
      {step.length * square.value, step.length * square.rate + to * to * step.to_rate - from * from * step.from_rate};
  if (has_no_length(step.length, period)) return;
  const double around = f.size(1);
  if (f.a[0] - around >= sums.least_value.value() && f.a[0] + around <= sums.greatest_value.value()) return;
  event::possible_extremes(f, [&](double x, double value) {
    sums.note(value, step.begin + x * step.length, FirstExtreme::part_of_step * step.length,
              [&] { return extreme(f, rate, step, x); });
  });
}

/// (sum of squares / size)^(1/2), differentiated.
double rms_rate(Number square, Number size) {
  const Number mean = square / size;
  return mean.value > 0.0 ? 0.5 * mean.rate / std::sqrt(mean.value) : 0.0;
}

class RateStatistician : public Listener {
 public:
  RateStatistician(const Model& model, const std::vector<Quantity>& of, Number frequency)
      : of_(of),
        sums_(of.size()),
        harmonics_(of.size(), Harmonics(frequency)),
        at_impacts_(of.size()),
        period_(model.forcing_period()),
        rigid_(static_cast<int>(model.stops.size())),
        between_(static_cast<int>(model.frictions.size())) {
    for (const Stop& stop : model.stops) stops_.push_back({stop.name, false, {}, {}, {}});
    for (const CompliantStop& stop : model.compliant_stops) stops_.push_back({stop.name, true, {}, {}, {}});
  }

  void step(const Step& step) override {
    for (std::size_t k = 0; k < of_.size(); ++k) {
      if (of_[k].at_impacts()) continue;
      add_step(step.values[k], step.rates[k], step, period_, sums_[k]);
      harmonics_[k].add(step.values[k], &step.rates[k], step);
    }
  }

  void jump(const VelocityJump& jump) override {
    for (std::size_t k = 0; k < of_.size(); ++k) {
      sums_[k].impulse += jump.impulses[k];
      harmonics_[k].add(jump.impulses[k], jump.time);
    }
    for (const Struck& one : jump.impacts) {
      OfStop& stop = stops_[static_cast<std::size_t>(one.contact < rigid_ ? one.contact : one.contact - between_)];
      add(one.w, jump.time, stop.w);
      add(one.impulse, jump.time, stop.impulse);
      add(one.loss, jump.time, stop.loss);
      for (std::size_t k = 0; k < of_.size(); ++k)
        if (of_[k].at_impacts()) add(value_at(of_[k], one), jump.time, at_impacts_[k]);
    }
  }

  [[nodiscard]] Measured result(Number duration) const {
    Measured found{duration.rate, {}, {}, true};
    for (std::size_t k = 0; k < of_.size(); ++k)
      found.of.push_back(of_[k].at_impacts() ? of_values(at_impacts_[k], duration)
                                             : of_time(sums_[k], harmonics_[k], duration));
    for (const OfStop& stop : stops_)
      found.stops.push_back({stop.name, of_values(stop.w, duration), of_values(stop.impulse, duration),
                             of_values(stop.loss, duration), stop.compliant});
    return found;
  }

 private:
  using Places = std::vector<Place>;
  struct OfStop {
    std::string name;
    bool compliant;
    Places w, impulse, loss;
  };

  static void add(Number value, Number at, Places& into) {
    if (!std::isnan(value.value)) into.push_back({value, at});
  }

  /// Instants are told within the cycle: those of `measure` less whole cycles.
  static double within(Number at, Number duration) {
    return at.rate - duration.rate * std::floor(at.value / duration.value);
  }

  static Statistics of_time(const RateSums& sums, const Harmonics& harmonics, Number duration) {
    Statistics rate;
    rate.mean = ((sums.integral + sums.impulse) / duration).rate;
    rate.rms = rms_rate(sums.square, duration);
    rate.least = sums.least.value.rate;
    rate.greatest = sums.greatest.value.rate;
    rate.least_at = within(sums.least.at, duration);
    rate.greatest_at = within(sums.greatest.at, duration);
    rate.impulse = sums.impulse.rate;
    rate.harmonics = harmonics.over(duration).rate;
    return rate;
  }

  static Statistics of_values(Places places, Number duration) {
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    Statistics rate;
    rate.mean = rate.rms = rate.least = rate.greatest = unknown;
    if (places.empty()) return rate;
    RateSums extremes;
    for (const Place& one : places) extremes.note(one.value.value, one.at.value, 0.0, [&] { return one; });
    std::stable_sort(places.begin(), places.end(),
                     [](const Place& a, const Place& b) { return a.value.value < b.value.value; });
    Number sum, square;
    for (const Place& one : places) {
      sum += one.value;
      square += one.value * one.value;
      rate.values.push_back(one.value.rate);
    }
    const Number count{static_cast<double>(places.size()), 0.0};
    rate.mean = (sum / count).rate;
    rate.rms = rms_rate(square, count);
    rate.impulse = sum.rate;
    rate.least = extremes.least.value.rate;
    rate.least_at = within(extremes.least.at, duration);
    rate.greatest = extremes.greatest.value.rate;
    rate.greatest_at = within(extremes.greatest.at, duration);
    return rate;
  }

  const std::vector<Quantity>& of_;
  std::vector<RateSums> sums_;
  std::vector<Harmonics> harmonics_;
  std::vector<Places> at_impacts_;
  std::vector<OfStop> stops_;
  double period_;
  int rigid_, between_;  ///< stops, and the friction contacts that are numbered behind them
};

}  // namespace
}  // namespace quantity

std::vector<Measured> measure_rates(const orbit::Problem& problem, const orbit::Orbit& orbit,
                                    const std::vector<Quantity>& of) {
  for (const Quantity& one : of)
    if (one.kind == Quantity::Kind::parameter)
      throw InputError(in_quotes(one.name) + " is a parameter: its sensitivity is not one of the motion");
  const auto set = std::make_shared<const orbit::ModeSet>(problem.family(), orbit.values);
  const std::vector<orbit::OrbitRate> rates = orbit::orbit_rates(problem, *set, orbit);
  std::vector<Measured> all;
  for (std::size_t j = 0; j < rates.size(); ++j) {
    const quantity::Cycle cycle(set, orbit, rates[j], j);
    const quantity::Rates model{set->rate(j), set->frame_rate(j)};
    quantity::RateStatistician listener(cycle.model(), of, cycle.frequency());
    quantity::Tracer tracer(cycle.model(), cycle.frame(), cycle.period(), of, listener, &model);
    cycle.trace(tracer);
    all.push_back(listener.result(cycle.duration()));
  }
  return all;
}

}  // namespace slapstick
