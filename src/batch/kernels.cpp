/// Chooses the batch kernel that runs.
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"
#include "batch/block.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::batch {

namespace scalar {
extern const Kernel table;
}
namespace sse4 {
extern const Kernel table;
}
namespace avx2 {
extern const Kernel table;
}
namespace avx512 {
extern const Kernel table;
}

namespace {

/// Those that this processor can run, narrow ones first.
std::vector<const Kernel*> available() {
  std::vector<const Kernel*> all = {&scalar::table};
#if defined(SLAPSTICK_KERNEL_SSE4)
  if (__builtin_cpu_supports("sse4.2") != 0) all.push_back(&sse4::table);
#endif
#if defined(SLAPSTICK_KERNEL_AVX2)
  if (__builtin_cpu_supports("avx2") != 0) all.push_back(&avx2::table);
#endif
#if defined(SLAPSTICK_KERNEL_AVX512)
  if (__builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
      __builtin_cpu_supports("avx512vl") != 0)
    all.push_back(&avx512::table);
#endif
  return all;
}

}  // namespace

const Kernel& kernel(int width) {
  if (width != 0 && width != 1 && width != 4 && width != 8)
    throw InputError("a batch has 1, 4 or 8 lanes, or 0 for the most that the processor has; not " +
                     std::to_string(width));
  const char* const forced = std::getenv("SLAPSTICK_TARGET");
  const std::string_view name = forced == nullptr ? "" : forced;
  const Kernel* best = nullptr;
  for (const Kernel* one : available()) {
    if (!name.empty() && name != one->name) continue;
    if (best == nullptr || width == 0 || one->width <= width) best = one;
  }
  std::string there;
  for (const Kernel* one : available()) there += (there.empty() ? "" : ", ") + std::string(one->name);
  if (best == nullptr)
    throw InputError("SLAPSTICK_TARGET is " + in_quotes(name) + "; this program has, on this processor, " + there);
  return *best;
}

}  // namespace slapstick::batch
