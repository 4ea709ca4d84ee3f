#pragma once
/// Owners of CVODE's handles, and its errors as exceptions.
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace slapstick::bench {

inline void check(int flag, const char* call) {
  if (flag < 0) {
    throw std::runtime_error(std::string(call) + " failed with flag " + std::to_string(flag));
  }
}

/// Owners of the C handles, destroyed in reverse order of construction.
struct ContextDeleter {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
};
struct CvodeDeleter {
  void operator()(void* memory) const { CVodeFree(&memory); }
};
struct VectorDeleter {
  void operator()(N_Vector vector) const { N_VDestroy(vector); }
};
struct NonlinearDeleter {
  void operator()(SUNNonlinearSolver solver) const { SUNNonlinSolFree(solver); }
};
using Context = std::unique_ptr<std::remove_pointer_t<SUNContext>, ContextDeleter>;
using Cvode = std::unique_ptr<void, CvodeDeleter>;
using Vector = std::unique_ptr<std::remove_pointer_t<N_Vector>, VectorDeleter>;
using Nonlinear = std::unique_ptr<std::remove_pointer_t<SUNNonlinearSolver>, NonlinearDeleter>;

inline Context make_context() {
  SUNContext context = nullptr;
  check(SUNContext_Create(nullptr, &context), "SUNContext_Create");
  return Context(context);
}

}  // namespace slapstick::bench
