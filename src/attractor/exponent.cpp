/// Computes the largest Lyapunov exponent and weighted Birkhoff averages of one run.
#include "attractor/exponent.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "attractor/batches.hpp"
#include "flow/compiled_system.hpp"
#include "slapstick/flow/tangent.hpp"

namespace slapstick::attractor {
namespace {

double weighted_average(const double* values, std::size_t count) {
  double sum = 0.0, total = 0.0;
  for (std::size_t i = 1; i < count; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(count);
    const double weight = bump(t);
    sum += weight * values[i];
    total += weight;
  }
  return sum / total;
}

}  // namespace

double birkhoff_digits(const std::vector<double>& sequence) {
  const std::size_t half = sequence.size() / 2;
  if (half < 50) return 0.0;
  const auto [low, high] = std::minmax_element(sequence.begin(), sequence.end());
  if (*high == *low) return 16.0;
  const double difference = weighted_average(sequence.data(), half) - weighted_average(sequence.data() + half, half);
  return std::min(16.0, -std::log10(std::abs(difference) / (*high - *low) + 1e-17));
}

RunFigures run_figures(const flow::Translations& translations, const State& state, int periods, const StopChoice& stops,
                       Stop stop) {
  const Eigen::Index size = 2 * translations.system().compiled().frame().n;
  // A fixed direction with no symmetry: every run of the same motion gives the same bits.
  Eigen::MatrixXd tangent(size, 1);
  for (Eigen::Index i = 0; i < size; ++i) tangent(i, 0) = std::cos(1.0 + 2.0 * static_cast<double>(i));
  tangent.normalize();
  TangentMotion motion(translations.system(), state, tangent);
  const double period = 1.0 / translations.system().period();  // a displacement as large as a velocity
  RunFigures figures;
  figures.advance = Eigen::VectorXd::Zero(translations.count());
  std::vector<double> growth, speeds, phases, strobe;
  std::vector<std::complex<double>> points;
  std::vector<double> chosen_speeds, chosen_times;
  bool dead = false;
  const int discard = periods / 20;  // until the tangent points along the fastest growing direction
  for (int k = 0; k < periods + discard; ++k) {
    const bool whole = run_to(motion, {k + 1, 0.0}, stop, [&] {
      const Event& event = motion.motion().event();
      figures.events.sticks += event.kind == EventKind::stick;
      figures.events.chatters += event.kind == EventKind::chatter && stops.holds(event.contact);
      if (!StopChoice().is_point(event)) return;
      ++figures.events.impacts;
      speeds.push_back(event.w);
      phases.push_back(std::cos(2.0 * std::numbers::pi * event.time.fraction));
      if (!stops.is_point(event)) return;
      chosen_speeds.push_back(event.w);
      chosen_times.push_back(event.time.since({}));
    });
    if (!whole) return figures;
    figures.advance += translations.take_out(motion) / (periods + discard);
    const Eigen::VectorXd x = contact_state(motion.motion());
    strobe.push_back(x[translations.observed()]);
    points.emplace_back(period * x[translations.observed()], x[size - 1]);
    const double norm = motion.tangents().norm();
    dead = dead || norm < 1e-280;
    if (dead) continue;
    if (k >= discard) growth.push_back(std::log(norm));
    motion.set_tangents(motion.tangents() / norm);
  }
  const Mean mean = dead ? Mean{-INFINITY, 0.0} : batch_mean(growth);
  figures.exponent = mean.value;
  figures.exponent_error = mean.error;
  figures.digits =
      speeds.size() >= 100 ? std::min(birkhoff_digits(speeds), birkhoff_digits(phases)) : birkhoff_digits(strobe);
  figures.rotation = rotation(std::move(points));
  figures.state = motion.motion().state();
  figures.burst = has_burst(chosen_times, chosen_speeds);
  return figures;
}

}  // namespace slapstick::attractor
