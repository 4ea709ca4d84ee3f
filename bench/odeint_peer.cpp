/// Boost.odeint's runge_kutta_fehlberg78 as a peer. See peers.hpp.

#include "hybrid_run.hpp"

#include <boost/numeric/odeint.hpp>

namespace slapstick::bench {
namespace {

namespace odeint = boost::numeric::odeint;

/// One controlled step at a time; the derivative at a step's begin is computed once and shared by the step, its
/// repetitions after a rejection, and all re-taken steps of the event search.
class OdeintSolver {
 public:
  OdeintSolver(const PaperOscillator& oscillator, double tolerance)
      : oscillator_(oscillator), controlled_(odeint::make_controlled(tolerance, tolerance, prototype_)) {}

  /// `next_length_` survives: the step length is carried over the event.
  void start(Mode mode, const State& state, double time) {
    mode_ = mode;
    end_ = state;
    begin_time_ = time;
    length_ = 0.0;
  }

  void advance() {
    begin_ = end_;
    begin_time_ += length_;
    const System system{this};
    system(begin_, slope_, begin_time_);
    odeint::controlled_step_result result = odeint::fail;
    while (result == odeint::fail) {
      double time = begin_time_;
      length_ = next_length_;
      result = controlled_.try_step(system, begin_, slope_, time, end_, next_length_);
    }
  }

  State at(double tau) {
    State state;
    retaken_.do_step(System{this}, begin_, slope_, begin_time_, state, tau);
    return state;
  }

  State slope(const State& state, double tau) {
    State slope;
    System{this}(state, slope, begin_time_ + tau);
    return slope;
  }

  double begin_time() const { return begin_time_; }
  double length() const { return length_; }
  const State& begin() const { return begin_; }
  const State& end() const { return end_; }
  long evaluations() const { return evaluations_; }

 private:
  using Stepper = odeint::runge_kutta_fehlberg78<State>;
  using Controlled = odeint::result_of::make_controlled<Stepper>::type;

  struct System {
    OdeintSolver* solver;
    void operator()(const State& x, State& dxdt, double t) const {
      ++solver->evaluations_;
      solver->oscillator_.derivative(solver->mode_, x, dxdt, t);
    }
  };

  /// Static, so zeroed before it is copied: a Stepper's own constructor leaves its work arrays unset.
  static inline const Stepper prototype_{};

  PaperOscillator oscillator_;
  Controlled controlled_;
  Stepper retaken_;
  Mode mode_ = Mode::stick;
  State begin_{};
  State end_{};
  State slope_{};
  double begin_time_ = 0.0;
  double length_ = 0.0;
  double next_length_ = 0.1;
  long evaluations_ = 0;
};

}  // namespace

PeerRun run_odeint(double omega, int periods, double tolerance) {
  const PaperOscillator oscillator{omega};
  OdeintSolver solver(oscillator, tolerance);
  return HybridRun(solver, oscillator, 0.01 * tolerance).run(periods);
}

}  // namespace slapstick::bench
