/// Compares orbits at phases, whatever their legs.
#include "orbit/same_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/ranges.hpp"
#include "flow/contact_state.hpp"
#include "orbit/extent.hpp"
#include "orbit/record.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// The states of an orbit over the instants.
class States {
 public:
  States(const Problem& problem, const Orbit& orbit)
      : problem_(problem), orbit_(orbit), set_(constant_family(problem.family().model(orbit.values)), {}) {}

  [[nodiscard]] std::size_t leg_at(double t) const {
    const double within = first_cycle(t);
    std::size_t leg = 0;
    while (leg + 1 < orbit_.legs() && orbit_.t[leg + 1] <= within) ++leg;
    return leg;
  }

  [[nodiscard]] VectorXd state_at(double t) const {
    const std::size_t leg = leg_at(t);
    return contact_state(set_, state_within(set_, orbit_, leg, first_cycle(t) - orbit_.t[leg]));
  }

  /// Numbers of the state modulo translations, displacements first.
  [[nodiscard]] VectorXd at(double t) const {
    VectorXd x = state_at(t);
    problem_.translations().take_out(x);
    return problem_.translations().numbers(x);
  }

 private:
  [[nodiscard]] double first_cycle(double t) const {
    const double cycle = orbit_.t.back() - orbit_.t.front(), after = t - orbit_.t.front();
    return orbit_.t.front() + after - cycle * std::floor(after / cycle);
  }

  const Problem& problem_;
  const Orbit& orbit_;
  ModeSet set_;
};

/// Instants in the longest legs, away from events.
std::vector<double> instants(const Orbit& orbit) {
  constexpr std::size_t most_legs = 4;
  constexpr std::array<double, 3> parts = {0.3, 0.5, 0.8};
  std::vector<std::size_t> legs(orbit.legs());
  std::iota(legs.begin(), legs.end(), std::size_t{0});
  std::erase_if(legs, [&](std::size_t leg) { return orbit.shape.legs[leg].ending == Ending::chatter; });
  ranges::sort(legs, {}, [&](std::size_t leg) { return -orbit.duration(leg); });
  legs.resize(std::min(legs.size(), most_legs));
  std::vector<double> all;
  for (const std::size_t leg : legs)
    for (const double part : parts) all.push_back(orbit.t[leg] + part * orbit.duration(leg));
  return all;
}

/// What is left of the differences of two motions (`sense` -1), or of their sums less the sum of their displacements'
/// own middle (+1), in units of the sizes.
double misfit(const std::vector<VectorXd>& a, const std::vector<VectorXd>& b, double sense, Index velocities) {
  const Index count = a.front().size(), displacements = count - velocities;
  VectorXd size = VectorXd::Zero(count), low = VectorXd::Constant(count, INFINITY), high = -low;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const VectorXd left = a[k] + sense * b[k];
    low = low.cwiseMin(left);
    high = high.cwiseMax(left);
    size = size.cwiseMax(a[k].cwiseAbs()).cwiseMax(b[k].cwiseAbs());
  }
  const auto worst = [&](Index from, Index number, bool may_be_constant) {
    if (number == 0) return 0.0;
    const double spread = may_be_constant ? (high - low).segment(from, number).maxCoeff()
                                          : low.cwiseAbs().cwiseMax(high.cwiseAbs()).segment(from, number).maxCoeff();
    const double of = size.segment(from, number).maxCoeff();
    return of > 0.0 ? spread / of : 0.0;
  };
  return std::max(worst(0, displacements, sense > 0.0), worst(displacements, velocities, false));
}

/// @param sense  as misfit's; @param later  how many periods after a's instants b is seen, and then `more` times a
/// period later still: the least
double least_misfit(const Problem& problem, const Orbit& a, const Orbit& b, double sense, double later, int more) {
  const std::vector<double> when = instants(a);
  if (a.shape.n == 0 || a.shape.n != b.shape.n || when.empty()) return INFINITY;
  const States of_a(problem, a), of_b(problem, b);
  std::vector<VectorXd> left, right;
  for (const double t : when) left.push_back(of_a.at(t));
  double least = INFINITY;
  for (int period = 0; period <= more; ++period) {
    right.clear();
    for (const double t : when) right.push_back(of_b.at(t + later + period));
    least = std::min(least, misfit(left, right, sense, problem.translations().velocities()));
  }
  return least;
}

/// Where the image of an orbit would be, as a symmetric orbit tells: c - x, or x, half a period later.
struct Image {
  double sense = 1.0;
  VectorXd c;  ///< of the contact state
};

Image image_about(const Problem& problem, const Orbit& symmetric) {
  Image image;
  double least = INFINITY, later = 0.5;
  for (const double sense : {1.0, -1.0})
    for (int period = 0; period < symmetric.shape.n; ++period) {
      const double left = least_misfit(problem, symmetric, symmetric, sense, 0.5 + period, 0);
      if (left >= least) continue;
      least = left;
      later = 0.5 + period;
      image.sense = sense;
    }
  const States states(problem, symmetric);
  const double t = instants(symmetric).front();
  image.c = states.state_at(t) + image.sense * states.state_at(t + later);
  image.c.tail(image.c.size() / 2).setZero();
  return image;
}

/// The motion from where the image of an orbit would be: does it stay with the image?
bool has_image(const Problem& problem, const Orbit& orbit, const Orbit& symmetric) {
  const Image image = image_about(problem, symmetric);
  const ModeSet set(constant_family(problem.family().model(orbit.values)), {});
  const std::size_t leg = freest_leg(set, orbit);
  const double t = orbit.t[leg] + 0.5 * orbit.duration(leg);
  const VectorXd x = contact_state(set, state_within(set, orbit, leg, 0.5 * orbit.duration(leg)));
  try {
    const System system(set.model());
    const Motion motion(system, flow::user_state(system, image.c - image.sense * x), Instant{}.plus(t + 0.5));
    std::optional<Orbit> seen = record(motion, orbit.shape.n);
    if (!seen) return false;
    seen->values = orbit.values;
    return 10.0 * apart_from_image(problem, orbit, *seen) < apart_from_image(problem, orbit, orbit);
  } catch (const InputError&) {  // behind a stop
  } catch (const NumericalError&) {
  }
  return false;
}

}  // namespace

double apart(const Problem& problem, const Orbit& a, const Orbit& b) {
  return least_misfit(problem, a, b, -1.0, 0.0, a.shape.n - 1);
}

bool resembles(const Problem& problem, const Orbit& a, const Orbit& b, double much_the_same) {
  constexpr double shortest_leg = 0.1, least_part_alike = 0.5;  // of a cycle; of what is looked at
  constexpr std::array parts = {0.1, 0.3, 0.5, 0.7, 0.9};
  const States of_a(problem, a), of_b(problem, b);
  const Extent extent(problem, a);
  const auto alike = [&](std::size_t i, double t_a, std::size_t j, double t_b) {
    if (!(a.shape.legs[i].states == b.shape.legs[j].states)) return false;
    return extent.distance(of_a.state_at(t_a), of_b.state_at(t_b)) <= much_the_same;
  };
  const auto is_in_b = [&](std::size_t i, double t) {
    for (int period = 0; period < b.shape.n; ++period)
      if (alike(i, t, of_b.leg_at(t + period), t + period)) return true;
    for (std::size_t j = 0; b.shape.n == 0 && j < b.legs(); ++j)
      if (alike(i, a.t[i], j, b.t[j])) return true;
    return false;
  };
  double all = 0.0, same = 0.0;
  for (std::size_t i = 0; i < a.legs(); ++i) {
    if (a.duration(i) < shortest_leg * (a.t.back() - a.t.front())) continue;
    for (const double part : parts) {
      all += a.duration(i);
      if (is_in_b(i, a.t[i] + part * a.duration(i))) same += a.duration(i);
    }
  }
  return same > 0.0 && same >= least_part_alike * all;
}

double apart_from_later(const Problem& problem, const Orbit& orbit, int periods) {
  return least_misfit(problem, orbit, orbit, -1.0, periods, 0);
}

double apart_from_image(const Problem& problem, const Orbit& a, const Orbit& b) {
  const auto half_later = [&](double sense) { return least_misfit(problem, a, b, sense, 0.5, a.shape.n - 1); };
  return std::min(half_later(1.0), half_later(-1.0));
}

double apart_from_own_image(const Problem& problem, const Orbit& orbit) {
  if (orbit.shape.n > 0) return apart_from_image(problem, orbit, orbit);
  const States states(problem, orbit);
  const double half = 0.5 * (orbit.t.back() - orbit.t.front());
  std::vector<VectorXd> now, later;
  for (const double t : instants(orbit)) {
    now.push_back(states.at(t));
    later.push_back(states.at(t + half));
  }
  return now.empty() ? INFINITY : misfit(now, later, 1.0, problem.translations().velocities());
}

bool breaks_symmetry(const Problem& problem, const Orbit& orbit, const Orbit& symmetric) {
  constexpr double symmetric_within = 1e-4, symmetry_rounding = 1e-6;  // at a crossing states are known to 1e-5
  const double left = apart_from_image(problem, symmetric, symmetric);
  if (!(left < symmetric_within)) return false;
  if (!(apart_from_image(problem, orbit, orbit) > std::max(10.0 * left, symmetry_rounding))) return false;
  return has_image(problem, orbit, symmetric);
}

}  // namespace slapstick::orbit
