/// The batch kernel of one instruction set. Compiled for each (CMakeLists.txt).
#include "batch/step.hpp"

#define SLAPSTICK_TEXT_OF(name) #name
#define SLAPSTICK_TEXT(name) SLAPSTICK_TEXT_OF(name)

namespace slapstick::batch {
namespace {

#if defined(__AVX512F__)
constexpr int own_width = 8;
#elif defined(__SSE4_2__)
constexpr int own_width = 4;
#else
constexpr int own_width = 1;
#endif

template <int n, bool tangents>
__attribute__((noinline)) void steps(Block& block) {
  for (;;) {
    Step<own_width, n, tangents> step(block);
    if (block.starting != 0 && step.begin()) return;
    if (step.run()) return;
  }
}

template <int n>
void run_of(Block& block) {
  return block.tangents ? steps<n, true>(block) : steps<n, false>(block);
}

void run(Block& block) {
  switch (block.layout.n) {
    case 1:
      return run_of<1>(block);
    case 2:
      return run_of<2>(block);
    case 3:
      return run_of<3>(block);
    default:
      return run_of<4>(block);
  }
}

}  // namespace

namespace SLAPSTICK_KERNEL {
extern const Kernel table;
constinit const Kernel table = {SLAPSTICK_TEXT(SLAPSTICK_KERNEL), own_width, run};
}  // namespace SLAPSTICK_KERNEL

}  // namespace slapstick::batch
