#pragma once
/// The cycle of an orbit as pieces for a tracer: by its legs, also where the orbit is unstable or no motion.
#include <memory>

#include "orbit/orbit_rate.hpp"
#include "quantity/tracer.hpp"

namespace slapstick::quantity {

/// Refers to the orbit.
class Cycle {
 public:
  Cycle(const orbit::Problem& problem, const orbit::Orbit& orbit);
  /// With the derivatives by one of the problem's parameters, which all refer to. @param set  of the orbit's values
  Cycle(std::shared_ptr<const orbit::ModeSet> set, const orbit::Orbit& orbit, const orbit::OrbitRate& rate,
        std::size_t parameter);

  [[nodiscard]] const Model& model() const { return set_->model(); }
  [[nodiscard]] const mode::Frame& frame() const { return set_->frame(); }
  [[nodiscard]] Number period() const {
    return {set_->period(), rate_ != nullptr ? set_->period_rate(parameter_) : 0.0};
  }
  /// Of harmonics: one over the forcing period, without forcing over the cycle's duration.
  [[nodiscard]] Number frequency() const { return Number{1.0, 0.0} / (orbit_.shape.n > 0 ? period() : duration()); }
  [[nodiscard]] Number duration() const { return (instant(orbit_.legs()) - instant(0)) * period(); }
  /// From an impact to the same one a cycle later. Times count from the first phase 0 after
  /// event 0 (orbit::at_phase_zero), and may be negative.
  /// @throws NumericalError if a leg is too long for the rates of its mode
  void trace(Tracer& tracer) const;

 private:
  [[nodiscard]] std::size_t first_leg() const;
  [[nodiscard]] Moving start(std::size_t leg) const;
  [[nodiscard]] const orbit::Leg& leg(std::size_t i) const { return orbit_.shape.legs[i]; }
  [[nodiscard]] Number instant(std::size_t event) const {
    return {orbit_.t[event], rate_ != nullptr ? rate_->t[event] : 0.0};
  }
  [[nodiscard]] Number lasts(std::size_t leg) const { return (instant(leg + 1) - instant(leg)) * period(); }
  [[nodiscard]] Number begin(std::size_t k, std::size_t first) const;
  [[nodiscard]] std::vector<std::pair<int, double>> met(std::size_t i) const;
  void piece(std::size_t i, Number begin, Tracer& tracer) const;
  void begin_flights(std::size_t first, Tracer& tracer) const;

  const orbit::Orbit& orbit_;
  std::shared_ptr<const orbit::ModeSet> set_;
  const orbit::OrbitRate* rate_ = nullptr;  ///< null: no derivatives
  std::size_t parameter_ = 0;
};

}  // namespace slapstick::quantity
