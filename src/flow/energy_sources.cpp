/// Names the parts of a model that can feed energy, and those whose force falls.
#include "slapstick/flow/energy_sources.hpp"

#include <algorithm>

#include "base/dense.hpp"
#include "base/text.hpp"
#include "mode/assembly.hpp"

namespace slapstick {
namespace {

/// force * velocity < 0 somewhere: at a corner, at velocity 0, or far out.
bool feeds(const Characteristic& over_velocity) {
  const auto& corners = over_velocity.corners;
  const bool far = over_velocity.slope_below < 0.0 || over_velocity.slope_above < 0.0;
  const bool at_corner = std::any_of(corners.begin(), corners.end(), [](const Characteristic::Corner& corner) {
    return corner.force * corner.at < 0.0;
  });
  double at_zero = corners.front().force + over_velocity.slope_below * (0.0 - corners.front().at);
  if (corners.back().at <= 0.0) at_zero = corners.back().force - over_velocity.slope_above * corners.back().at;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Characteristic::Corner &from = corners[i - 1], &to = corners[i];
    if (from.at <= 0.0 && to.at > 0.0) at_zero = from.force - (to.force - from.force) / (to.at - from.at) * from.at;
  }
  return far || at_corner || at_zero != 0.0;
}

bool feeds_in_a_zone(const Characteristic& zones) {
  return zones.slope_below < 0.0 ||
         std::any_of(zones.corners.begin(), zones.corners.end(),
                     [](const Characteristic::Corner& corner) { return corner.force < 0.0; });
}

/// Is the normal force that of other coordinates than those on which the friction acts?
bool couples(const FrictionContact& contact, const Model& model) {
  if (!contact.normal) return false;
  if (!contact.normal->terms.empty()) return true;
  if (contact.normal->compliant_stop < 0) return false;  // pressed by functions of time
  const CompliantStop& stop = model.compliant_stops[static_cast<std::size_t>(contact.normal->compliant_stop)];
  return same_pair(stop, contact) == 0;
}

/// The symmetric matrix of parts k (v_a - v_b), on top of a matrix by rows or none.
template <class Parts>
Eigen::MatrixXd assembled(const SymmetricMatrix& rows, const Parts& parts, double Parts::value_type::*number, int n) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n && !rows.empty(); ++i)
    for (int j = 0; j < n; ++j) sum(i, j) = rows[static_cast<std::size_t>(i * n + j)];
  for (const auto& part : parts) {
    const Eigen::RowVectorXd along = mode::pair_row(n, part);
    sum += part.*number * along.transpose() * along;
  }
  return sum;
}

/// Is the form x^T A x negative somewhere, by more than rounding?
bool indefinite(const Eigen::MatrixXd& A) {
  constexpr double eigenvalue_rounding = 1e-12;  // of the largest eigenvalue
  const Eigen::VectorXd values = dense::eigenvalues(A).real();
  return values.minCoeff() < -eigenvalue_rounding * values.cwiseAbs().maxCoeff();
}

/// Does a force fall somewhere as the displacement grows?
bool falls(const Characteristic& bent) {
  if (bent.over != Characteristic::Over::displacement) return false;
  bool some = bent.slope_below < 0.0 || bent.slope_above < 0.0;
  for (std::size_t i = 1; i < bent.corners.size(); ++i)
    some = some || bent.corners[i].force < bent.corners[i - 1].force;
  return some;
}

}  // namespace

std::vector<std::string> energy_sources(const Model& model) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < model.dampers.size(); ++i)
    if (model.dampers[i].coefficient < 0.0) all.push_back("damper " + std::to_string(i + 1));
  for (const Characteristic& one_of : model.characteristics) {
    const bool source = one_of.over == Characteristic::Over::velocity ? feeds(one_of)
                        : one_of.over == Characteristic::Over::zones  ? feeds_in_a_zone(one_of)
                                                                      : false;
    if (source) all.push_back("characteristic " + in_quotes(one_of.name));
  }
  for (const FrictionContact& contact : model.frictions)
    if (couples(contact, model)) all.push_back("friction " + in_quotes(contact.name));
  if (!model.damping.empty() && indefinite(assembled(model.damping, model.dampers, &Damper::coefficient, model.size())))
    all.emplace_back("matrix damping");
  return all;
}

std::vector<std::string> falling_forces(const Model& model) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < model.springs.size(); ++i)
    if (model.springs[i].stiffness < 0.0) all.push_back("spring " + std::to_string(i + 1));
  for (const Characteristic& one_of : model.characteristics)
    if (falls(one_of)) all.push_back("characteristic " + in_quotes(one_of.name));
  if (!model.stiffness.empty() &&
      indefinite(assembled(model.stiffness, model.springs, &Spring::stiffness, model.size())))
    all.emplace_back("matrix stiffness");
  return all;
}

}  // namespace slapstick
