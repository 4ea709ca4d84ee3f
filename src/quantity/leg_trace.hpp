#pragma once
/// The cycle of an orbit as pieces for a tracer: by its legs, also where the orbit is unstable or no motion.
#include "orbit/equations.hpp"
#include "quantity/tracer.hpp"

namespace slapstick::quantity {

class Cycle {
 public:
  /// Refers to the orbit.
  Cycle(const orbit::Problem& problem, const orbit::Orbit& orbit);

  [[nodiscard]] const Model& model() const { return set_.model(); }
  [[nodiscard]] const mode::Frame& frame() const { return set_.frame(); }
  [[nodiscard]] double period() const { return set_.period(); }
  [[nodiscard]] double duration() const { return (orbit_.t.back() - orbit_.t.front()) * period(); }
  /// From an impact to the same one a cycle later. Times count from the first phase 0 after
  /// event 0 (orbit::at_phase_zero), and may be negative.
  /// @throws NumericalError if a leg is too long for the rates of its mode
  void trace(Tracer& tracer) const;

 private:
  [[nodiscard]] std::size_t first_leg() const;
  [[nodiscard]] Vector start(std::size_t leg, double t) const;
  [[nodiscard]] const orbit::Leg& leg(std::size_t i) const { return orbit_.shape.legs[i]; }
  [[nodiscard]] double begin(std::size_t k, std::size_t first) const;
  [[nodiscard]] std::vector<std::pair<int, double>> met(std::size_t i) const;
  void begin_flights(std::size_t first, Tracer& tracer) const;

  const orbit::Orbit& orbit_;
  orbit::ModeSet set_;
};

}  // namespace slapstick::quantity
