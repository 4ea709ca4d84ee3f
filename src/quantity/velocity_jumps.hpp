#pragma once
/// What happens at the instants at which velocities jump: impulses of all quantities, and the impacts of stops.
///
/// Impulses follow from the jump between two states, less what pulses of signals give, never from the impact law: so
/// they are what momentum asks for. Numbers have their derivatives by the parameter of the trace beside them (zero
/// without one).
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "quantity/formula.hpp"

namespace slapstick::quantity {

/// A time since an impact and the part of it in slip, forcing periods; NaN where there was none.
struct Since {
  Number flight, sliding;
};

/// A stop that was struck, or a compliant one that was met from its free side.
struct Struck {
  int contact = 0;       ///< System::contact_name
  Number w;              ///< just before
  Number impulse, loss;  ///< NaN of a compliant stop: both take time
  Since any, own;        ///< since an impact of any stop, and of this one
};

struct VelocityJump {
  Number time;
  std::vector<Number> impulses;  ///< of every quantity
  std::vector<Struck> impacts;   ///< none: the tail of a chatter, or a compliant stop that lets go
};

/// What a quantity at impacts is at one; NaN if it is not about this stop.
[[nodiscard]] Number value_at(const Quantity& quantity, const Struck& impact);

/// An extended state, and how it moves with the parameter.
struct Moving {
  Vector X, by;
};

class VelocityJumps {
 public:
  /// Refers to its arguments. @param period  what flights are measured in @param rates  null: no derivatives
  VelocityJumps(const Model& model, const mode::Frame& frame, Number period, const std::vector<Quantity>& of,
                const Rates* rates);

  /// These stops, bit by bit, get an impulse at the next jump ..
  void strike(std::uint32_t stops) { struck_ |= stops; }
  /// .. or the pulse of a signal comes ..
  void pulse(int signal, Number area) { pulses_.push_back({signal, area}); }
  /// The tail of a complete chatter of these stops begins at the next jump: velocities jump as at impacts, if some are
  /// there, and then as at plastic ones.
  void chatter(std::uint32_t stops) {
    strike(stops);
    chatter_ = stops;
  }
  /// .. and this one was hit; `before` is where the trace stands.
  void impact(int stop, double w, const Moving& before);
  /// Flights of a stop count from here. @param slid  how long friction has slipped since then
  void begin_flight(int contact, Number time, Number slid);
  /// The trace has come to an instant; friction slipped on the way so long.
  void go_on(Number time, Number slid);
  void forget() { struck_ = 0, chatter_ = 0, pulses_.clear(); }
  /// Can there be a jump between these modes? If not, no state is needed.
  [[nodiscard]] bool may_come(const mode::Outline& last, const mode::Outline& next) const {
    return struck_ != 0 || !pulses_.empty() || !impacts_.empty() || last.states.compliant != next.states.compliant;
  }

  /// What lies between the end of one piece and the start of the next; nothing if nothing happens.
  [[nodiscard]] std::optional<VelocityJump> between(const mode::Outline& last, const Moving& before,
                                                    const mode::Outline& next, const Moving& after);

 private:
  /// An impact, and how long friction had slipped until then.
  struct Mark {
    Number time, slid;
  };
  struct Impulses {
    std::vector<int> stops;
    std::vector<Number> P, loss;
  };

  [[nodiscard]] Matrix coupling(const std::vector<int>& stops, const Matrix& mass_inverse) const;
  [[nodiscard]] const Matrix& inverse_coupling(const std::vector<int>& stops);
  struct Pulse {
    int signal;
    Number area;
  };

  [[nodiscard]] Impulses impulses(const Moving& before, const Moving& after);
  [[nodiscard]] Moving kicked(Moving from, bool kinematic) const;
  [[nodiscard]] Number work(const Formulas& formulas, const Moving& before, const Moving& after, bool kinematic) const;
  [[nodiscard]] Number share(const Quantity& quantity, int index, const Impulses& of,
                             const std::optional<Formulas>& formulas, const Moving& before, const Moving& after) const;
  [[nodiscard]] std::pair<Number, Number> plastic(const Struck& impact) const;
  void let_go(const mode::Outline& last, const mode::Outline& next, const Moving& before, VelocityJump& jump) const;
  void engage(const mode::Outline& last, const mode::Outline& next, const Moving& before, VelocityJump& jump);
  [[nodiscard]] Since since(int contact) const;
  [[nodiscard]] Struck meet(int contact, Number w);

  const Model& model_;
  const mode::Frame& frame_;
  Number period_;
  const std::vector<Quantity>& of_;
  const Rates* rates_;
  std::uint32_t struck_ = 0;
  std::vector<Pulse> pulses_;
  std::uint32_t chatter_ = 0;  ///< the stops whose chatter begins at the next jump
  std::vector<Struck> impacts_;
  std::deque<std::pair<std::uint32_t, Matrix>> inverses_;  ///< by the stops that were struck
  Number now_, slid_;
  std::vector<std::optional<Mark>> marks_;  ///< the last one of each contact, and of any behind them
};

}  // namespace slapstick::quantity
