#pragma once
/// Maps from a point of a section to the next, in contact coordinates modulo the model's translations, with their
/// Jacobians, and fixed points by Newton's method. Of a driven motion the section is phase 0 (`Stroboscopic`); of a
/// free one it is the middle of some flights (section/flight_section.hpp).
#include <atomic>
#include <memory>
#include <optional>

#include "flow/contact_state.hpp"
#include "flow/translations.hpp"

namespace slapstick::section {

/// A wish to stop; null: there is no wish. Whatever stops early for it returns something meaningless: the caller looks
/// at the flag itself.
using Stop = const std::atomic<bool>*;

/// Distance of two contact states, positions and velocities each relative to `scale` (same layout).
[[nodiscard]] double distance(const Eigen::Ref<const Eigen::VectorXd>& a, const Eigen::Ref<const Eigen::VectorXd>& b,
                              const Eigen::VectorXd& scale);
/// Of their classes: rates that follow from other numbers are none of a class, and computed states have them unset.
[[nodiscard]] double distance(const flow::Translations& translations, const Eigen::VectorXd& a,
                              const Eigen::VectorXd& b, const Eigen::VectorXd& scale);

struct MapValue {
  Eigen::VectorXd image;     ///< representative of its class
  Eigen::MatrixXd jacobian;  ///< of the classes
  Eigen::VectorXd advance;   ///< along each translation
  double duration = 0.0;     ///< periods from x to the image
};

/// A section, and the map of its points.
class ReturnMap {
 public:
  explicit ReturnMap(const System& system) : translations_(system) {}
  virtual ~ReturnMap() = default;
  ReturnMap(const ReturnMap&) = delete;
  ReturnMap& operator=(const ReturnMap&) = delete;

  [[nodiscard]] const flow::Translations& translations() const { return translations_; }

  /// When a motion meets the section next; nothing if it does not.
  /// @throws NumericalError as Motion::advance
  [[nodiscard]] virtual std::optional<Instant> next(const Motion& motion, Stop stop) const = 0;
  /// Moves a motion on by n points. @returns false if it was stopped, or there are fewer points
  virtual bool run(Motion& motion, long n, Stop stop) const;
  /// P_n(x) of a representative x, where the clock stands at phase 0, and its derivative through all events.
  /// @throws InputError for an x that the stops forbid; NumericalError as Motion::advance, or if x does not return
  [[nodiscard]] virtual MapValue value(const Eigen::VectorXd& x, int n, Stop stop) const = 0;
  /// Of a derivative of P_n at a fixed point, largest modulus first.
  [[nodiscard]] virtual std::vector<std::complex<double>> multipliers(const Eigen::MatrixXd& jacobian) const;
  /// The point of the section to which a fixed point of P_n near it belongs: the motion may stand at it, and at no
  /// other of the n points.
  [[nodiscard]] virtual Eigen::VectorXd on_section(const Eigen::VectorXd& x, int /*n*/, Stop) const { return x; }
  /// Takes out of tangents at a point of the section what leads along the motion to other instants only. One that
  /// keeps nothing but rounding is zero then: stick has forgotten it.
  virtual void take_out_flow(const Motion&, Eigen::MatrixXd&) const {}
  /// The map of another system of the same size; null where a section is chosen by a motion.
  [[nodiscard]] virtual std::unique_ptr<ReturnMap> of(const System&) const { return nullptr; }

 private:
  flow::Translations translations_;
};

/// The section of phase 0.
class Stroboscopic final : public ReturnMap {
 public:
  using ReturnMap::ReturnMap;
  [[nodiscard]] std::optional<Instant> next(const Motion& motion, Stop stop) const override;
  bool run(Motion& motion, long n, Stop stop) const override;
  [[nodiscard]] MapValue value(const Eigen::VectorXd& x, int n, Stop stop) const override;
  [[nodiscard]] std::unique_ptr<ReturnMap> of(const System& system) const override {
    return std::make_unique<Stroboscopic>(system);
  }
};

struct FixedPoint {
  Eigen::VectorXd x;
  MapValue value;                                 ///< of the map there
  std::vector<std::complex<double>> multipliers;  ///< largest modulus first
  [[nodiscard]] bool stable() const { return multipliers.empty() || std::abs(multipliers.front()) < 1.0; }
};

/// Newton's method on P_n(x) = x from `x`; empty if it does not reach 1e-11 of `scale` in 40 steps, hardly nears it for
/// four, leaves the stops' side or is stopped. Beside a doubling the steps shrink by two thirds each until they are as
/// small as the doubled orbit.
std::optional<FixedPoint> fixed_point(const ReturnMap& map, Eigen::VectorXd x, int n, const Eigen::VectorXd& scale,
                                      Stop stop);

}  // namespace slapstick::section
