/// Takes tangent vectors through the events of one instant.
#include "flow/saltation.hpp"

#include <algorithm>
#include <utility>

#include "base/dense.hpp"
#include "base/ranges.hpp"
#include "flow/engine.hpp"
#include "flow/mode_graph.hpp"

namespace slapstick::flow {
namespace {

using mode::ContactRow;
using mode::ContactStates;
using mode::GuardKind;

/// Stops that are struck together and act on each other.
struct Blow {
  std::vector<int> stops;
  bool to_rest = false;
};

class Passage {
 public:
  explicit Passage(const Engine& engine);
  void carry(Eigen::MatrixXd& tangents);
  void carry_at_once(Eigen::MatrixXd& tangents) const;

 private:
  [[nodiscard]] bool jumps(int hit) const;
  [[nodiscard]] bool acts_on(const mode::Guard& guard, const ContactRow& contact) const;
  [[nodiscard]] bool coupled(const ContactRow& a, const ContactRow& b) const;
  [[nodiscard]] std::vector<Blow> separated(const Motion::Strike& strike) const;
  [[nodiscard]] std::size_t owner(const ContactRow& contact) const;
  [[nodiscard]] std::size_t owner(const Blow& blow) const;
  void drop_hits_of_others();
  void take_states(std::size_t k);
  void apply(const Blow& blow, const Eigen::VectorXd& speeds, bool rates, Eigen::Ref<Eigen::MatrixXd> velocities) const;
  [[nodiscard]] Eigen::VectorXd speeds(const Blow& blow) const;
  [[nodiscard]] Eigen::VectorXd flow(ModeId id, const Eigen::VectorXd& X) const;

  const Engine& engine_;
  const CompiledSystem& system_;
  const mode::Frame& frame_;
  const mode::Mode& before_;
  std::vector<int> hits_;
  std::vector<Blow> blows_;
  ContactStates states_;  ///< while the guards are passed
  Eigen::VectorXd X_;
};

Passage::Passage(const Engine& engine)
    : engine_(engine),
      system_(engine.system()),
      frame_(system_.frame()),
      before_(system_.mode(engine.segment().mode)),
      hits_(engine.hits().begin(), engine.hits().end()),
      states_(before_.states()),
      X_(Eigen::Map<const Eigen::VectorXd>(engine.extended_before().data(), before_.size())) {
  for (const Motion::Strike& strike : engine.strikes()) {
    for (Blow& blow : separated(strike)) blows_.push_back(std::move(blow));
  }
  // The field is continuous at a crossing: nothing happens to a tangent there, but at the edge of a zone.
  std::erase_if(hits_, [&](int hit) { return mode::of_crossing(before_.guards()[hit].kind) && !jumps(hit); });
  drop_hits_of_others();
}

/// Is this crossing the edge of a zone?
bool Passage::jumps(int hit) const {
  const mode::Guard& guard = before_.guards()[hit];
  return mode::of_corner(guard.kind) &&
         system_.model().characteristics[guard.contact].over == Characteristic::Over::zones;
}

/// Does the guard's pair share a mass with the contact's?
bool Passage::acts_on(const mode::Guard& guard, const ContactRow& contact) const {
  if (mode::of_corner(guard.kind)) return frame_.characteristics[guard.contact].push[contact.own] != 0.0;
  if (guard.kind == GuardKind::gap || guard.kind == GuardKind::press) return coupled(frame_.stops[guard.contact], contact);
  const bool friction = mode::of_friction(guard.kind) || mode::of_load(guard.kind);
  return coupled(friction ? frame_.frictions[guard.contact] : frame_.compliant[guard.contact], contact);
}

bool Passage::coupled(const ContactRow& a, const ContactRow& b) const {
  return frame_.mass_inverse(a.own, b.own) != 0.0;
}

/// The parts of a strike that do not act on each other.
std::vector<Blow> Passage::separated(const Motion::Strike& strike) const {
  std::vector<Blow> parts;
  for (int stop = 0; stop < static_cast<int>(frame_.stops.size()); ++stop) {
    if ((strike.stops >> stop & 1U) == 0) continue;
    Blow joined{{stop}, strike.to_rest};
    std::vector<Blow> others;
    for (Blow& part : parts) {
      const bool touched =
          ranges::any_of(part.stops, [&](int s) { return coupled(frame_.stops[s], frame_.stops[stop]); });
      if (touched)
        joined.stops.insert(joined.stops.end(), part.stops.begin(), part.stops.end());
      else
        others.push_back(std::move(part));
    }
    others.push_back(std::move(joined));
    parts.swap(others);
  }
  return parts;
}

/// The first guard whose pair shares a mass with the contact's; the last one if there is none.
std::size_t Passage::owner(const ContactRow& contact) const {
  for (std::size_t k = 0; k < hits_.size(); ++k)
    if (acts_on(before_.guards()[hits_[k]], contact)) return k;
  return hits_.size() - 1;
}

/// The guard that is the gap of one of the stops struck, or else the first that acts on one of them.
std::size_t Passage::owner(const Blow& blow) const {
  for (std::size_t k = 0; k < hits_.size(); ++k) {
    const mode::Guard& guard = before_.guards()[hits_[k]];
    if (guard.kind == GuardKind::gap && ranges::find(blow.stops, guard.contact) != blow.stops.end()) return k;
  }
  std::size_t first = hits_.size() - 1;
  for (int stop : blow.stops) first = std::min(first, owner(frame_.stops[stop]));
  return first;
}

/// A stop that was struck together with an earlier one has no event of its own.
void Passage::drop_hits_of_others() {
  for (std::size_t k = 1; k < hits_.size();) {
    const mode::Guard& guard = before_.guards()[hits_[k]];
    const bool taken = guard.kind == GuardKind::gap && ranges::any_of(blows_, [&](const Blow& blow) {
                         return ranges::find(blow.stops, guard.contact) != blow.stops.end() && owner(blow) < k;
                       });
    if (taken)
      hits_.erase(hits_.begin() + static_cast<std::ptrdiff_t>(k));
    else
      ++k;
  }
}

/// The changes of contact states that belong to the k-th guard.
void Passage::take_states(std::size_t k) {
  const ContactStates& final = system_.mode(engine_.mode_id()).states();
  if (k + 1 == hits_.size()) {
    states_ = final;
    return;
  }
  const auto take = [&](auto& states, const auto& last, const std::vector<ContactRow>& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (owner(rows[i]) == k) states[i] = last[i];
  };
  take(states_.stops, final.stops, frame_.stops);
  take(states_.frictions, final.frictions, frame_.frictions);
  take(states_.compliant, final.compliant, frame_.compliant);
}

/// With which the stops are hit, in the state now.
Eigen::VectorXd Passage::speeds(const Blow& blow) const {
  Eigen::VectorXd all(blow.stops.size());
  for (std::size_t i = 0; i < blow.stops.size(); ++i)
    all[static_cast<Eigen::Index>(i)] = approach_velocity(system_, blow.stops[i], X_.data());
  return all;
}

/// Each of the stops leaves with -r(v) v of the velocity v it came with; a small change of v is multiplied by
/// -d(r v)/dv.
/// @param rates  of small changes
// NOLINTNEXTLINE(performance-unnecessary-value-param): a view, through which is written
void Passage::apply(const Blow& blow, const Eigen::VectorXd& speeds, bool rates,
                    Eigen::Ref<Eigen::MatrixXd> velocities) const {
  std::vector<int> rows;
  Eigen::VectorXd factor = Eigen::VectorXd::Ones(speeds.size());
  for (int stop : blow.stops) {
    const auto i = static_cast<Eigen::Index>(rows.size());
    const Rebound law = rebound(system_.model().stops[stop], speeds[i]);
    if (!blow.to_rest) factor[i] += rates ? law.rate : law.restitution;
    rows.push_back(frame_.stops[stop].own);
  }
  push_along(frame_, rows, factor, velocities);
}

/// A X in a mode, which may exist between two guards only.
Eigen::VectorXd Passage::flow(ModeId id, const Eigen::VectorXd& X) const {
  const mode::Mode* known = system_.known_mode(id);
  if (known != nullptr) return known->system() * X;
  return system_.outline(id)->system * X;
}

void Passage::carry(Eigen::MatrixXd& tangents) {
  if (hits_.empty()) return;
  const int d = frame_.d;
  const Eigen::Map<const Eigen::VectorXd> after(engine_.extended().data(), before_.size());
  for (std::size_t k = 0; k < hits_.size(); ++k) {
    const mode::RowVector& h = before_.guards()[hits_[k]].row;
    const Eigen::VectorXd f_minus = flow(system_.mode_id(states_), X_);
    const double slope = h.dot(f_minus);
    Eigen::RowVectorXd dt = Eigen::RowVectorXd::Zero(tangents.cols());
    if (slope != 0.0) dt = -(h.head(2 * d) * tangents) / slope;
    tangents += f_minus.head(2 * d) * dt;
    for (const Blow& blow : blows_) {
      if (owner(blow) != k) continue;
      const Eigen::VectorXd v = speeds(blow);
      apply(blow, v, true, tangents.bottomRows(d));
      apply(blow, v, false, X_.segment(d, d));
    }
    take_states(k);
    if (k + 1 == hits_.size()) X_ = after;
    tangents -= flow(system_.mode_id(states_), X_).head(2 * d) * dt;
  }
}

/// Impacts without a time of their own, after a chatter limit, and the end of a pile-up: gaps and their rates are lost,
/// the momentum is kept.
void Passage::carry_at_once(Eigen::MatrixXd& tangents) const {
  for (const Blow& blow : blows_) {
    const Eigen::VectorXd v = speeds(blow);
    apply(blow, v, true, tangents.bottomRows(frame_.d));
    if (blow.to_rest) apply(blow, v, true, tangents.topRows(frame_.d));
  }
}

}  // namespace

void push_along(const mode::Frame& frame, const std::vector<int>& rows, const Eigen::VectorXd& factor,
                Eigen::Ref<Eigen::MatrixXd> block) {
  if (rows.empty()) return;
  const Eigen::MatrixXd push = frame.mass_inverse(Eigen::all, rows), D = push(rows, Eigen::all);
  const Eigen::MatrixXd rates = factor.asDiagonal() * Eigen::MatrixXd(block(rows, Eigen::all));
  if (rows.size() == 1)
    block -= push * (rates / D(0, 0));
  else
    block -= push * dense::LeastNorm(D).solve(rates);
}

void pass_event(const Engine& engine, Eigen::MatrixXd& tangents) {
  if (engine.hits().empty() && engine.strikes().empty()) return;
  const bool piled_up = ranges::any_of(engine.strikes(), &Motion::Strike::to_rest);
  if (engine.hits().empty() || piled_up)
    Passage(engine).carry_at_once(tangents);
  else
    Passage(engine).carry(tangents);
}

}  // namespace slapstick::flow
