#pragma once
/// Quantities along a motion: polynomials on short steps, and impulses between them. What integrates, searches or
/// transforms them listens.
///
/// A *piece* is the motion in one mode; it is cut into steps on which exp(A s) X is its Taylor polynomial of degree 23
/// but for rounding, as the windows of a Mode are. A *blow* is an instant at which velocities jump. The tracer sees
/// pieces in order of time, from wherever they come: a Motion (`trace`), or the legs of an orbit. So jumps are those
/// between the end of a piece and the start of the next one, and all impulses are what momentum asks for.
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "event/polynomial.hpp"
#include "quantity/formula.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::quantity {

using event::Polynomial;

/// Every quantity as a polynomial of x = s / length.
struct Step {
  double begin = 0.0, length = 0.0;  ///< time units from the start of the trace
  const std::vector<Polynomial>& values;
};

/// A time since an impact and the part of it in slip, forcing periods; NaN where there was none.
struct Since {
  double flight = 0.0, sliding = 0.0;
};

/// A stop that was struck, or a compliant one that was met from its free side.
struct Struck {
  int contact = 0;                    ///< System::contact_name
  double w = 0.0;                     ///< just before
  double impulse = 0.0, loss = 0.0;   ///< NaN of a compliant stop: both take time
  Since any, own;                     ///< since an impact of any stop, and of this one
};

struct Blow {
  double time = 0.0;
  std::vector<double> impulses;  ///< of every quantity
  std::vector<Struck> impacts;   ///< none: the tail of a chatter, or a compliant stop that lets go
};

/// What a quantity at impacts is at one; NaN if it is not about this stop.
[[nodiscard]] double value_at(const Quantity& quantity, const Struck& impact);

class Listener {
 public:
  Listener() = default;
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  virtual ~Listener() = default;
  virtual void step(const Step& step) = 0;
  virtual void blow(const Blow& blow) = 0;
};

class Tracer {
 public:
  /// Refers to its arguments. @param period  what flights are measured in
  Tracer(const Model& model, const mode::Frame& frame, double period, const std::vector<Quantity>& of, Listener& listener);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// The motion in one mode, from X at time `begin` on. The blow before it is told first.
  /// @param longest  time over which the Taylor polynomial of degree 23 is exact but for rounding
  void piece(const std::shared_ptr<const mode::Outline>& mode, double longest, const double* X, double begin, double duration);
  /// At the end of the last piece, or (of a chatter) at the start of the next one: these stops, bit by bit, get an
  /// impulse ..
  void strike(std::uint32_t stops) { struck_ |= stops; }
  /// .. and this one was hit. Ignored before the first piece.
  void impact(int stop, double w);
  /// Flights of a stop count from here: an impact before the first piece, or the end of a chatter.
  /// @param slid  how long friction has slipped since then
  void begin_flight(int contact, double time, double slid = 0.0);
  /// X after the last piece, what was struck there, and the mode that follows.
  void finish(const double* X, const mode::Outline& next);

 private:
  struct Expansion;

  Expansion& expansion(const std::shared_ptr<const mode::Outline>& outline, double longest);
  void step(Expansion& mode, double length);
  void move(const Expansion& mode, double length);
  [[nodiscard]] double to_first_kink(const Expansion& mode, double length) const;
  void tell_blow(const double* X);
  void share(const std::vector<int>& stops, const Vector& P, const Vector& loss, const Vector& change, Blow& blow) const;
  void blow_of_stops(const double* X, Blow& blow);
  void let_go(const mode::Outline& next, Blow& blow) const;
  void engage(const mode::Outline& next, Blow& blow);
  [[nodiscard]] Since since(int contact) const;
  [[nodiscard]] Struck meet(int contact, double w);

  const Model& model_;
  const mode::Frame& frame_;
  double period_;
  const std::vector<Quantity>& of_;
  Listener& listener_;
  std::vector<std::unique_ptr<Expansion>> modes_;
  const mode::Outline* last_ = nullptr;  ///< of the last piece
  const mode::Outline* next_ = nullptr;  ///< of the piece that begins
  std::uint32_t struck_ = 0;
  std::vector<Struck> impacts_;
  Vector X_;  ///< where the trace stands
  Vector next_X_, coefficients_;
  std::vector<bool> above_;
  std::vector<Polynomial> rows_, values_;
  /// An impact, and how long friction had slipped until then.
  struct Mark {
    double time = 0.0, slid = 0.0;
  };
  double end_ = 0.0, slid_ = 0.0;
  std::vector<std::optional<Mark>> marks_;  ///< the last one of each contact, and of any behind them
};

/// Follows a motion to `end`. What happens at its present instant is not told, what happens at `end` is.
/// @param stop  null: cannot be stopped. @returns false if it was
/// @throws NumericalError as Motion::advance
bool trace(Motion& motion, Instant end, Tracer& tracer, const std::atomic<bool>* stop);

}  // namespace slapstick::quantity
