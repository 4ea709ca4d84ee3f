/// Finds steps that prove a guard positive along a segment, in double-doubles and in 256-bit arithmetic.
#include "certify/segment_proof.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "base/double_double.hpp"
#include "certify/expansion.hpp"

namespace slapstick::certify {
namespace {

using Real256 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<256, boost::multiprecision::digit_base_2>,
                                  boost::multiprecision::et_off>;

/// More than the sums of a hundred rounded terms lose.
constexpr double narrow_rounding = 0x1p-90, wide_rounding = 0x1p-240;
/// A window is about two radians long: its 48th term is below 2^-120 of the first, its 110th below 2^-400.
constexpr int narrow_terms = 48, wide_terms = 110;
constexpr std::size_t most_steps = 100'000;

/// True if h(s) is certainly of this sign.
template <class Real>
bool certain(Expansion<Real>& expansion, int guard, double s, int sign) {
  const Polynomial<Real> p = expansion.about(guard, s);
  return sign * p.a[0] > 4.0 * expansion.rounding() * p.size[0];
}

template <class Real>
GuardProof steps(Expansion<Real>& expansion, int guard, int order, double limit, double longest) {
  GuardProof proof{order, limit, true, {}};
  for (double s = 0.0; s < limit;) {
    const Polynomial<Real> p = expansion.about(guard, s, s == 0.0 ? order : 0);
    Step step = longest_step(p, expansion.rounding(), s, std::min(longest, limit - s));
    if (step.d == 0.0 || proof.steps.size() >= most_steps) {
      proof.reached = false;
      return proof;
    }
    proof.steps.push_back(step);
    if (step.d == limit - s) {
      proof.steps.back().d = std::nextafter(step.d, INFINITY);  // s + d >= limit, whatever the difference has lost
      return proof;
    }
    s = std::nextafter(s + step.d, 0.0);  // no hole
    if (s <= step.s) {
      proof.reached = false;
      return proof;
    }
  }
  return proof;
}

template <class Real>
Zero zero(Expansion<Real>& expansion, int guard, double s, double least, double most) {
  for (double delta = least; delta <= most; delta *= 2.0) {
    if (!(s - delta > 0.0)) break;
    if (certain(expansion, guard, s - delta, +1) && certain(expansion, guard, s + delta, -1)) return {true, delta};
  }
  return {};
}

template <class Real>
double positive_before(Expansion<Real>& expansion, int guard, double s, double least) {
  if (certain(expansion, guard, s, +1)) return s;
  for (double delta = least; delta < s; delta *= 2.0)
    if (certain(expansion, guard, s - delta, +1)) return s - delta;
  return 0.0;
}

}  // namespace

void GuardProof::end_at_last_step() {
  for (limit = 0.0; !steps.empty(); steps.pop_back()) {
    limit = std::nextafter(steps.back().s + steps.back().d, 0.0);  // whatever the sum has gained
    if (limit > steps.back().s) break;
    limit = 0.0;
  }
  reached = true;
}

struct SegmentProof::Narrow {
  Expansion<DoubleDouble> expansion;
};

struct SegmentProof::Wide {
  Expansion<Real256> expansion;
};

SegmentProof::SegmentProof(const mode::Mode& mode, const double* X, double duration)
    : mode_(mode),
      X_(X, X + mode.size()),
      duration_(duration),
      narrow_(std::make_unique<Narrow>(Narrow{{mode_, X_, narrow_terms, narrow_rounding}})) {}

SegmentProof::~SegmentProof() = default;

auto& SegmentProof::wide() {
  if (!wide_) wide_ = std::make_unique<Wide>(Wide{{mode_, X_, wide_terms, wide_rounding}});
  return wide_->expansion;
}

GuardProof SegmentProof::prove(int guard, int order, double limit) {
  GuardProof proof = steps(narrow_->expansion, guard, order, limit, mode_.window());
  return proof.reached ? proof : steps(wide(), guard, order, limit, mode_.window());
}

double SegmentProof::positive_until(int guard) {
  return positive_before(narrow_->expansion, guard, duration_, 0x1p-52 * duration_);
}

Zero SegmentProof::zero_at_end(int guard) {
  const double least = std::nextafter(duration_, INFINITY) - duration_, most = 0x1p-20 * mode_.window();
  const Zero found = zero(narrow_->expansion, guard, duration_, least, most);
  return found.certain ? found : zero(wide(), guard, duration_, least, most);
}

double SegmentProof::size_from(int guard, double s) {
  const Polynomial<Real256> p = wide().about(guard, s);
  const double d = duration_ - s;
  double bound = 0.0;
  for (std::size_t n = p.a.size(); n-- > 0;)
    bound = bound * d + std::abs(static_cast<double>(p.a[n])) + wide_rounding * static_cast<double>(p.size[n]);
  return bound * (1.0 + 0x1p-40);
}

}  // namespace slapstick::certify
