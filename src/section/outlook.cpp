/// Splits the linear motion of a mode into what is conserved, its limit and its amplitudes, and bounds the guards.
#include "section/outlook.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/dense.hpp"
#include "flow/compiled_system.hpp"
#include "flow/contact_state.hpp"
#include "flow/linear_motion.hpp"

namespace slapstick::section {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double unit_roundoff = std::numeric_limits<double>::epsilon();

/// The numbers of a class that the mode does not hold.
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

/// What a motion may change in a mode: contact states `units` z, whose classes have z at the numbers `at`.
struct Free {
  std::vector<Index> at;
  MatrixXd units;
};

/// What a mode holds beside numbers of its own: rows over contact states, of contacts whose displacement depends on
/// others' (the far side of a pair, a loop of contacts).
MatrixXd dependent_holds(const System& system, ModeId mode) {
  const mode::Frame& frame = system.compiled().frame();
  const mode::ContactStates states = system.states(mode);
  MatrixXd rows(0, 2 * frame.n);
  const auto hold = [&](int number, Index from) {
    rows.conservativeResize(rows.rows() + 1, Eigen::NoChange);
    rows.bottomRows(1).setZero();
    rows.bottomRows(1).middleCols(from, frame.n) = frame.dependence.row(number);
  };
  for (int i = frame.n; i < frame.d; ++i)
    if (system.compiled().mode(mode).steady(i)) hold(i, frame.n);
  for (std::size_t i = 0; i < frame.stops.size(); ++i)
    if (states.stops[i] == mode::StopState::closed && frame.stops[i].own >= frame.n) hold(frame.stops[i].own, 0);
  return rows;
}

Free free_states(const flow::Translations& translations, ModeId mode) {
  constexpr double hold_rounding = 1e-10;  // of a row that other holds make zero; those of pairs are of order one
  Free free{free_numbers(translations, mode), {}};
  const Index n = translations.system().compiled().frame().n, numbers = translations.size();
  free.units.resize(2 * n, static_cast<Index>(free.at.size()));
  for (Index j = 0; j < free.units.cols(); ++j)
    free.units.col(j) = translations.representative(VectorXd::Unit(numbers, free.at[static_cast<std::size_t>(j)]));
  MatrixXd held = dependent_holds(translations.system(), mode) * free.units;
  for (Index i = 0; i < held.rows(); ++i)
    if (held.row(i).norm() < hold_rounding) held.row(i).setZero();
  if (held.isZero(0.0)) return free;
  const dense::Kernel left = dense::kernel(held, hold_rounding);
  std::vector<Index> at;
  for (const Index k : left.free) at.push_back(free.at[static_cast<std::size_t>(k)]);
  return {at, free.units * left.basis};
}

/// The numbers of the classes of columns.
MatrixXd classes(const flow::Translations& translations, const MatrixXd& columns) {
  MatrixXd all(translations.size(), columns.cols());
  for (Index j = 0; j < columns.cols(); ++j) {
    VectorXd x = columns.col(j);
    translations.take_out(x);
    all.col(j) = translations.numbers(x);
  }
  return all;
}

/// y = y_0 + basis z, z' = Q z + s, less what is conserved.
struct Reduced {
  MatrixXd basis, Q;
  VectorXd s, size;    ///< size: of the terms that s was made of
  int nulls = 0;       ///< states of rest form a continuum of this many dimensions
  int more_zeros = 0;  ///< multiple zeros: of what moves at a constant speed if displaced
  bool goes_away = false;
  bool bends = false;  ///< .. and not at a constant speed
  VectorXd speed;      ///< of y, if constant
};

void leave_out_conserved(Reduced& all) {
  for (bool first = true; all.Q.rows() > 0; first = false) {
    const double rounding = 64.0 * static_cast<double>(all.Q.rows()) * unit_roundoff;
    const Index size = all.Q.rows();
    const bool constant = all.Q.isZero(0.0);
    const MatrixXd left =
        constant ? MatrixXd(MatrixXd::Identity(size, size)) : dense::kernel(all.Q.transpose(), rounding).basis;
    const Index nulls = left.cols();
    if (nulls == 0) return;
    (first ? all.nulls : all.more_zeros) += static_cast<int>(nulls);
    const MatrixXd V = dense::right_singular_vectors(left.transpose());
    const MatrixXd conserved = V.leftCols(nulls), rest = V.rightCols(V.cols() - nulls);
    const VectorXd pushed = conserved.transpose() * all.s, terms = conserved.transpose().cwiseAbs() * all.size;
    const bool away = (pushed.array().abs() > rounding * terms.array()).any();
    all.goes_away = all.goes_away || away;
    if (away) {
      const VectorXd others = rest.transpose() * all.Q * conserved * pushed;
      all.bends = all.bends || !others.isZero(0.0);
      if (all.bends) return;
      all.speed += all.basis * conserved * pushed;
    }
    all.s = rest.transpose() * all.s;
    all.size = rest.transpose().cwiseAbs() * all.size;
    all.Q = rest.transpose() * all.Q * rest;
    all.basis = all.basis * rest;
  }
}

struct Amplitudes {
  VectorXcd lambda;
  VectorXd error;   ///< of each eigenvalue
  MatrixXcd modes;  ///< columns v_k a_k over z
};

/// @param known  Q, relative to its size
Amplitudes amplitudes(const MatrixXd& Q, const VectorXd& away, double known) {
  const Index size = Q.rows();
  const dense::Eigenpairs pairs = dense::eigenpairs(Q);
  MatrixXcd inverse(size, size);
  for (Index k = 0; k < size; ++k) inverse.col(k) = dense::solve_complex(pairs.vectors, VectorXcd::Unit(size, k));
  const VectorXcd a = inverse * away.cast<std::complex<double>>();
  Amplitudes all{pairs.values, VectorXd(size), pairs.vectors * a.asDiagonal()};
  for (Index k = 0; k < size; ++k)
    all.error[k] = known * Q.norm() * inverse.row(k).norm() * pairs.vectors.col(k).norm();
  return all;
}

/// Where two eigenvectors are one, as at critical damping, those of a matrix beside it, with the error that this is.
Amplitudes amplitudes(const MatrixXd& Q, const VectorXd& away) {
  constexpr double aside = 0x1p-30;
  const double rounding = 8.0 * static_cast<double>(Q.rows()) * unit_roundoff;
  Amplitudes all = amplitudes(Q, away, rounding);
  if (all.modes.allFinite() && all.error.allFinite()) return all;
  MatrixXd beside = Q;
  for (Index i = 0; i < Q.rows(); ++i)
    for (Index j = 0; j < Q.cols(); ++j)
      beside(i, j) += aside * Q.norm() * std::cos(1.0 + 2.0 * static_cast<double>(i) + 3.0 * static_cast<double>(j));
  return amplitudes(beside, away, static_cast<double>(Q.rows()) * aside);
}

/// c e^(sigma t).
struct Term {
  double sigma, c;
};

/// Abel's summation: see the header.
bool never_negative(std::vector<Term> terms, double noise) {
  std::sort(terms.begin(), terms.end(),
            [](const Term& a, const Term& b) { return a.sigma != b.sigma ? a.sigma > b.sigma : a.c > b.c; });
  double sum = 0.0;
  for (const Term& term : terms) {
    sum += term.c;
    if (!(sum >= -noise)) return false;
  }
  return true;
}

/// x + speed t.
struct Line {
  VectorXd x, speed;
};

/// Guards of a motion about `rest`, which the columns of `modes` (over contact states) take it from.
bool no_event(const mode::Mode& mode, const flow::Extension& all, const Line& rest, const Amplitudes& swings,
              const MatrixXcd& modes) {
  const Index d2 = all.by.rows();
  const VectorXd X = all.by * rest.x + all.constant, away = all.by * rest.speed;
  const VectorXd size = all.by.cwiseAbs() * rest.x.cwiseAbs() + all.constant.cwiseAbs();
  for (const mode::Guard& guard : mode.guards()) {
    const mode::RowVector row = guard.row.head(d2);
    const double one = guard.row[guard.row.size() - 1];
    double value = row.dot(X) + one;
    const double noise = mode.noise_factor() * (row.cwiseAbs().dot(size) + std::abs(one));
    if (std::abs(value) <= noise) value = 0.0;
    if (row.dot(away) < -mode.noise_factor() * row.cwiseAbs().dot(away.cwiseAbs())) return false;
    std::vector<Term> terms{{0.0, value}};
    const VectorXcd seen = ((row * all.by).cast<std::complex<double>>() * modes).transpose();
    for (Index k = 0; k < seen.size(); ++k) {
      const double real = swings.lambda[k].real(), error = swings.error[k];
      const double c = swings.lambda[k].imag() == 0.0 ? seen[k].real() : -std::abs(seen[k]);
      terms.push_back({std::abs(real) <= error ? 0.0 : real + (c < 0.0 ? error : -error), c});
    }
    if (!never_negative(std::move(terms), noise)) return false;
  }
  return true;
}

std::vector<std::complex<double>> sorted(const VectorXcd& values, int zeros) {
  std::vector<std::complex<double>> all(values.begin(), values.end());
  all.insert(all.end(), static_cast<std::size_t>(zeros), 0.0);
  std::sort(all.begin(), all.end(),
            [](auto a, auto b) { return a.real() != b.real() ? a.real() > b.real() : a.imag() > b.imag(); });
  return all;
}

/// What decays, swings and grows.
void judge(const Amplitudes& swings, int more_zeros, Outlook& found) {
  const double rounding = static_cast<double>(swings.lambda.size()) * unit_roundoff * swings.modes.cwiseAbs().sum();
  bool swings_on = more_zeros > 0, would_grow = false;
  for (Index k = 0; k < swings.lambda.size(); ++k) {
    const double real = swings.lambda[k].real(), error = swings.error[k];
    swings_on = swings_on || std::abs(real) <= error;
    if (!(real > error)) continue;
    would_grow = true;
    found.grows = found.grows || swings.modes.col(k).cwiseAbs().sum() > rounding;
  }
  found.neutral = swings_on && !would_grow;
  found.drawn = !swings_on && !would_grow;
}

}  // namespace

Outlook outlook(const flow::Translations& translations, const Motion& motion) {
  const System& system = translations.system();
  const mode::Frame& frame = system.compiled().frame();
  const mode::Mode& mode = system.compiled().mode(motion.mode_id());
  const flow::Extension all = flow::extension_of(frame);
  const flow::ContactFlow flow = flow::contact_flow(frame, mode.system(), all);
  const auto [at, units] = free_states(translations, motion.mode_id());
  Outlook found;
  found.here = flow::contact_state(motion);
  translations.take_out(found.here);
  const Index size = found.here.size(), count = static_cast<Index>(at.size());
  Reduced left;
  left.Q = classes(translations, flow.by * units)(at, Eigen::all);
  const VectorXd D = flow::balance(left.Q);
  left.basis = D.asDiagonal();
  left.s = classes(translations, flow.by * found.here + flow.constant)(at, 0).cwiseQuotient(D);
  const VectorXd terms = flow.by.cwiseAbs() * found.here.cwiseAbs() + flow.constant.cwiseAbs();
  left.size = translations.numbers(terms)(at).cwiseQuotient(D);
  left.speed = VectorXd::Zero(count);
  leave_out_conserved(left);
  found.family = left.nulls;
  found.goes_away = left.goes_away;
  found.rest = found.here;
  found.amplitude = VectorXd::Zero(size);
  found.no_event = mode.guards().empty();
  if (left.bends) return found;
  Amplitudes swings;
  MatrixXcd modes(size, 0);
  if (left.Q.rows() > 0) {
    const VectorXd limit = -dense::solve(left.Q, left.s);
    swings = amplitudes(left.Q, -limit);
    const MatrixXd back = units * left.basis;
    found.rest += back * limit;
    modes = back.cast<std::complex<double>>() * swings.modes;
    found.amplitude = modes.cwiseAbs().rowwise().sum();
  }
  judge(swings, left.more_zeros, found);
  found.eigenvalues = sorted(swings.lambda, left.more_zeros);
  VectorXd rate = flow.by * found.rest + flow.constant;
  found.rate = translations.take_out(rate);
  found.no_event = found.no_event || no_event(mode, all, {found.rest, units * left.speed}, swings, modes);
  return found;
}

}  // namespace slapstick::section
