#pragma once
/// The mode logic of docs/explanation/mode_graph.md over any solver: the part of a peer that is not the solver.
///
/// A `Solver` is a `Step` (event_search.hpp) that also offers start(mode, state, time), advance() (one accepted step),
/// begin_time(), evaluations(). One solver start per phase; the solver itself carries its step length over an event.

#include "event_search.hpp"
#include "peers.hpp"

#include <numbers>
#include <stdexcept>
#include <utility>

namespace slapstick::bench {

template <class Solver>
class HybridRun {
 public:
  /// Events are located to `event_width` (time).
  HybridRun(Solver& solver, const PaperOscillator& oscillator, double event_width)
      : solver_(solver), oscillator_(oscillator), event_width_(event_width) {}

  PeerRun run(int periods) {
    const double end_time = periods * 2.0 * std::numbers::pi / oscillator_.omega;
    const long most_phases = 10000L * (periods + 1L);
    choose_after_rest();
    while (time_ <= end_time) {
      if (++result_.phases > most_phases) {
        throw std::runtime_error("a benchmark peer loops at an event");
      }
      run_phase(end_time);
    }
    result_.evaluations = solver_.evaluations();
    return std::move(result_);
  }

 private:
  void run_phase(double end_time) {
    solver_.start(mode_, state_, time_);
    while (true) {
      solver_.advance();
      ++result_.steps;
      if (is_slip(mode_) ? end_slip(end_time) : end_stick()) {
        return;
      }
      time_ = solver_.begin_time() + solver_.length();
      if (time_ > end_time) {
        return;
      }
    }
  }

  /// Takes the event that ends this slip phase in the current step, if there is one.
  bool end_slip(double end_time) {
    const SpeedGuard speed{slip_sign(mode_)};
    const std::optional<Instant> reversal = find_crossing(solver_, speed, event_width_);
    if (mode_ == Mode::slip_plus) {
      const Instant last = reversal.value_or(Instant{solver_.length(), solver_.end()});
      if (const std::optional<Instant> contact = find_contact(solver_, last, event_width_)) {
        move_to(*contact);
        hit(end_time);
        return true;
      }
    }
    if (reversal) {
      move_to(*reversal);
      choose_after_rest();
    }
    return reversal.has_value();
  }

  /// Takes the release that ends this stick phase in the current step, if there is one.
  bool end_stick() {
    const HoldGuard hold{oscillator_, mode_ == Mode::closed, solver_.begin_time()};
    const Instant begin{0.0, solver_.begin()};
    const Instant end{solver_.length(), solver_.end()};
    if (hold.value(end.state, end.tau) > 0.0) {
      return false;
    }
    move_to(hold.value(begin.state, 0.0) > 0.0 ? locate(solver_, hold, begin, end, event_width_) : begin);
    mode_ = oscillator_.holding_force(state_, time_) > 0.0 ? Mode::slip_plus : Mode::slip_minus;
    return true;
  }

  void move_to(const Instant& instant) {
    time_ = solver_.begin_time() + instant.tau;
    state_ = instant.state;
  }

  /// Impact, or the end of chatter when it leaves slower than `peer_rest_speed`.
  void hit(double end_time) {
    if (time_ <= end_time) {
      result_.impact_times.push_back(time_);
    }
    const double leaving_speed = PaperOscillator::restitution * state_[relative_velocity];
    if (leaving_speed > peer_rest_speed) {
      state_ = PaperOscillator::after_impact(state_, PaperOscillator::restitution);
      mode_ = Mode::slip_minus;
    } else {
      state_ = PaperOscillator::after_impact(state_, 0.0);
      choose_after_rest();
    }
  }

  /// The mode after w = 0. On the stop (a rounding error beyond it included) only f0 < -f_s releases.
  void choose_after_rest() {
    state_[relative_velocity] = 0.0;
    const double force = oscillator_.holding_force(state_, time_);
    const bool on_stop = state_[relative_displacement] >= PaperOscillator::clearance;
    if (on_stop) {
      state_[relative_displacement] = PaperOscillator::clearance;
      mode_ = force >= -PaperOscillator::static_friction ? Mode::closed : Mode::slip_minus;
    } else if (std::abs(force) <= PaperOscillator::static_friction) {
      mode_ = Mode::stick;
    } else {
      mode_ = force > 0.0 ? Mode::slip_plus : Mode::slip_minus;
    }
  }

  Solver& solver_;
  PaperOscillator oscillator_;
  double event_width_;
  PeerRun result_;
  double time_ = 0.0;
  State state_{-0.5, 0.0, 0.0, 0.0};
  Mode mode_ = Mode::stick;
};

}  // namespace slapstick::bench
