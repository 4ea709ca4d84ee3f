/// Computes the map of the middles of flights, and chooses the flights.
#include "section/flight_section.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "flow/compiled_system.hpp"
#include "flow/engine.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/stage.hpp"
#include "slapstick/flow/tangent.hpp"

namespace slapstick::section {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// d/dt of a contact state, per period.
VectorXd rate_of(const Motion& motion) {
  const System& system = motion.system();
  const mode::Frame& frame = system.compiled().frame();
  const mode::Matrix& A = system.compiled().mode(motion.mode_id()).system();
  const VectorXd all = system.period() * (A * VectorXd::Map(motion.engine().extended().data(), A.cols()));
  VectorXd rate(2 * frame.n);
  rate << all.head(frame.n), all.segment(frame.d, frame.n);
  return rate;
}

[[noreturn]] void no_return() {
  throw NumericalError("a free motion does not return to its section: another start, or a longer transient, may help");
}

}  // namespace

std::optional<Instant> FlightSection::next(const Motion& motion, Stop stop) const {
  Motion ahead = motion;
  const std::optional<Flight> flight = next_flight(ahead, kind_, stop);
  if (!flight) return std::nullopt;
  return flight->middle();
}

/// Modulo translations.
VectorXd FlightSection::numbers(const Motion& motion) const {
  VectorXd x = flow::contact_state(motion);
  translations().take_out(x);
  return translations().numbers(x);
}

VectorXd FlightSection::flow(const Motion& motion) const {
  VectorXd rate = rate_of(motion);
  translations().take_out(rate);
  return translations().numbers(rate);
}

Flight FlightSection::flight_after(Motion motion, int n, Stop stop) const {
  for (int k = 1;; ++k) {
    std::optional<Flight> flight = next_flight(motion, kind_, stop);
    if (!flight) no_return();
    if (k == n) return std::move(*flight);
  }
}

MapValue FlightSection::value(const VectorXd& x, int n, Stop stop) const {
  constexpr int most_steps = 20;
  constexpr double there = 1e-15;  // of a flight
  const System& system = translations().system();
  const State start = flow::user_state(system, x);
  const Motion begin(system, start);
  const VectorXd c = flow(begin), from = translations().numbers(x);
  const Flight flight = flight_after(begin, n, stop);
  const double length = flight.end.since(flight.begin);
  double after = 0.5 * length;
  for (int step = 0; step < most_steps; ++step) {
    Motion trial = flight.at_begin;
    run_to(trial, flight.begin.plus(after), stop, [] {});
    const double move = -c.dot(numbers(trial) - from) / c.dot(flow(trial));
    if (!(after + move > 0.0 && after + move < length)) no_return();
    after += move;
    if (std::abs(move) <= there * length) break;
  }
  const Instant end = flight.begin.plus(after);
  TangentMotion motion(system, start, MatrixXd::Identity(x.size(), x.size()));
  run_to(motion, end, stop, [] {});
  const VectorXd f = flow(motion.motion());
  MatrixXd jacobian = translations().quotient(motion.tangents());
  jacobian -= f * (c.transpose() * jacobian) / c.dot(f);
  MapValue value{flow::contact_state(motion.motion()), std::move(jacobian), {}, end.since({})};
  value.advance = translations().take_out(value.image);
  return value;
}

/// Without the 0 of the direction along the flow. What stick forgets is 0, too: rounding of the matrix is none of its
/// eigenvalues.
std::vector<std::complex<double>> FlightSection::multipliers(const MatrixXd& jacobian) const {
  std::vector<std::complex<double>> all = flow::multipliers_of(jacobian);
  const double rounding = 1e-14 * std::max(1.0, jacobian.norm());
  for (std::complex<double>& multiplier : all)
    if (std::abs(multiplier) <= rounding) multiplier = 0.0;
  if (!all.empty()) all.pop_back();
  return all;
}

VectorXd FlightSection::on_section(const VectorXd& x, Stop stop) const {
  const System& system = translations().system();
  Motion motion(system, flow::user_state(system, x));
  run(motion, 1, stop);
  VectorXd point = flow::contact_state(motion);
  translations().take_out(point);
  return point;
}

void FlightSection::take_out_flow(const Motion& motion, MatrixXd& tangents) const {
  VectorXd f = rate_of(motion);
  translations().take_out(f);
  tangents -= f * (f.transpose() * tangents) / f.squaredNorm();
}

namespace {

/// What was seen of the flights of one kind.
struct Seen {
  FlightKind kind;
  long count = 0, last = 0, longest_wait = 0;
  double time = 0.0;
};

constexpr long changes_looked_at = 400;
constexpr long most_changes_between = 64;  ///< of a kind that the motion keeps having

}  // namespace

std::optional<FlightKind> choose_flights(Motion motion, Stop stop) {
  std::vector<Seen> all;
  const System system = motion.system();
  std::optional<FlightKind> kind = next_change(motion, stop);
  for (long change = 1; change <= changes_looked_at; ++change) {
    if (!kind) return std::nullopt;
    const Instant begin = motion.time();
    const std::optional<FlightKind> next = next_change(motion, stop);
    auto seen = std::find_if(all.begin(), all.end(), [&](const Seen& one) { return one.kind == *kind; });
    if (seen == all.end()) seen = all.insert(all.end(), Seen{*kind});
    ++seen->count;
    seen->longest_wait = std::max(seen->longest_wait, change - seen->last);
    seen->last = change;
    seen->time += motion.time().since(begin);
    kind = next;
  }
  const auto worth = [&](const Seen& one) {
    const bool rare =
        one.time <= 0.0 || std::max(one.longest_wait, changes_looked_at - one.last) > most_changes_between;
    return std::tuple(rare, held(system, one.kind.mode), rare ? -one.count : one.count, -one.time);
  };
  return std::min_element(all.begin(), all.end(), [&](const Seen& a, const Seen& b) { return worth(a) < worth(b); })
      ->kind;
}

}  // namespace slapstick::section
