#pragma once
/// Quantities along a motion: polynomials on short steps, and impulses between them. What integrates, searches or
/// transforms them listens.
///
/// A *piece* is the motion in one mode; it is cut into steps on which exp(A s) X is its Taylor polynomial of degree 23
/// up to rounding, as the windows of a Mode are. A *jump* is an instant at which velocities jump. The tracer sees
/// pieces in order of time, from wherever they come: a Motion (`trace`), or the legs of an orbit. So jumps are those
/// between the end of a piece and the start of the next one, and all impulses are what momentum asks for.
///
/// Of a cycle it can carry the derivative by a parameter, Y = dX/dp at a fixed time s of the piece: Y' = A Y + A_p X.
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "event/polynomial.hpp"
#include "quantity/velocity_jumps.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::quantity {

using event::Polynomial;

/// Every quantity as a polynomial of x = s / length.
struct Step {
  double begin = 0.0, length = 0.0;  ///< time units from the start of the trace
  const std::vector<Polynomial>& values;
  /// Their derivatives at fixed time of the piece; empty without a parameter. The piece begins and the step's ends move
  /// by these: an end that is a mere cut by zero.
  const std::vector<Polynomial>& rates;
  double piece_rate = 0.0, from_rate = 0.0, to_rate = 0.0;
};

class Listener {
 public:
  Listener() = default;
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  virtual ~Listener() = default;
  virtual void step(const Step& step) = 0;
  virtual void jump(const VelocityJump& jump) = 0;
};

/// The derivatives of a piece: of its mode, of X at its start, where that moves too, and of its times.
struct PieceRates {
  const mode::OutlineDerivative& outline;
  const double* X;
  double begin = 0.0, duration = 0.0;
};

class Tracer {
 public:
  /// Refers to its arguments. @param period  what flights are measured in
  /// @param rates  of the model by the parameter; null: no derivatives
  Tracer(const Model& model, const mode::Frame& frame, Number period, const std::vector<Quantity>& of,
         Listener& listener, const Rates* rates = nullptr);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// The motion in one mode, from X at time `begin` on. The jump before it is told first.
  /// @param longest  time over which the Taylor polynomial of degree 23 is exact up to rounding
  void piece(const std::shared_ptr<const mode::Outline>& outline, double longest, const double* X, double begin,
             double duration, const PieceRates* rates = nullptr);
  /// X at the end of the last piece, where the caller has it: otherwise it is computed when a jump asks for it.
  void arrive(const double* X);
  /// At the end of the last piece: these stops, bit by bit, get an impulse ..
  void strike(std::uint32_t stops) { jumps_.strike(stops); }
  /// .. or the pulse of a signal comes ..
  void pulse(int signal, Number area) { jumps_.pulse(signal, area); }
  /// .. or that next piece is the tail of a complete chatter of these stops, flown with them closed. The jump before
  /// comes after the piece, with the impulses of all impacts that the tail stands for ..
  void chatter(std::uint32_t stops) { chatter_ = stops; }
  /// .. and this one was hit. Ignored before the first piece.
  void impact(int stop, double w);
  /// Flights of a stop count from here: an impact before the first piece, or the end of a chatter.
  /// @param slid  how long friction has slipped since then
  void begin_flight(int contact, Number time, Number slid = {}) { jumps_.begin_flight(contact, time, slid); }
  /// X after the last piece, what was struck there, and the mode that follows.
  void finish(const double* X, const mode::Outline& next, const double* X_rate = nullptr);

 private:
  struct Expansion;
  struct Tail;

  Expansion& expansion(const std::shared_ptr<const mode::Outline>& outline, double longest, const PieceRates* rates);
  void step(Expansion& mode, double length, const Step& place);
  void evaluate(Expansion& mode, double length);
  void expand(const Expansion& mode);
  void move(const Expansion& mode, double length);
  void catch_up();
  void move_rates(const Expansion& mode, double length);
  [[nodiscard]] Number to_first_kink(const Expansion& mode, double length);
  [[nodiscard]] std::optional<VelocityJump> jump_before(const mode::Outline& next, const double* X,
                                                        const double* X_rate);
  void begin_tail(const Expansion& mode);
  void add_to_tail(const Step& place);
  void tell_tail(std::optional<VelocityJump> jump, Number begin);

  const Model& model_;
  const mode::Frame& frame_;
  const std::vector<Quantity>& of_;
  Listener& listener_;
  const Rates* rates_;
  VelocityJumps jumps_;
  std::vector<std::unique_ptr<Expansion>> modes_;
  std::uint32_t chatter_ = 0;            ///< the next piece is the tail of a chatter of these stops
  std::unique_ptr<Tail> tail_;           ///< while the trace is in one
  const mode::Outline* last_ = nullptr;  ///< of the last piece
  Moving at_;                            ///< where the trace stands, apart from what it is behind
  const Expansion* behind_ = nullptr;    ///< X has still to go on in this mode ..
  double behind_by_ = 0.0;               ///< .. so long: most pieces end where nobody asks for it
  Moving next_;
  Vector coefficients_, rate_coefficients_;
  Matrix terms_, rate_terms_;  ///< of exp(A h) X and of Y, a column each
  std::vector<bool> above_;
  std::vector<Polynomial> rows_, row_rates_, values_, value_rates_;
};

/// Follows a motion to `end`. What happens at its present instant is not told, what happens at `end` is.
/// @param stop  null: cannot be stopped. @returns false if it was
/// @param progress  if there is one, called now and then with the motion's time in periods
/// @throws NumericalError as Motion::advance
bool trace(Motion& motion, Instant end, Tracer& tracer, const std::atomic<bool>* stop,
           const std::function<void(double periods)>& progress = {});

}  // namespace slapstick::quantity
