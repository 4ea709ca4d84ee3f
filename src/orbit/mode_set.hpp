#pragma once
/// A model at one point of its parameters, with derivatives: the linear system and the guards of any mode, and how they
/// change.
///
/// A ModeSet has no window operators and costs microseconds, where a System costs a fraction of a millisecond: Newton's
/// method makes one per step.
#include <memory>
#include <vector>

#include "mode/derivative.hpp"
#include "mode/outline.hpp"
#include "slapstick/model/family.hpp"

namespace slapstick::orbit {

/// A mode and its derivatives with respect to each parameter.
struct ModeRates {
  mode::Outline outline;
  std::vector<mode::OutlineDerivative> rates;
  /// Over which exp(A s) is well summed: no term exceeds about twice the first, and the sizes of all sum to 7 times it.
  double longest_step = 1.0;

  /// Kept by flow(): a round step doubled, with all derivatives (orbit/mode_flow.hpp).
  mutable std::vector<Eigen::MatrixXd> doublings;

  /// Steps that a time takes, none longer; at least one.
  /// @throws NumericalError where they are too many
  [[nodiscard]] double steps(double s) const;

  /// The place of a guard in the outline. @throws NumericalError if the mode has none such
  [[nodiscard]] std::size_t guard(mode::GuardKind kind, int contact) const;
};

/// Not for use by several threads: modes are made when they are first asked for.
class ModeSet {
 public:
  /// @throws InputError as the family
  ModeSet(const Family& family, const std::vector<double>& values);

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const Model& rate(std::size_t j) const { return rates_[j]; }
  [[nodiscard]] std::size_t parameters() const { return rates_.size(); }
  [[nodiscard]] const mode::Frame& frame() const { return frame_; }
  [[nodiscard]] const mode::FrameDerivative& frame_rate(std::size_t j) const { return frame_rates_[j]; }
  [[nodiscard]] const ModeRates& mode(const mode::ContactStates& states) const;
  [[nodiscard]] double period() const { return model_.forcing_period(); }
  [[nodiscard]] double period_rate(std::size_t j) const;

 private:
  Model model_;
  std::vector<Model> rates_;
  mode::Frame frame_;
  std::vector<mode::FrameDerivative> frame_rates_;
  mutable std::vector<std::unique_ptr<ModeRates>> modes_;
};

}  // namespace slapstick::orbit
