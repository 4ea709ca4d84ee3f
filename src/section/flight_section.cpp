/// Computes the map of the middles of flights, and chooses the flights.
#include "section/flight_section.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/ranges.hpp"
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

/// Of tangents along a flight: what is less, of the whole, is forgotten. A factor that small between two returns cannot
/// be told from it.
constexpr double rounding_of_tangents = 1e-14;

/// Without the 0 of the direction along the flow. What stick forgets is 0, too: rounding of the matrix is no eigenvalue
/// of it.
std::vector<std::complex<double>> FlightSection::multipliers(const MatrixXd& jacobian) const {
  std::vector<std::complex<double>> all = flow::multipliers_of(jacobian);
  const double rounding = rounding_of_tangents * std::max(1.0, jacobian.norm());
  for (std::complex<double>& multiplier : all)
    if (std::abs(multiplier) <= rounding) multiplier = 0.0;
  if (!all.empty()) all.pop_back();
  return all;
}

VectorXd FlightSection::on_section(const VectorXd& x, int n, Stop stop) const {
  const System& system = translations().system();
  Motion motion(system, flow::user_state(system, x));
  run(motion, n, stop);
  VectorXd point = flow::contact_state(motion);
  translations().take_out(point);
  return point;
}

void FlightSection::take_out_flow(const Motion& motion, MatrixXd& tangents) const {
  VectorXd f = rate_of(motion);
  translations().take_out(f);
  const Eigen::RowVectorXd before = tangents.colwise().norm();
  tangents -= f * (f.transpose() * tangents) / f.squaredNorm();
  for (Eigen::Index i = 0; i < tangents.cols(); ++i)
    if (tangents.col(i).norm() <= rounding_of_tangents * before[i]) tangents.col(i).setZero();
}

namespace {

/// What was seen of the flights of one kind.
struct Seen {
  FlightKind kind;
  long count = 0, last = 0, longest_wait = 0;
  double time = 0.0;
};

/// Of the changes that were looked at, a kind that the motion keeps having waits for no more than a part.
constexpr long first_looked_at = 400, most_looked_at = 25'600;
constexpr long most_wait(long looked_at) { return 64 * looked_at / first_looked_at; }

class Survey {
 public:
  explicit Survey(const Motion& motion) : system_(motion.system()), motion_(motion) {}

  /// @returns false if the motion has fewer changes
  bool look(long at, Stop stop) {
    if (changes_ == 0) kind_ = next_change(motion_, stop);
    for (; changes_ < at; ++changes_) {
      if (!kind_) return false;
      const Instant begin = motion_.time();
      const std::optional<FlightKind> next = next_change(motion_, stop);
      note(*kind_, motion_.time().since(begin));
      kind_ = next;
    }
    return true;
  }
  [[nodiscard]] bool keeps_one() const {
    return ranges::any_of(all_, [&](const Seen& one) { return !is_rare(one); });
  }
  [[nodiscard]] FlightKind best() const {
    const auto worth = [&](const Seen& one) {
      const bool rare = is_rare(one);
      return std::tuple(rare, held(system_, one.kind.mode), rare ? -one.count : one.count, -one.time);
    };
    return ranges::min_element(all_, [&](const Seen& a, const Seen& b) { return worth(a) < worth(b); })->kind;
  }

 private:
  void note(const FlightKind& kind, double time) {
    auto seen = ranges::find(all_, kind, &Seen::kind);
    if (seen == all_.end()) seen = all_.insert(all_.end(), Seen{kind});
    ++seen->count;
    seen->longest_wait = std::max(seen->longest_wait, changes_ + 1 - seen->last);
    seen->last = changes_ + 1;
    seen->time += time;
  }
  [[nodiscard]] bool is_rare(const Seen& one) const {
    return one.time <= 0.0 || std::max(one.longest_wait, changes_ - one.last) > most_wait(changes_);
  }

  System system_;
  Motion motion_;
  std::optional<FlightKind> kind_;
  std::vector<Seen> all_;
  long changes_ = 0;
};

}  // namespace

std::optional<FlightKind> choose_flights(const Motion& motion, Stop stop) {
  Survey survey(motion);
  for (long at = first_looked_at; at <= most_looked_at; at *= 4) {
    if (!survey.look(at, stop)) return std::nullopt;
    if (survey.keeps_one()) break;
  }
  return survey.best();
}

}  // namespace slapstick::section
