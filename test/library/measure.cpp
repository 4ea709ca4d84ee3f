#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>

#include "flow/compiled_system.hpp"
#include "io/expression.hpp"
#include "library/notes.hpp"
#include "library/published_cases.hpp"
#include "section/return_map.hpp"
#include "slapstick/flow/tangent.hpp"

namespace slapstick::library {
namespace {

/// Runs to each of the marks in turn and notes what was there.
void run_to_marks(const Entry& marks, Motion& motion, Values& values) {
  const System& system = motion.system();
  int count = 0;
  for (const Entry& mark : marks) {
    const auto kind = mark.at(0).get<std::string>();
    const Instant end = motion.time().plus(1e6);
    for (int left = mark.at(1).get<int>(); left > 0;) {
      if (motion.advance(end) != Outcome::event) throw std::runtime_error("there is no " + kind);
      left -= is(motion.event(), kind, system);
    }
    const auto suffix = "_at" + std::to_string(++count);
    note_event(values, motion, suffix);
  }
}

/// Newton's method from the state at the next whole period; the motion goes on from the cycle.
Motion on_orbit(const Setup& setup, Motion motion, int n, Values& values) {
  const Instant end{motion.time().period + 1, 0.0};
  while (motion.advance(end) == Outcome::event) {
  }
  const section::Stroboscopic periods(setup.system);
  Eigen::VectorXd guess = flow::contact_state(motion);
  periods.translations().take_out(guess);
  const auto found = section::fixed_point(periods, guess, n, Eigen::VectorXd::Constant(guess.size(), 1.0), nullptr);
  if (!found) throw std::runtime_error("Newton's method finds no cycle");
  const auto map = periods.value(found->x, n, nullptr);
  values["multiplier"] = std::abs(found->multipliers.at(0));
  values["multiplier2"] = std::abs(found->multipliers.at(1));
  values["trace"] = map.jacobian.trace();
  values["det"] = map.jacobian.determinant();
  values["exponent"] = std::log(values["multiplier"]) / (n * setup.system.period());
  return Motion(setup.system, flow::user_state(setup.system, found->x));
}

/// The sum of all exponents, from the volume of as many tangents as there are dimensions.
void run_tangents(const Setup& setup, const Motion& from, double time, Values& values) {
  const Eigen::Index size = 2 * setup.system.compiled().frame().n;
  TangentMotion motion(setup.system, from.state(), Eigen::MatrixXd::Identity(size, size), from.time());
  const Instant end = after(from, time);
  double volume = 0.0;
  while (motion.motion().time() < end) {
    const Instant next = std::min(end, motion.motion().time().plus(1.0));
    while (motion.advance(next) == Outcome::event) count(motion.motion(), values);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(motion.tangents());
    volume += qr.matrixQR().diagonal().array().abs().log().sum();
    motion.set_tangents(qr.householderQ() * Eigen::MatrixXd::Identity(size, size));
  }
  values["exponents"] = volume / time;
}

double boundary_value(const Entry& entry) {
  const Entry& boundary = entry.at("boundary");
  const auto name = boundary.at("parameter").get<std::string>();
  const auto sign = [&](double value) {
    Setup setup(entry, {{name, value}});
    return plain_value(setup) > 0.0;
  };
  double low = number(boundary.at("from"), {}), high = number(boundary.at("to"), {});
  const bool at_low = sign(low);
  if (sign(high) == at_low) throw std::runtime_error("no boundary between the two values");
  while (high - low > 0.02 * entry.at("tolerance").get<double>()) {
    const double middle = 0.5 * (low + high);
    (sign(middle) == at_low ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double plain_value(Setup& setup) {
  const Entry& entry = setup.entry;
  Values& values = setup.values;
  Motion motion(setup.system, setup.start, setup.begin);
  if (entry.contains("settle")) {
    const Instant end = after(motion, number(entry["settle"], values));
    while (motion.advance(end) == Outcome::event) {
    }
  }
  if (entry.contains("orbit")) motion = on_orbit(setup, std::move(motion), entry["orbit"].get<int>(), values);
  if (entry.contains("marks")) run_to_marks(entry["marks"], motion, values);
  start_counts(values);
  if (entry.contains("tangents")) run_tangents(setup, motion, number(entry["tangents"], values), values);
  if (entry.contains("record")) {
    const Instant end = after(motion, number(entry["record"], values));
    while (motion.advance(end) == Outcome::event) count(motion, values);
  }
  values["time"] = motion.time().seconds(setup.system.period());
  note_state(values, setup.system, motion.state(), "");
  return number(entry.at("value"), values);
}

double measured(const Entry& entry) {
  if (entry.contains("critical")) return critical_value(entry);
  if (entry.contains("boundary")) return boundary_value(entry);
  Setup setup(entry);
  return plain_value(setup);
}

}  // namespace slapstick::library
