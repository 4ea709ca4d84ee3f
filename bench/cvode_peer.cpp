/// SUNDIALS CVODE (Adams) as a peer. See peers.hpp.

#include <algorithm>

#include "cvode_handles.hpp"
#include "hybrid_run.hpp"

namespace slapstick::bench {
namespace {

/// What the right-hand side needs.
struct Problem {
  PaperOscillator oscillator;
  Mode mode = Mode::stick;
};

int right_hand_side(realtype t, N_Vector x, N_Vector dxdt, void* user_data) {
  const auto& problem = *static_cast<const Problem*>(user_data);
  State state;
  State slope;
  std::copy_n(N_VGetArrayPointer(x), state.size(), state.begin());
  problem.oscillator.derivative(problem.mode, state, slope, t);
  std::copy_n(slope.begin(), slope.size(), N_VGetArrayPointer(dxdt));
  return 0;
}

/// One internal step at a time (CV_ONE_STEP). CVODE may step past an event: the phase's equations are smooth there.
class CvodeSolver {
 public:
  CvodeSolver(const PaperOscillator& oscillator, double tolerance)
      : problem_{oscillator},
        context_(make_context()),
        vector_(N_VNew_Serial(std::tuple_size_v<State>, context_.get())),
        sample_(N_VNew_Serial(std::tuple_size_v<State>, context_.get())),
        cvode_(CVodeCreate(CV_ADAMS, context_.get())),
        nonlinear_(SUNNonlinSol_FixedPoint(vector_.get(), 0, context_.get())) {
    check(CVodeInit(cvode_.get(), right_hand_side, 0.0, vector_.get()), "CVodeInit");
    check(CVodeSStolerances(cvode_.get(), tolerance, tolerance), "CVodeSStolerances");
    check(CVodeSetUserData(cvode_.get(), &problem_), "CVodeSetUserData");
    check(CVodeSetNonlinearSolver(cvode_.get(), nonlinear_.get()), "CVodeSetNonlinearSolver");
  }

  void start(Mode mode, const State& state, double time) {
    count_evaluations();
    problem_.mode = mode;
    end_ = state;
    begin_time_ = time;
    length_ = 0.0;
    std::copy(state.begin(), state.end(), N_VGetArrayPointer(vector_.get()));
    check(CVodeReInit(cvode_.get(), time, vector_.get()), "CVodeReInit");
    check(CVodeSetInitStep(cvode_.get(), first_length_), "CVodeSetInitStep");
    fresh_ = true;
  }

  void advance() {
    begin_ = end_;
    begin_time_ += length_;
    realtype reached = begin_time_;
    check(CVode(cvode_.get(), begin_time_ + 1.0, vector_.get(), &reached, CV_ONE_STEP), "CVode");
    length_ = reached - begin_time_;
    std::copy_n(N_VGetArrayPointer(vector_.get()), end_.size(), end_.begin());
    if (fresh_) {
      first_length_ = length_;
      fresh_ = false;
    }
  }

  State at(double tau) {
    check(CVodeGetDky(cvode_.get(), begin_time_ + tau, 0, sample_.get()), "CVodeGetDky");
    State state;
    std::copy_n(N_VGetArrayPointer(sample_.get()), state.size(), state.begin());
    return state;
  }

  State slope(const State& state, double tau) {
    State slope;
    ++evaluations_;
    problem_.oscillator.derivative(problem_.mode, state, slope, begin_time_ + tau);
    return slope;
  }

  double begin_time() const { return begin_time_; }
  double length() const { return length_; }
  const State& begin() const { return begin_; }
  const State& end() const { return end_; }
  long evaluations() {
    count_evaluations();
    return evaluations_;
  }

 private:
  /// CVODE's counters are reset by CVodeReInit.
  void count_evaluations() {
    long since_start = 0;
    check(CVodeGetNumRhsEvals(cvode_.get(), &since_start), "CVodeGetNumRhsEvals");
    evaluations_ += since_start;
  }

  Problem problem_;
  Context context_;
  Vector vector_;
  Vector sample_;
  Cvode cvode_;
  Nonlinear nonlinear_;
  State begin_{};
  State end_{};
  double begin_time_ = 0.0;
  double length_ = 0.0;
  double first_length_ = 0.0;  ///< first step of the last phase; 0 lets CVODE choose
  bool fresh_ = true;
  long evaluations_ = 0;
};

}  // namespace

PeerRun run_cvode(double omega, int periods, double tolerance) {
  const PaperOscillator oscillator{omega};
  CvodeSolver solver(oscillator, tolerance);
  return HybridRun(solver, oscillator, 0.01 * tolerance).run(periods);
}

}  // namespace slapstick::bench
