/// Searches contacts with CVODE.
#include <algorithm>
#include <cmath>

#include "contact_query.hpp"
#include "cvode_handles.hpp"

namespace campaign {
namespace {

using namespace slapstick::bench;

struct Asked {
  const ContactProblem* problem;
  double theta0;
};

ContactProblem::State state_of(const ContactProblem& problem, N_Vector y) {
  ContactProblem::State state{};
  std::copy_n(N_VGetArrayPointer(y), 2 * problem.d, state.begin());
  return state;
}

int right_hand_side(realtype t, N_Vector y, N_Vector dydt, void* user_data) {
  const auto& asked = *static_cast<const Asked*>(user_data);
  const ContactProblem& problem = *asked.problem;
  const double theta = asked.theta0 + problem.omega * t;
  ContactProblem::State out{};
  problem.derivative(state_of(problem, y), out, std::cos(theta), std::sin(theta));
  std::copy_n(out.begin(), 2 * problem.d, N_VGetArrayPointer(dydt));
  return 0;
}

int gap(realtype, N_Vector y, realtype* value, void* user_data) {
  const ContactProblem& problem = *static_cast<const Asked*>(user_data)->problem;
  *value = problem.gap(state_of(problem, y));
  return 0;
}

}  // namespace

std::vector<double> cvode_contacts(const ContactProblem& problem, const std::vector<ContactQuery>& queries,
                                   double tolerance, double longest_step) {
  Asked asked{&problem, 0.0};
  const Context context = make_context();
  const Vector y(N_VNew_Serial(2 * problem.d, context.get()));
  std::fill_n(N_VGetArrayPointer(y.get()), 2 * problem.d, 0.0);
  const Cvode cvode(CVodeCreate(CV_ADAMS, context.get()));
  const Nonlinear nonlinear(SUNNonlinSol_FixedPoint(y.get(), 0, context.get()));
  check(CVodeInit(cvode.get(), right_hand_side, 0.0, y.get()), "CVodeInit");
  check(CVodeSStolerances(cvode.get(), tolerance, tolerance), "CVodeSStolerances");
  check(CVodeSetUserData(cvode.get(), &asked), "CVodeSetUserData");
  check(CVodeSetNonlinearSolver(cvode.get(), nonlinear.get()), "CVodeSetNonlinearSolver");
  check(CVodeSetMaxNumSteps(cvode.get(), 1'000'000), "CVodeSetMaxNumSteps");
  check(CVodeSetErrFile(cvode.get(), nullptr), "CVodeSetErrFile");
  check(CVodeRootInit(cvode.get(), 1, gap), "CVodeRootInit");
  int falling = -1;
  check(CVodeSetRootDirection(cvode.get(), &falling), "CVodeSetRootDirection");
  if (longest_step > 0.0) check(CVodeSetMaxStep(cvode.get(), longest_step), "CVodeSetMaxStep");
  std::vector<double> times;
  for (const ContactQuery& query : queries) {
    asked.theta0 = query.theta0;
    std::copy_n(query.start.begin(), 2 * problem.d, N_VGetArrayPointer(y.get()));
    check(CVodeReInit(cvode.get(), 0.0, y.get()), "CVodeReInit");
    check(CVodeSetStopTime(cvode.get(), problem.duration), "CVodeSetStopTime");
    realtype reached = 0.0;
    const int flag = CVode(cvode.get(), problem.duration, y.get(), &reached, CV_NORMAL);
    times.push_back(flag == CV_ROOT_RETURN ? reached : flag < 0 ? solver_failed : no_contact);
  }
  return times;
}

}  // namespace campaign
