/// What no motion may lose or make: momentum at impacts and between them, energy over every segment and every period.
///
/// Rounding is counted in units of 2^-53 of the greatest energy (momentum) that the segment's greatest coordinate and
/// velocity could have: a stored number is a sum of m terms that is rounded m + 16 times in every window
/// (docs/developers/proofs.md, section 3). The terms of a window's sum are together at most e^|A H| < 8 times what they
/// start from.
#include <gtest/gtest.h>
#include <Eigen/QR>

#include <cmath>
#include <numbers>

#include "flow/compiled_system.hpp"
#include "mode/mode.hpp"
#include "property/newton.hpp"
#include "property/property.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::test {
namespace {

constexpr int periods = 4;
constexpr long most_segments = 600;

/// Follows a motion and settles what each segment and each event did; the first thing that does not add up is `wrong`.
class Ledger {
 public:
  explicit Ledger(const Machine& machine)
      : system_(machine.model),
        newton_(system_.model()),
        motion_(system_, machine.start),
        x_(machine.start),
        machine_start_(machine.start) {}

  std::string run() {
    last_ = newton_.energy(machine_start_);
    for (int k = 1; k <= periods && wrong_.empty(); ++k) {
      const double begun = last_;
      gains_ = 0.0, allowed_ = 0.0;
      while (motion_.advance({k, 0.0}) == Outcome::event) {
        if (motion_.counters().segments == seen_) continue;  // another event of this instant
        if (++settled > most_segments || !wrong_.empty()) return wrong_;
        settle_segment();
        settle_event();
        cut_ = false;
      }
      if (motion_.counters().segments != seen_) settle_segment();  // else the event was at the very end
      cut_ = true;
      expect("energy of a period", last_ - begun - gains_, allowed_);
    }
    return wrong_;
  }

  long settled = 0, impacts = 0, blows = 0;
  double worst = 0.0;  ///< of all balances, in what is allowed

 private:
  void expect(const char* what, double defect, double allowed) {
    worst = std::max(worst, std::abs(defect) / allowed);
    if (std::abs(defect) <= allowed || !wrong_.empty()) return;
    char text[200];
    std::snprintf(text, sizeof text, "%s: off by %.3g, %.3g allowed; at %.17g periods, event %s, mode %s", what, defect,
                  allowed, static_cast<double>(motion_.time().period) + motion_.time().fraction,
                  std::string(name(motion_.event().kind)).c_str(), system_.mode_name(motion_.segment().mode).c_str());
    wrong_ = text;
  }

  [[nodiscard]] double roundings(double windows) const {
    return 0x1p-50 * (system_.compiled().frame().size() + 16) * windows;
  }

  /// Between two events: what the forcing gave, and what dampers, friction and compliant stops took, is the change of
  /// energy.
  void settle_segment() {
    const Motion::Segment segment = motion_.segment();
    seen_ = motion_.counters().segments;
    const mode::Mode& mode = system_.compiled().mode(segment.mode);
    const double windows = 1.0 + segment.duration / mode.window();
    sizes_ = {};
    motion_.sample(0.0, x_);
    sizes_.note(x_);
    const double begun = newton_.energy(x_), jump = begun - last_;
    const double work_done = work(segment, mode);
    motion_.sample(segment.duration, x_);
    sizes_.note(x_);
    // Velocities are sums of the accelerations' terms, too; since the flight began, not since it was cut.
    const double flown = cut_ ? mode.window() : std::min(mode.window(), segment.duration);
    sizes_.v += flown * newton_.acceleration_size(sizes_);
    const double unit = newton_.energy_size(sizes_) + newton_.power_size(sizes_) * segment.duration;
    const double allowed = roundings(windows) * unit;
    expect("energy before a segment", jump + plastic_loss(), allowed);
    expect("energy of a segment", newton_.energy(x_) - begun - work_done, allowed);
    gains_ += work_done + jump;
    allowed_ += 3.0 * allowed;
    last_ = newton_.energy(x_);
  }

  /// A chatter is flown from the velocity after a plastic impact: the rest of its impacts takes what that takes.
  double plastic_loss() {
    const bool limit = motion_.event().kind == EventKind::chatter && motion_.strikes().empty();
    if (!limit || motion_.time() != motion_.event().time || motion_.counters().events == 0) return 0.0;
    const Stop& stop = system_.model().stops[motion_.event().contact];
    return std::pow(Newton::difference(after_, stop.a, stop.b, 1), 2) / (2.0 * newton_.mobility(stop.a, stop.b));
  }

  /// Gauss and Legendre's sum over halves of windows: there exp(A s) has |A s| of about 1, and the sum's error is below
  /// 1e-17 of the power.
  double work(const Motion::Segment& segment, const mode::Mode& mode) {
    constexpr double node[4] = {0.18343464249564981, 0.52553240991632899, 0.79666647741362674, 0.96028985649753623};
    constexpr double weight[4] = {0.36268378337836198, 0.31370664587788729, 0.22238103445337448, 0.10122853629037626};
    const auto power_at = [&](double s) {
      motion_.sample(s, x_);
      sizes_.note(x_);
      const double theta = 2 * std::numbers::pi * segment.start.fraction + system_.model().omega * s;
      return newton_.power(x_, mode.states(), theta);
    };
    const int pieces = 1 + static_cast<int>(2.0 * segment.duration / mode.window());
    const double half = 0.5 * segment.duration / pieces;
    double sum = 0.0;
    for (int i = 0; i < pieces; ++i) {
      for (int k = 0; k < 4; ++k)
        sum += half * weight[k] * (power_at((2 * i + 1 + node[k]) * half) + power_at((2 * i + 1 - node[k]) * half));
    }
    return sum;
  }

  /// At an event: momentum changes along the stops that were struck, and not otherwise; one stop's impulse is Newton's.
  void settle_event() {
    after_ = motion_.state();
    const State before(motion_.before().begin(), motion_.before().end());
    sizes_.note(after_);
    const Eigen::VectorXd v = Newton::velocities(before), v_after = Newton::velocities(after_);
    const Eigen::VectorXd change = newton_.mass() * (v_after - v);
    const double speed = sizes_.v + newton_.least().v, mass = newton_.mass().cwiseAbs().sum();
    // Velocities that are zero within the rounding of all that went before are made zero, too.
    greatest_ = std::max(greatest_, speed);
    const double residue = roundings(1.0) * mass * greatest_;
    const double loss = newton_.kinetic(v) - newton_.kinetic(v_after);
    std::uint32_t struck = 0;
    for (const Motion::Strike& strike : motion_.strikes()) struck |= strike.stops;
    const Eigen::MatrixXd G = rows(struck);
    if (struck != 0) {
      const Eigen::VectorXd P = G.transpose().completeOrthogonalDecomposition().solve(-change);
      expect("momentum of an impact", (change + G.transpose() * P).norm(), residue);
      if (G.rows() == 1) expect("a stop that pulls", std::min(P[0], 0.0), residue);
      one_impact(before, loss, roundings(1.0) * greatest_, residue * speed);
      blows += G.rows() > 1;
    } else if (motion_.event().kind != EventKind::graze) {
      expect("momentum without an impact", change.norm(), residue);
    }
    last_ = newton_.energy(after_);
    gains_ -= loss;
    allowed_ += roundings(1.0) * newton_.energy_size(sizes_);
  }

  /// w+ = -r w and a loss of (1 - r^2) w^2 / (2 g M^{-1} g^T), and if the restitutions are all one number no impacts
  /// make energy.
  void one_impact(const State& before, double loss, double rounding_of_w, double rounding_of_loss) {
    impacts += static_cast<long>(motion_.strikes().size());
    const auto& stops = system_.model().stops;
    const bool alike = std::ranges::all_of(
        stops, [&](const Stop& s) { return s.restitution == stops[0].restitution && s.corners.empty(); });
    if (alike) expect("energy made by an impact", std::min(loss, 0.0), rounding_of_loss);
    const bool one = motion_.strikes().size() == 1 && motion_.event().kind == EventKind::impact;
    if (!one || motion_.strikes()[0].stops != std::uint32_t{1} << motion_.event().contact) return;
    const Stop& stop = stops[motion_.event().contact];
    const double w = Newton::difference(before, stop.a, stop.b, 1), r = rebound(stop, w).restitution;
    const double mu = 1.0 / newton_.mobility(stop.a, stop.b);
    expect("speed of an impact", w - motion_.event().w, rounding_of_w);
    expect("Newton's law", Newton::difference(after_, stop.a, stop.b, 1) + r * w, rounding_of_w);
    expect("loss of an impact", loss - 0.5 * mu * (1 - r * r) * w * w, rounding_of_loss);
  }

  [[nodiscard]] Eigen::MatrixXd rows(std::uint32_t struck) const {
    Eigen::MatrixXd G(std::popcount(struck), system_.model().size());
    Eigen::Index i = 0;
    for (std::size_t s = 0; s < system_.model().stops.size(); ++s)
      if ((struck >> s & 1U) != 0) G.row(i++) = newton_.row(system_.model().stops[s].a, system_.model().stops[s].b);
    return G;
  }

  System system_;
  Newton newton_;
  Motion motion_;
  State x_, machine_start_, after_ = machine_start_;
  Sizes sizes_;
  std::string wrong_;
  double last_ = 0.0;                   ///< energy when last looked at
  double gains_ = 0.0, allowed_ = 0.0;  ///< of this period
  long seen_ = 0;
  bool cut_ = false;
  double greatest_ = 0.0;  ///< speed of all segments so far
};

void expect_balanced(const Shape& shape, int machines, long least_settled, long least_impacts) {
  long settled = 0, impacts = 0, blows = 0;
  double worst = 0.0;
  expect_of_all(shape, machines, [&](const Machine& machine) {
    Ledger ledger(machine);
    const std::string wrong = ledger.run();
    settled += ledger.settled, impacts += ledger.impacts, blows += ledger.blows;
    worst = std::max(worst, ledger.worst);
    return wrong;
  });
  std::printf("%ld segments, %ld impacts, %ld of several stops at once; worst balance %.2f of what is allowed\n",
              settled, impacts, blows, worst);
  EXPECT_GE(settled, least_settled);
  EXPECT_GE(impacts, least_impacts);
}

TEST(Balance, MomentumAndEnergyOfSmallMachines) { expect_balanced({}, 300, 6000, 3000); }

TEST(Balance, OfEveryLawOfForce) { expect_balanced({.most_compliant = 2, .laws = true}, 300, 6000, 2000); }

TEST(Balance, OfNetworksWithManyContacts) {
  expect_balanced({.least_coordinates = 2,
                   .most_coordinates = 8,
                   .most_stops = 4,
                   .most_frictions = 4,
                   .most_compliant = 2,
                   .one_restitution = true},
                  100, 4000, 2500);
}

}  // namespace
}  // namespace slapstick::test
