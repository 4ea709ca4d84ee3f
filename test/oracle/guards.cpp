#include "oracle/guards.hpp"

namespace slapstick::oracle {
namespace {

// More derivatives than a linear system of the sizes tested here can have zero without being zero identically.
constexpr int start_order = 24;

Polynomial shifted(Polynomial p, const Real& constant, int sign = 1) {
  if (sign < 0)
    for (Real& c : p) c = -c;
  p[0] += constant;
  return p;
}

/// Number of leading zeros of the guard; `zero_value` when its value is zero by construction and not by size.
int leading_zeros(const Guard& guard, bool zero_value) {
  const Real tiny = zero_share * guard.scale;
  const bool kinematic = guard.kind == GuardKind::gap || guard.kind == GuardKind::slip;
  for (std::size_t k = 0; k < guard.p.size(); ++k) {
    const bool zero = kinematic && k == 0 ? zero_value : abs(guard.p[k]) <= tiny;
    if (!zero) return static_cast<int>(k);
  }
  return Start::never;
}

}  // namespace

std::vector<Guard> guards_of(const Mechanics& mechanics, const Mode& mode, const Jet& jet, const Real& gap) {
  std::vector<Guard> guards;
  const bool merged = mechanics.merged_sign() != 0, stick = mechanics.has_friction() && mode.friction == 0;
  if (mechanics.has_stop() && !mode.closed && !(merged && stick)) {
    const Mechanics::Difference d = mechanics.gap_series(jet);
    guards.push_back({GuardKind::gap, shifted(d.coefficients, gap), d.scale});
  }
  if (mechanics.has_friction() && !stick) {
    const Mechanics::Difference d = mechanics.slip_series(jet);
    guards.push_back({GuardKind::slip, shifted(d.coefficients, Real(0), mode.friction), d.scale});
  }
  const Real f_s = mechanics.has_friction() ? Real(mechanics.friction().static_friction) : Real(0);
  if (stick && !(merged && mode.closed)) {
    guards.push_back({GuardKind::upper, shifted(jet.holding, f_s, -1), f_s + jet.force_scale});
    guards.push_back({GuardKind::lower, shifted(jet.holding, f_s), f_s + jet.force_scale});
  }
  if (mode.closed) {
    const Real share = merged ? f_s : Real(0);
    guards.push_back({GuardKind::press, shifted(jet.press, share), share + jet.force_scale});
  }
  return guards;
}

StartTest may_start(const Mechanics& mechanics, const Mode& mode, const Contact& contact, const Vector& x, Vector v,
                    const Real& gap, const Real& t) {
  mechanics.project(mode, v);
  const Jet jet = mechanics.expand(mode, x, v, t, mechanics.longest_step(), start_order);
  StartTest test;
  for (const Guard& guard : guards_of(mechanics, mode, jet, gap)) {
    const bool kinematic = guard.kind == GuardKind::gap || guard.kind == GuardKind::slip;
    const int zeros = leading_zeros(guard, guard.kind == GuardKind::gap ? contact.touching : contact.no_slip);
    test.start[guard.kind] = zeros;
    const bool fits = zeros == Start::never ? !kinematic : guard.p[static_cast<std::size_t>(zeros)] > 0;
    if (fits || !test.admissible) continue;
    test.admissible = false;
    test.violated = guard.kind;
  }
  return test;
}

}  // namespace slapstick::oracle
