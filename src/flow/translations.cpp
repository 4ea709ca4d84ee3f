/// Finds the rigid translations of a model, and takes them out of states and Jacobians.
#include "flow/translations.hpp"

#include "base/dense.hpp"
#include "base/ranges.hpp"
#include "flow/compiled_system.hpp"
#include "flow/contact_state.hpp"
#include "mode/assembly.hpp"

namespace slapstick::flow {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double dependent = 1e-12;

/// Rows over the coordinates that a translation must not change: displacements of springs and stops, forces of the
/// stiffness matrix.
MatrixXd seen_displacements(const Model& model) {
  const int n = model.size();
  std::vector<Eigen::RowVectorXd> rows(1, Eigen::RowVectorXd::Zero(n));
  const auto add = [&](const auto& link) {
    const Eigen::RowVectorXd row = mode::pair_row(n, link);
    rows.emplace_back(row / row.cwiseAbs().maxCoeff());
  };
  for (const Spring& spring : model.springs) {
    if (spring.stiffness != 0.0) add(spring);
  }
  for (const slapstick::Stop& stop : model.stops) add(stop);
  for (const CompliantStop& stop : model.compliant_stops) add(stop);
  for (const Characteristic& one_of : model.characteristics)
    if (one_of.over != Characteristic::Over::velocity) add(one_of);
  for (const FrictionContact& contact : model.frictions) {
    if (!contact.normal) continue;
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(n);
    for (const NormalForce::Term& term : contact.normal->terms) row[term.coordinate] += term.stiffness;
    if (const double largest = row.cwiseAbs().maxCoeff(); largest > 0.0) rows.emplace_back(row / largest);
  }
  for (std::size_t i = 0; i < model.stiffness.size(); i += static_cast<std::size_t>(n)) {
    const Eigen::Map<const Eigen::RowVectorXd> row(&model.stiffness[i], n);
    if (const double largest = row.cwiseAbs().maxCoeff(); largest > 0.0) rows.emplace_back(row / largest);
  }
  MatrixXd all(static_cast<Index>(rows.size()), n);
  for (Index i = 0; i < all.rows(); ++i) all.row(i) = rows[static_cast<std::size_t>(i)];
  return all;
}

}  // namespace

int translation_count(const Model& model, const mode::Frame& frame) {
  return static_cast<int>(dense::kernel(seen_displacements(model) * frame.W_inverse, dependent).free.size());
}

Translations::Translations(const System& system) : system_(system) {
  const mode::Frame& frame = system.compiled().frame();
  const dense::Kernel unseen = dense::kernel(seen_displacements(system.model()) * frame.W_inverse, dependent);
  free_ = unseen.free;
  directions_ = (unseen.basis.array().abs() > dependent).select(unseen.basis, 0.0);
  for (Index i = 0; i < 2 * frame.n; ++i) {
    const bool follows = i >= frame.n && frame.rate_follows(static_cast<int>(i) - frame.n);
    if (!follows && ranges::find(free_, i) == free_.end()) kept_.push_back(i);
  }
}

Index Translations::velocities() const {
  return ranges::count_if(kept_, [&](Index i) { return i >= directions_.rows(); });
}

VectorXd Translations::take_out(VectorXd& x) const {
  if (count() == 0) return {};
  VectorXd amounts = x(free_);
  x.head(directions_.rows()) -= directions_ * amounts;
  return amounts;
}

VectorXd Translations::take_out(Motion& motion) const {
  if (count() == 0) return {};
  VectorXd x = contact_state(motion);
  const VectorXd amounts = take_out(x);
  motion = Motion(system_, user_state(system_, x), motion.time());
  return amounts;
}

VectorXd Translations::take_out(TangentMotion& motion) const {
  if (count() == 0) return {};
  VectorXd x = contact_state(motion.motion());
  const VectorXd amounts = take_out(x);
  MatrixXd tangents = motion.tangents();
  for (Index i = 0; i < tangents.cols(); ++i) {
    VectorXd tangent = tangents.col(i);
    take_out(tangent);
    tangents.col(i) = tangent;
  }
  motion = TangentMotion(system_, user_state(system_, x), tangents, motion.motion().time());
  return amounts;
}

State Translations::moved(State state, const VectorXd& amounts) const {
  const std::vector<double> move = by_coordinate(amounts);
  for (std::size_t i = 0; i < move.size(); ++i) state[2 * i] += move[i];
  return state;
}

std::vector<double> Translations::by_coordinate(const VectorXd& amounts) const {
  if (count() == 0) return {};
  const VectorXd move = system_.compiled().frame().W_inverse * (directions_ * amounts);
  return {move.begin(), move.end()};
}

MatrixXd Translations::quotient(const MatrixXd& jacobian) const {
  MatrixXd images = jacobian(Eigen::all, kept_);
  if (count() > 0) images.topRows(directions_.rows()) -= directions_ * images(free_, Eigen::all);
  return images(kept_, Eigen::all);
}

VectorXd Translations::representative(const VectorXd& numbers) const {
  VectorXd x = VectorXd::Zero(2 * directions_.rows());
  x(kept_) = numbers;
  const mode::Frame& frame = system_.compiled().frame();
  for (const mode::InnerRow& row : frame.inner) x[frame.n + row.own] = row.rate.head(frame.n).dot(x.head(frame.n));
  return x;
}

}  // namespace slapstick::flow
