/// Solves for the state of rest of a mode, and follows a motion towards it.
#include "section/rest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/dense.hpp"
#include "flow/compiled_system.hpp"
#include "section/flights.hpp"
#include "slapstick/flow/stage.hpp"

namespace slapstick::section {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// x' = by x + constant of a contact state x in one mode.
struct Flow {
  MatrixXd by;
  VectorXd constant;
};

Flow flow_of(const System& system, ModeId mode) {
  const mode::Frame& frame = system.compiled().frame();
  const mode::Matrix& A = system.compiled().mode(mode).system();
  const Index n = frame.n, d = frame.d;
  // What depends on the first n follows them: p = dependence (p + shift) - shift, u likewise with the drift.
  MatrixXd follow = MatrixXd::Zero(2 * d, 2 * n);
  follow.topLeftCorner(d, n) = follow.bottomRightCorner(d, n) = frame.dependence;
  VectorXd apart(2 * d);
  apart << frame.shift_slack, frame.drift_slack;
  const MatrixXd by = A.topLeftCorner(2 * d, 2 * d) * follow;
  const VectorXd constant = A.topLeftCorner(2 * d, 2 * d) * apart + A.col(frame.one()).head(2 * d);
  Flow flow{MatrixXd(2 * n, 2 * n), VectorXd(2 * n)};
  flow.by << by.topRows(n), by.middleRows(d, n);
  flow.constant << constant.head(n), constant.segment(d, n);
  return flow;
}

/// The numbers of a class that the mode does not hold at zero.
std::vector<Index> free_numbers(const flow::Translations& translations, ModeId mode) {
  const System& system = translations.system();
  const mode::Frame& frame = system.compiled().frame();
  const mode::ContactStates states = system.states(mode);
  std::vector<bool> kept(2 * static_cast<std::size_t>(frame.n), true);
  for (int i = 0; i < frame.n; ++i)
    kept[static_cast<std::size_t>(frame.n + i)] = !system.compiled().mode(mode).steady(i);
  for (std::size_t i = 0; i < frame.stops.size(); ++i)
    if (states.stops[i] == mode::StopState::closed && frame.stops[i].own < frame.n)
      kept[static_cast<std::size_t>(frame.stops[i].own)] = false;
  const VectorXd marks = translations.numbers(VectorXd::LinSpaced(2 * frame.n, 0.0, 2.0 * frame.n - 1.0));
  std::vector<Index> numbers;
  for (Index k = 0; k < marks.size(); ++k)
    if (kept[static_cast<std::size_t>(marks[k])]) numbers.push_back(k);
  return numbers;
}

/// The numbers of the classes of columns.
MatrixXd classes(const flow::Translations& translations, const MatrixXd& columns) {
  MatrixXd all(columns.rows() - translations.count(), columns.cols());
  for (Index j = 0; j < columns.cols(); ++j) {
    VectorXd x = columns.col(j);
    translations.take_out(x);
    all.col(j) = translations.numbers(x);
  }
  return all;
}

VectorXd representative(const flow::Translations& translations, const Motion& motion) {
  VectorXd x = flow::contact_state(motion);
  translations.take_out(x);
  return x;
}

/// Rounding of eigenvalues of the size of the largest; a double 0 is known to its square root.
double zero_of(const Eigen::VectorXcd& values) {
  const double rounding = static_cast<double>(values.size()) * std::numeric_limits<double>::epsilon();
  return values.size() > 0 ? std::sqrt(rounding) * values.cwiseAbs().maxCoeff() : 0.0;
}

/// Less those that are zero, as many as there are null vectors.
std::vector<std::complex<double>> less_zeros(const Eigen::VectorXcd& values, int nulls) {
  std::vector<std::complex<double>> all(values.begin(), values.end());
  std::sort(all.begin(), all.end(), [](auto a, auto b) { return std::norm(a) < std::norm(b); });
  all.erase(all.begin(), all.begin() + std::min<std::ptrdiff_t>(nulls, static_cast<std::ptrdiff_t>(all.size())));
  std::sort(all.begin(), all.end(), [](auto a, auto b) {
    return a.real() != b.real() ? a.real() > b.real() : a.imag() > b.imag();
  });
  return all;
}

/// Follows the motion while an amplitude falls to a thousandth by the slowest eigenvalue.
void approach(const flow::Translations& translations, Motion motion, double slowest, Stop stop, Rest& found) {
  constexpr double there = 1e-10, fallen = 0.1;  // a thousandth, and what a product of both may make of it
  const Index n = found.x.size() / 2;
  const VectorXd first = representative(translations, motion);
  VectorXd scale = first.cwiseAbs().cwiseMax(found.x.cwiseAbs());
  scale.head(n).setConstant(std::max(scale.head(n).maxCoeff(), 1e-300));
  scale.tail(n).setConstant(std::max(scale.tail(n).maxCoeff(), 1e-300));
  const double away = distance(first, found.x, scale), period = translations.system().period();
  found.approach = away;
  if (away <= there) {
    found.drawn = true;
    return;
  }
  const double periods = std::min(std::log(1e3) / slowest / period, patience(translations.system()));
  const Instant end = motion.time().plus(periods);
  const ModeId mode = motion.mode_id();
  if (!run_to(motion, end, stop, [] {}) || motion.mode_id() != mode) return;
  found.approach = distance(representative(translations, motion), found.x, scale);
  found.drawn = found.approach <= std::max(there, fallen * away);
}

}  // namespace

std::optional<Rest> rest(const flow::Translations& translations, Motion motion, Stop stop) {
  constexpr double solved = 1e-9;
  const System& system = translations.system();
  const ModeId mode = motion.mode_id();
  const std::vector<Index> at = free_numbers(translations, mode);
  const Flow flow = flow_of(system, mode);
  const Index size = flow.constant.size(), count = size - translations.count();
  MatrixXd units(size, count);
  for (Index j = 0; j < count; ++j) units.col(j) = translations.representative(VectorXd::Unit(count, j));
  const MatrixXd Q = classes(translations, flow.by * units)(at, at);
  const VectorXd here = representative(translations, motion);
  const VectorXd speed = classes(translations, flow.by * here + flow.constant)(at, 0);
  VectorXd change = VectorXd::Zero(count);
  double zero = 0.0;
  Rest found;
  if (!at.empty()) {
    change(at) = -dense::LeastNorm(Q).solve(speed);
    const double terms = (flow.by * here).cwiseAbs().maxCoeff() + flow.constant.cwiseAbs().maxCoeff();
    if ((Q * change(at) + speed).cwiseAbs().maxCoeff() > solved * std::max(terms, 1e-300)) return std::nullopt;
    const Eigen::VectorXcd values = dense::eigenvalues(Q);
    found.family = static_cast<int>(Q.rows() - dense::rank(Q));
    found.eigenvalues = less_zeros(values, found.family);
    zero = zero_of(values);
  }
  found.x = here + translations.representative(change);
  found.held = held(system, mode) > 0;
  VectorXd rate = flow.by * found.x + flow.constant;
  found.advance = system.period() * translations.take_out(rate);
  const double slowest = found.eigenvalues.empty() ? INFINITY : -found.eigenvalues.front().real();
  // A zero that is left is no state of rest but a speed that nothing brakes.
  const auto goes_away = [zero](std::complex<double> value) { return std::abs(value) <= zero; };
  found.neutral = std::abs(slowest) <= zero &&
                  std::none_of(found.eigenvalues.begin(), found.eigenvalues.end(), goes_away);
  if (slowest > zero) approach(translations, std::move(motion), slowest, stop, found);
  return found;
}

}  // namespace slapstick::section
