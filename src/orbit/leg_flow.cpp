/// One leg in closed form: where it starts, impacts, and what an event makes zero, with all first derivatives.
#include "orbit/leg_flow.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/ranges.hpp"
#include "flow/collision.hpp"
#include "flow/contact_state.hpp"
#include "orbit/contact_jet.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

/// The impulses of stops that are struck together (flow/collision.hpp), of all columns of a jet.
void push(const ModeSet& set, const Motion::Strike& strike, Jet& X) {
  const mode::Frame& frame = set.frame();
  const Index d = frame.d;
  const flow::Collision hit(set.model(), frame, strike, X.value());
  const MatrixXd before = X.all.middleRows(d, d)(hit.rows, Eigen::all);
  MatrixXd load = hit.slope.asDiagonal() * before;
  load.col(0) = hit.factor.cwiseProduct(before.col(0));
  const MatrixXd P = flow::impulses(frame, hit.rows, load), S = frame.mass_inverse(Eigen::all, hit.rows);
  X.all.middleRows(d, d) -= S * P;
  for (Index p = 0; p < X.parameters; ++p) {
    const auto which = static_cast<std::size_t>(p);
    const MatrixXd S_rate = set.frame_rate(which).mass_inverse(Eigen::all, hit.rows);
    VectorXd change = -S_rate(hit.rows, Eigen::all) * P.col(0);
    for (std::size_t i = 0; i < hit.stops.size() && !strike.to_rest; ++i) {
      const int stop = hit.stops[i];
      const auto row = static_cast<Index>(i);
      change[row] +=
          rebound_rate(set.model().stops[stop], set.rate(which).stops[stop], hit.speed[row]) * before(row, 0);
    }
    X.by_parameter().col(p).segment(d, d) -= S * flow::impulses(frame, hit.rows, change) + S_rate * P.col(0);
  }
}

/// The rates of sliders, which tables show.
void set_slider_rates(const mode::Frame& frame, const Leg& leg, Jet& X) {
  for (const mode::SliderRow& row : frame.sliders) {
    auto rate = X.all.row(frame.u(row.own));
    rate.setZero();
    if (!row.rests(leg.states.pieces)) rate = row.pair.sign * X.all.row(frame.u(row.pair.own));
  }
}

/// h of a guard's zero.
Jet guard_jet(const ModeRates& mode, const Leg& leg, const Jet& X) {
  const std::size_t g = mode.guard(leg.kind, leg.contact);
  Jet h(1, X.states, X.parameters);
  h.all = mode.outline.guards[g].row * X.all;
  for (Index p = 0; p < X.parameters; ++p)
    h.by_parameter()(0, p) += mode.rates[static_cast<std::size_t>(p)].guards[g].dot(X.value());
  return h;
}

/// h of the end of a signal's line.
Jet knot_jet(const ModeSet& set, const Leg& leg, const Jet& X, double t_end) {
  const auto signal = static_cast<std::size_t>(leg.contact);
  const int line = leg.lines[signal];
  Jet h(1, X.states, X.parameters);
  h.value()[0] = t_end - mode::line_end(set.model().signals[signal], line, t_end);
  h.by_end()[0] = 1.0;
  for (Index p = 0; p < X.parameters; ++p)
    h.by_parameter()(0, p) = -mode::line_end_rate(set.rate(static_cast<std::size_t>(p)).signals[signal], line);
  return h;
}

void kick(const ModeSet& set, const Pulse& pulse, Jet& X) {
  const mode::Frame& frame = set.frame();
  const auto signal = static_cast<std::size_t>(pulse.signal);
  frame.kick(signal, pulse.area[0], X.value().data());
  for (Index p = 0; p < X.parameters; ++p)
    X.by_parameter().col(p).segment(frame.d, frame.d) +=
        mode::kick_rate(frame, set.frame_rate(static_cast<std::size_t>(p)), signal, pulse.area[0], pulse.area[1 + p]);
}

/// What happens to the velocities at a leg's end, as an Engine does it: the blows of forces, which stops bear, then the
/// jumps of walls, then impacts.
void strike(const ModeSet& set, const Leg& leg, Jet& X) {
  const std::vector<Pulse> all = pulses(set, leg);
  const auto kick_all = [&](bool kinematic) {
    for (const Pulse& pulse : all)
      if (pulse.kinematic == kinematic) kick(set, pulse, X);
  };
  kick_all(false);
  auto next = leg.strikes.begin();
  if (!all.empty() && next != leg.strikes.end() && next->to_rest) push(set, *next++, X);
  kick_all(true);
  for (; next != leg.strikes.end(); ++next) push(set, *next, X);
}

/// A number and its derivatives, the columns of a jet.
using NumberJet = RowVectorXd;

/// q of rise, fall and the restitution r: 1 / v times the length of the series of flights.
///
///     q = g / D,   g = 1 / rise + 1 / sqrt(rise fall),   D = 1 - rho,   rho = r sqrt(fall / rise)
NumberJet flights_jet(const NumberJet& rise, const NumberJet& fall, const NumberJet& r) {
  const double up = rise[0], down = fall[0], both = std::sqrt(up * down), rho = r[0] * std::sqrt(down / up);
  const double g = 1.0 / up + 1.0 / both, D = 1.0 - rho;
  const RowVectorXd g_rate = -(1.0 / (up * up) + 0.5 / (up * both)) * rise - 0.5 / (down * both) * fall;
  const RowVectorXd rho_rate = std::sqrt(down / up) * r + 0.5 * rho * (fall / down - rise / up);
  NumberJet q = g_rate / D + g / (D * D) * rho_rate;
  q[0] = g / D;
  return q;
}

/// The mode of the flights of a chatter. The stop is open. Friction of its pair slips away from the stop or back (sense
/// -1 or 1), other friction slips as at X. What is at rest there has no force that is known.
mode::ContactStates in_flight(const mode::Frame& frame, const Leg& leg, const VectorXd& X, double sense) {
  using mode::FrictionState;
  mode::ContactStates states = leg.states;
  const mode::ContactRow& own = frame.stops[leg.contact];
  states.stops[leg.contact] = mode::StopState::open;
  for (std::size_t i = 0; i < frame.frictions.size(); ++i) {
    if (states.frictions[i] == FrictionState::unloaded) continue;
    const mode::ContactRow& contact = frame.frictions[i];
    const double w = frame.in_step(own.own, contact.own)
                         ? sense * own.sign * contact.sign * frame.parallel(own.own, contact.own)
                         : contact.sign * X[frame.u(contact.own)];
    states.frictions[i] = w > 0.0   ? FrictionState::slip_plus
                          : w < 0.0 ? FrictionState::slip_minus
                                    : FrictionState::unloaded;
  }
  return states;
}

/// The acceleration of the pair of a chatter towards its stop, in the mode of a flight.
NumberJet towards_stop(const ModeSet& set, const Leg& leg, const Jet& X, double sense) {
  const mode::Frame& frame = set.frame();
  const mode::ContactRow& own = frame.stops[leg.contact];
  const ModeRates& mode = set.mode(in_flight(frame, leg, X.value(), sense));
  const Index row = frame.u(own.own), first = X.all.cols() - X.parameters;
  NumberJet towards = own.sign * mode.outline.system.row(row) * X.all;
  for (Index p = 0; p < X.parameters; ++p)
    towards[first + p] += own.sign * mode.rates[static_cast<std::size_t>(p)].system.row(row).dot(X.value());
  return towards;
}

/// h = s - v q: the series of all flights that follow a separation at speed v (flow/chatter.hpp).
Jet chatter_jet(const ModeSet& set, const Leg& leg, const Jet& X, double t_begin, double t_end) {
  const mode::Frame& frame = set.frame();
  const int stop = leg.contact;
  const mode::ContactRow& own = frame.stops[stop];
  const auto rate = [&](std::size_t p) -> const Model& { return set.rate(p); };
  const NumberJet rise = towards_stop(set, leg, X, -1.0), fall = towards_stop(set, leg, X, 1.0);
  NumberJet r = NumberJet::Zero(X.all.cols());
  const Index first = X.all.cols() - X.parameters;  // of the parameters
  r[0] = set.model().stops[stop].restitution;
  for (Index p = 0; p < X.parameters; ++p) r[first + p] = rate(static_cast<std::size_t>(p)).stops[stop].restitution;
  const NumberJet q = flights_jet(rise, fall, r);
  Jet h(1, X.states, X.parameters);
  const RowVectorXd v =
      own.sign * X.all.row(frame.u(own.own));  // separating: the pair's velocity towards the stop is -v
  h.all = q[0] * v + v[0] * q;
  h.all(0, 0) = q[0] * v[0];
  h.all(0, 0) += (t_end - t_begin) * set.period();
  h.by_begin()[0] -= set.period();
  h.by_end()[0] += set.period();
  for (Index p = 0; p < X.parameters; ++p)
    h.by_parameter()(0, p) += (t_end - t_begin) * set.period_rate(static_cast<std::size_t>(p));
  return h;
}

}  // namespace

Jet extended(const ModeSet& set, const std::vector<int>& lines, const VectorXd& x, double t) {
  const mode::Frame& frame = set.frame();
  const Index n = frame.n, d = frame.d, count = static_cast<Index>(set.parameters());
  Jet X(frame.size(), 2 * n, count);
  VectorXd value = VectorXd::Zero(frame.size());
  value.head(d) = frame.dependence * (x.head(n) + frame.shift.head(n)) - frame.shift;
  value.segment(d, d) = frame.dependence * (x.tail(n) + frame.drift.head(n)) - frame.drift;
  value.head(n) = x.head(n);  // exactly
  value.segment(d, n) = x.tail(n);
  const mode::PeriodicDrive drive(set.model(), frame);
  frame.set_inner_rates(value.data());
  drive.set(t, lines, value.data());
  X.value() = value;
  X.by_state().topLeftCorner(d, n) = frame.dependence;
  X.by_state().block(d, n, d, n) = frame.dependence;
  X.by_begin() = drive.by_turns(value);
  for (Index p = 0; p < count; ++p) {
    const mode::FrameDerivative& rate = set.frame_rate(static_cast<std::size_t>(p));
    X.by_parameter().col(p) = drive.by_parameter(set.rate(static_cast<std::size_t>(p)), t, lines);
    X.by_parameter().col(p).head(d) = frame.dependence * rate.shift.head(n) - rate.shift;
    X.by_parameter().col(p).segment(d, d) = frame.dependence * rate.drift.head(n) - rate.drift;
    for (std::size_t i = 0; i < frame.inner.size(); ++i)
      X.by_parameter()(frame.u(frame.inner[i].own), p) = rate.inner_rate[i].dot(value);
  }
  for (const mode::InnerRow& row : frame.inner)
    X.by_state().row(frame.u(row.own)) << row.rate.head(n), RowVectorXd::Zero(n);
  return X;
}

/// Of a signal whose line ends here, or, of a tied end, has ended at this instant.
std::vector<Pulse> pulses(const ModeSet& set, const Leg& leg) {
  std::vector<Pulse> all;
  if (leg.ending != Ending::knot) return all;
  for (const int signal : leg.pulses) {
    const auto k = static_cast<std::size_t>(signal),
               knot = static_cast<std::size_t>(leg.lines[k] + (signal == leg.contact ? 1 : 0));
    RowVectorXd area(1 + static_cast<Index>(set.parameters()));
    area[0] = set.model().signals[k].knots[knot].pulse;
    for (std::size_t p = 0; p < set.parameters(); ++p)
      area[static_cast<Index>(1 + p)] = set.rate(p).signals[k].knots[knot].pulse;
    if (!area.isZero(0.0)) all.push_back({signal, set.model().signals[k].kinematic, area});
  }
  return all;
}

VectorXd behind_pulses(const ModeSet& set, const Leg& leg, VectorXd X) {
  for (const Pulse& pulse : pulses(set, leg))
    set.frame().kick(static_cast<std::size_t>(pulse.signal), pulse.area[0], X.data());
  return X;
}

Jet leg_start(const ModeSet& set, const Leg& leg, const VectorXd& x, double t_begin) {
  Jet X = extended(set, leg.lines, x, t_begin);
  set_slider_rates(set.frame(), leg, X);
  if (leg.chattering != 0) push(set, {leg.chattering, true}, X);
  return X;
}

VectorXd state_within(const ModeSet& set, const Orbit& orbit, std::size_t leg, double after) {
  const Jet start = leg_start(set, orbit.shape.legs[leg], orbit.x[leg], orbit.t[leg]);
  Jet X(start.all.rows(), 0, 0);
  X.value() = start.value();
  flow(set.mode(orbit.shape.legs[leg].states), after * set.period(), X);
  return X.value();
}

std::ptrdiff_t held(const ModeSet& set, const Leg& leg) {
  return ranges::count(set.mode(leg.states).outline.steady, true);
}

std::size_t freest_leg(const ModeSet& set, const Orbit& orbit) {
  const double alike =
      1e-6 * (orbit.t.back() - orbit.t.front());  // as half swings between dry surfaces: not told apart by rounding
  const auto held_in = [&](std::size_t i) {
    return std::pair(orbit.shape.legs[i].ending == Ending::chatter, held(set, orbit.shape.legs[i]));
  };
  const auto phase = [&](std::size_t i) { return orbit.t[i] - std::floor(orbit.t[i]); };
  const auto faster = [&](std::size_t i, std::size_t than) {  // no instant is special: by the states at their starts
    const Index n = orbit.x[i].size() / 2;
    for (const Index first : {n, Index{0}}) {  // velocities, displacements
      const VectorXd a = orbit.x[i].segment(first, n), b = orbit.x[than].segment(first, n);
      const double same = 1e-6 * a.cwiseAbs().cwiseMax(b.cwiseAbs()).maxCoeff();
      for (Index k = 0; k < n; ++k)
        if (std::abs(a[k] - b[k]) > same) return a[k] > b[k];
    }
    return false;
  };
  const auto freer = [&](std::size_t i, std::size_t than) {
    if (held_in(i) != held_in(than)) return held_in(i) < held_in(than);
    const double longer = orbit.duration(i) - orbit.duration(than);
    if (std::abs(longer) > alike) return longer > 0.0;
    return orbit.shape.n > 0 ? phase(i) < phase(than) : faster(i, than);
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < orbit.legs(); ++i)
    if (freer(i, best)) best = i;
  return best;
}

VectorXd contact_state(const ModeSet& set, const VectorXd& X) { return flow::contact_state(set.frame(), X); }

LegValue leg_value(const ModeSet& set, const Leg& leg, const Leg& next, const VectorXd& x, double t_begin,
                   double t_end) {
  const ModeRates& mode = set.mode(leg.states);
  Jet X = leg_start(set, leg, x, t_begin);
  const double T = set.period(), s = (t_end - t_begin) * T;
  flow(mode, s, X);
  const VectorXd rate = mode.outline.system * X.value();
  X.by_begin() -= T * rate;
  X.by_end() += T * rate;
  for (Index p = 0; p < X.parameters; ++p)
    X.by_parameter().col(p) += (t_end - t_begin) * set.period_rate(static_cast<std::size_t>(p)) * rate;
  Jet h(1, X.states, X.parameters);
  if (leg.ending == Ending::guard || leg.ending == Ending::onset) h = guard_jet(mode, leg, X);
  if (leg.ending == Ending::chatter) h = chatter_jet(set, leg, extended(set, leg.lines, x, t_begin), t_begin, t_end);
  if (leg.ending == Ending::knot) h = knot_jet(set, leg, X, t_end);
  Jet struck = X;
  strike(set, leg, struck);
  return {std::move(X), contact_jet(set, next, struck), std::move(h)};
}

}  // namespace slapstick::orbit
