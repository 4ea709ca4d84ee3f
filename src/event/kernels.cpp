/// Chooses the kernels that run.
#include "event/kernels.hpp"

#include <cstdlib>
#include <string>
#include <string_view>

#include "base/floating_point.hpp"
#include "base/text.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::event {

namespace scalar {
extern const Kernels table;
}
namespace sse4 {
extern const Kernels table;
}
namespace avx2 {
extern const Kernels table;
}
namespace avx512 {
extern const Kernels table;
}

namespace {

struct Target {
  const Kernels* kernels;
  bool available;
};

/// Narrow ones first.
std::vector<Target> targets() {
  std::vector<Target> all = {{&scalar::table, true}};
#if defined(SLAPSTICK_KERNEL_SSE4)
  all.push_back({&sse4::table, __builtin_cpu_supports("sse4.2") != 0});
#endif
#if defined(SLAPSTICK_KERNEL_AVX2)
  all.push_back({&avx2::table, __builtin_cpu_supports("avx2") != 0});
#endif
#if defined(SLAPSTICK_KERNEL_AVX512)
  all.push_back({&avx512::table, __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
                                     __builtin_cpu_supports("avx512vl") != 0});
#endif
  return all;
}

const Kernels& choose() {
  require_ieee_arithmetic();
  const char* const forced = std::getenv("SLAPSTICK_TARGET");
  const std::string_view name = forced == nullptr ? "" : forced;
  const Kernels* widest = nullptr;
  std::string there;
  for (const Target& target : targets()) {
    if (!target.available) continue;
    if (name == target.kernels->name) return *target.kernels;
    widest = target.kernels;
    there += (there.empty() ? "" : ", ") + std::string(widest->name);
  }
  if (name.empty()) return *widest;
  throw InputError("SLAPSTICK_TARGET is " + in_quotes(name) + "; this program has, on this processor, " + there);
}

}  // namespace

const Kernels& kernels() {
  static const Kernels& chosen = choose();
  return chosen;
}

Root first_root(const GuardWindow& guard, double x_end, long& evaluations) {
  return kernels().first_root(guard, x_end, evaluations);
}

}  // namespace slapstick::event
