/// Makes a list of cycles, and follows motions beside them.
#include "sweep/known_cycles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "attractor/cycle.hpp"
#include "base/ranges.hpp"
#include "section/point_record.hpp"
#include "section/settling.hpp"
#include "slapstick/base/error.hpp"
#include "sweep/diagram_point.hpp"

namespace slapstick::sweep {
namespace {

constexpr double inside = 1e-9;  ///< a multiplier nearer to the unit circle may be that of a continuum
constexpr double one = 1e-6;     ///< the distance at which two cycles are one

/// The size of a cycle for Newton's method, as of section::distance.
Eigen::VectorXd size_of(const section::ReturnMap& map, Motion motion, int n) {
  const double omega = 2.0 * std::numbers::pi / motion.system().period();
  const Eigen::VectorXd first = flow::contact_state(motion);
  section::PointRecord record(first.size());
  record.add(first, {}, omega);
  for (int k = 1; k < n && map.run(motion, 1, nullptr); ++k) record.add(flow::contact_state(motion), {}, omega);
  return record.scale();
}

}  // namespace

KnownCycles::KnownCycles(const System& system, const ClassifyOptions& options)
    : system_(system),
      options_(options),
      map_(system),
      attractors_(system),
      driven_(section::driven(system) && map_.translations().count() == 0) {}

void KnownCycles::add(const Finding& found, const State& state) {
  const std::string label = found.label(driven_);
  if (!driven_ || found.attractor != Attractor::periodic) return;
  try {
    if (attractors_.find(found.attractor, label, state) >= 0) return;
    State start = state;
    undo_rounding(system_.model(), start);
    const Motion motion(system_, start);
    const Eigen::VectorXd scale = size_of(map_, motion, found.n);
    const auto fixed = section::fixed_point(map_, flow::contact_state(motion), found.n, scale, nullptr);
    if (!fixed || fixed->multipliers.empty() || std::abs(fixed->multipliers.front()) > 1.0 - inside) return;
    const double missed = section::distance(map_.translations(), fixed->value.image, fixed->x, scale);
    const section::Cycle cycle{fixed->x, found.n, fixed->value.duration, fixed->multipliers, {}, missed, 0.0};
    Classification cycle_found;
    attractor::describe(system_, cycle, flow::user_state(system_, fixed->x), options_, cycle_found);
    if (cycle_found.label != label || cycle_found.multipliers.empty()) return;
    const Eigen::VectorXd unit = attractors_.tolerance(attractors_.add(cycle_found)) / one;
    all_.push_back({{map_.translations(), *fixed, found.n, unit}, found.n, std::move(cycle_found)});
  } catch (const NumericalError&) {  // each motion says what is wrong
  } catch (const InputError&) {
  }
}

const Classification* KnownCycles::Watch::see(const Eigen::Ref<const Eigen::VectorXd>& x) {
  ++points_;
  for (std::size_t i = 0; i < trials_.size(); ++i)
    if (comes(i, x)) return &cycles_.all_[i].found;
  return nullptr;
}

bool KnownCycles::Watch::beside() const {
  return ranges::any_of(trials_, [](const Trial& trial) { return trial.runs && !trial.doubted; });
}

bool KnownCycles::Watch::comes(std::size_t cycle, const Eigen::Ref<const Eigen::VectorXd>& x) {
  // Wider: more motions are tried that go elsewhere; narrower: longer runs. `attraction` asks as much in the end.
  constexpr double beside_cycle = 0.05;
  constexpr double shrunk = 1e-3;  // of the distance where the trial began: ten halvings
  // A thousandth of `one`, for motions that begin on the cycle. Wider: fewer halvings are seen of those that begin
  // beside it; narrower: rounding keeps a motion that is there from ending its trial, and Newton's method is asked.
  constexpr double newton = 1e-9;
  const Known& known = cycles_.all_[cycle];
  Trial& trial = trials_[cycle];
  const long lasts = points_ - trial.since;
  if (trial.runs && lasts % known.n != 0) return false;
  const bool is_near = known.approach.distance(x) <= beside_cycle;
  trial.runs = trial.runs && is_near;
  if (!is_near || (trial.runs && lasts < known.approach.stage())) return false;
  const section::Approach::Look here = known.approach.at(x);
  if (trial.runs && here.distance <= trial.there) return true;
  const bool fails = trial.runs && !known.approach.loses(trial.before, here, trial.there);
  if (!trial.runs) trial.there = std::max(shrunk * here.distance, newton);
  trial.doubted = trial.doubted || fails;
  trial.runs = !fails;  // one that fails begins anew at the next point, which may be of another phase
  trial.since = points_;
  trial.before = here;
  return false;
}

}  // namespace slapstick::sweep
