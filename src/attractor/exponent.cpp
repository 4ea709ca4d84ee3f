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

namespace {

/// What is collected on the way.
struct Sequences {
  std::vector<double> growth, speeds, phases, strobe, durations;
  std::vector<std::complex<double>> points;
  std::vector<double> chosen_speeds, chosen_times;

  void note(const Event& event, const StopChoice& stops, PeriodEvents& events) {
    events.sticks += event.kind == EventKind::stick;
    events.chatters += event.kind == EventKind::chatter && stops.holds(event.contact);
    if (!StopChoice().is_point(event)) return;
    ++events.impacts;
    speeds.push_back(event.w);
    phases.push_back(std::cos(2.0 * std::numbers::pi * event.time.fraction));
    if (!stops.is_point(event)) return;
    chosen_speeds.push_back(event.w);
    chosen_times.push_back(event.time.since({}));
  }

  /// Of a free motion the points themselves and the times between them: it has no phase.
  [[nodiscard]] double digits(bool driven) const {
    if (!driven) return std::min(birkhoff_digits(strobe), birkhoff_digits(durations));
    return speeds.size() >= 100 ? std::min(birkhoff_digits(speeds), birkhoff_digits(phases)) : birkhoff_digits(strobe);
  }
};

/// A fixed direction with no symmetry: every run of the same motion gives the same bits.
Eigen::MatrixXd some_tangent(Eigen::Index size) {
  Eigen::MatrixXd tangent(size, 1);
  for (Eigen::Index i = 0; i < size; ++i) tangent(i, 0) = std::cos(1.0 + 2.0 * static_cast<double>(i));
  return tangent.normalized();
}

}  // namespace

RunFigures run_figures(const section::ReturnMap& map, const State& state, int returns, const StopChoice& stops,
                       Stop stop) {
  const flow::Translations& translations = map.translations();
  const Eigen::Index size = 2 * translations.system().compiled().frame().n;
  TangentMotion motion(translations.system(), state, some_tangent(size));
  const double period = 1.0 / translations.system().period();  // a displacement as large as a velocity
  RunFigures figures;
  figures.advance = Eigen::VectorXd::Zero(translations.count());
  Sequences seen;
  bool dead = false;
  const int discard = returns / 20;  // until the tangent points along the fastest growing direction
  for (int k = 0; k < returns + discard; ++k) {
    const Instant begin = motion.motion().time();
    const std::optional<Instant> end = map.next(motion.motion(), stop);
    figures.ended = !end;
    if (!end) return figures;
    seen.durations.push_back(end->since(begin));
    if (!run_to(motion, *end, stop, [&] { seen.note(motion.motion().event(), stops, figures.events); })) return figures;
    figures.advance += translations.take_out(motion) / (returns + discard);
    const Eigen::VectorXd x = contact_state(motion.motion());
    seen.strobe.push_back(x[translations.observed()]);
    seen.points.emplace_back(period * x[translations.observed()], x[size - 1]);
    Eigen::MatrixXd tangent = motion.tangents();
    map.take_out_flow(motion.motion(), tangent);
    const double norm = tangent.norm();
    dead = dead || norm < 1e-280;
    if (dead) continue;
    if (k >= discard) seen.growth.push_back(std::log(norm));
    motion.set_tangents(tangent / norm);
  }
  const Mean mean = dead ? Mean{-INFINITY, 0.0} : batch_mean(seen.growth);
  figures.exponent = mean.value;
  figures.exponent_error = mean.error;
  figures.digits = seen.digits(section::driven(translations.system()));
  figures.mean_return = motion.motion().time().since({}) / (returns + discard);
  figures.rotation = rotation(std::move(seen.points));
  figures.state = motion.motion().state();
  figures.burst = has_burst(seen.chosen_times, seen.chosen_speeds);
  return figures;
}

}  // namespace slapstick::attractor
