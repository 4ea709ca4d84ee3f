/// Random and adversarial guards against an independent search: 0 missed, 0 false, 0 later than the first, and the
/// cost. SLAPSTICK_CAMPAIGN=N runs N times as many cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "event/guard_polynomials.hpp"
#include "oracle/real.hpp"

namespace slapstick::event {
namespace {

using oracle::Real;
using testing::Taylor;

long campaign() {
  const char* scale = std::getenv("SLAPSTICK_CAMPAIGN");
  return scale == nullptr ? 1 : std::max(1L, std::atol(scale));
}

struct Case {
  Taylor taylor{};
  int order = 0;
  double x_end = 1.0;
};

/// The zero at the start divided out.
Taylor deflated(const Case& c, double lift = 0.0) {
  Taylor g{};
  for (int n = c.order; n < terms; ++n) g[n - c.order] = c.taylor[n];
  g[0] += lift;
  return g;
}

/// In 64 bits where those can tell, else in 50 digits.
std::optional<double> first_zero(const Taylor& g) {
  const testing::Reference<long double> quick(g, 1e-17L);
  if (!quick.unsure()) return quick.first() ? std::optional<double>(static_cast<double>(*quick.first())) : std::nullopt;
  const testing::Reference<Real> sure(g, Real("1e-44"));
  return sure.first() ? std::optional<double>(sure.first()->convert_to<double>()) : std::nullopt;
}

/// What happened over many cases.
struct Tally {
  long cases = 0, crossings = 0, grazes = 0, restarts = 0, evaluations = 0, most_evaluations = 0;
  double worst = 0.0;  ///< |x - exact| in units of what is allowed
  std::string faults;
  int fault_count = 0;

  void fault(const char* what, const Case& c, const Root& root, std::optional<double> exact) {
    if (++fault_count > 5) return;
    char text[160];
    std::snprintf(text, sizeof text, "%s: kind %d x %.17g, exact %.17g, order %d, x_end %.17g, taylor", what,
                  static_cast<int>(root.kind), root.x, exact.value_or(-1.0), c.order, c.x_end);
    faults += text;
    for (const double a : c.taylor) {
      std::snprintf(text, sizeof text, " %a,", a);
      faults += text;
    }
    faults += '\n';
  }
};

/// g at x, its slope, and the noise of both.
struct Place {
  double value, slope, noise;
};

Place place(const Taylor& g, const GuardWindow& guard, double x) {
  return {static_cast<double>(testing::evaluate<long double>(g, x)),
          static_cast<double>(testing::slope<long double>(g, x)), testing::noise(guard, x)};
}

void judge_crossing(const Case& c, const GuardWindow& guard, const Root& root, std::optional<double> exact,
                    Tally& tally) {
  ++tally.crossings;
  if (!exact) return tally.fault("false crossing", c, root, exact);
  const Place q = place(deflated(c), guard, *exact);
  const double allowed = 4 * 0x1p-52 * *exact + 2 * q.noise / std::abs(q.slope);
  const double ratio = std::abs(root.x - *exact) / allowed;
  if (ratio <= 1.0) {
    tally.worst = std::max(tally.worst, ratio);
    return;
  }
  // A cluster of zeros within the noise: the crossing may be any of them, as long as g was never deeper before.
  const std::optional<double> deep = first_zero(deflated(c, 3 * q.noise));
  const Place here = place(deflated(c), guard, root.x);
  if (here.value > 3 * here.noise || (deep && *deep < root.x)) tally.fault("crossing off its place", c, root, exact);
}

/// A graze: g within its noise there, and not beyond it before.
void judge_graze(const Case& c, const GuardWindow& guard, const Root& root, std::optional<double> exact, Tally& tally) {
  const Taylor g = deflated(c);
  const Place q = place(g, guard, root.x);
  ++tally.grazes;
  if (std::abs(q.value) > 3 * q.noise) return tally.fault("graze far from zero", c, root, exact);
  const std::optional<double> deep = first_zero(deflated(c, 3 * q.noise));
  if (deep && *deep < root.x + 1e-9) tally.fault("a crossing taken for a graze", c, root, exact);
}

/// A restart: progress, nothing passed, g clear of its noise there.
void judge_restart(const Case& c, const GuardWindow& guard, const Root& root, std::optional<double> exact,
                   Tally& tally) {
  ++tally.restarts;
  const Place q = place(deflated(c), guard, root.x);
  if (!(root.x > 0.0)) tally.fault("a restart without progress", c, root, exact);
  if (exact && *exact <= root.x) tally.fault("a zero before the restart", c, root, exact);
  if (q.value < 7 * q.noise) tally.fault("a restart in the noise", c, root, exact);
}

void judge(const Case& c, Tally& tally) {
  const GuardWindow guard = testing::window(c.taylor, c.order);
  const std::optional<double> exact = first_zero(deflated(c));
  long evaluations = 0;
  ++tally.cases;
  if (excluded(guard.hull)) {
    if (exact) tally.fault("excluded in spite of a zero", c, {}, exact);
    return;
  }
  const Root root = first_root(guard, c.x_end, evaluations);
  tally.evaluations += evaluations;
  tally.most_evaluations = std::max(tally.most_evaluations, evaluations);
  const Root whole = first_root(guard, 1.0, evaluations);
  const bool reached = whole.kind != RootKind::none && whole.x <= c.x_end;
  if (reached ? root.kind != whole.kind || root.x != whole.x : root.kind != RootKind::none)
    tally.fault("a result that depends on x_end", c, root, exact);
  if (root.kind != RootKind::none && root.x > c.x_end) tally.fault("past the end", c, root, exact);
  if (root.kind == RootKind::crossing) return judge_crossing(c, guard, root, exact, tally);
  if (root.kind == RootKind::graze) return judge_graze(c, guard, root, exact, tally);
  if (root.kind == RootKind::restart) return judge_restart(c, guard, root, exact, tally);
  if (!exact) return;
  const Place q = place(deflated(c), guard, *exact);
  if (*exact < c.x_end - 4 * 0x1p-52 - 2 * q.noise / std::abs(q.slope)) tally.fault("missed", c, root, exact);
}

class Campaign {
 public:
  explicit Campaign(std::uint64_t seed) : random_(seed) {}

  /// A guard with h(0) > 0 to be a quotient; its least value is `depth` if that is given.
  Taylor guard(std::optional<double> depth) {
    for (;;) {
      Taylor g = random_.damped_sinusoids();
      if (!depth) {
        g[0] += random_.uniform(-0.5, 0.5);
      } else {
        const auto [least, where] = testing::minimum(g, 0.01L);
        if (where < 0.02L || where > 0.9999L) continue;
        g[0] += static_cast<double>(*depth - least);
      }
      if (g[0] > 1e-3) return g;
    }
  }

  double depth() {
    const double sign = random_.integer(0, 1) == 0 ? 1.0 : -1.0;
    return random_.integer(0, 1) == 0 ? sign * std::pow(10.0, -random_.integer(1, 17))
                                      : sign * std::ldexp(1.0, -random_.integer(3, 56));
  }

  Case wrap(const Taylor& g) {
    Case c;
    c.order = random_.integer(0, 3);
    for (int n = c.order; n < terms; ++n) c.taylor[n] = g[n - c.order];
    if (random_.integer(0, 1) == 0) c.x_end = random_.uniform(0.01, 1.0);
    return c;
  }

  testing::RandomGuards& random() { return random_; }

 private:
  testing::RandomGuards random_;
};

void report(const char* name, const Tally& tally) {
  std::printf(
      "%s: %ld cases, %ld crossings, %ld grazes, %ld restarts, worst %.2f of the allowed error, evaluations mean %.2f "
      "most %ld\n",
      name, tally.cases, tally.crossings, tally.grazes, tally.restarts, tally.worst,
      static_cast<double>(tally.evaluations) / static_cast<double>(tally.cases), tally.most_evaluations);
  EXPECT_EQ(tally.fault_count, 0) << tally.faults;
}

TEST(FirstRootCampaign, RandomGuardsNoneMissedNoneFalse) {
  Campaign campaign_of(1);
  Tally tally;
  for (long i = 0; i < 80'000 * campaign(); ++i) judge(campaign_of.wrap(campaign_of.guard({})), tally);
  report("random", tally);
  EXPECT_LT(tally.evaluations, 6 * tally.cases);
  EXPECT_LT(tally.most_evaluations, 200);
}

TEST(FirstRootCampaign, NearGrazesDownToTheNoiseAreHitMissOrGraze) {
  Campaign campaign_of(2);
  Tally tally;
  for (long i = 0; i < 20'000 * campaign(); ++i) judge(campaign_of.wrap(campaign_of.guard(campaign_of.depth())), tally);
  report("near-graze", tally);
  EXPECT_GT(tally.grazes, 100);
  EXPECT_LT(tally.evaluations, 40 * tally.cases);
  EXPECT_LT(tally.most_evaluations, 4000);
}

TEST(FirstRootCampaign, RootsAtTheVeryEnd) {
  Campaign campaign_of(3);
  Tally tally;
  while (tally.cases < 5'000 * campaign()) {
    Case c = campaign_of.wrap(campaign_of.guard({}));
    const auto exact = first_zero(deflated(c));
    if (!exact || *exact >= 1.0) continue;
    c.x_end = std::min(1.0, *exact * (1 + campaign_of.random().integer(-4, 4) * 0x1p-53));
    judge(c, tally);
  }
  report("at the end", tally);
}

TEST(FirstRootCampaign, SeveralAndMultipleRootsInOneWindow) {
  Campaign campaign_of(4);
  Tally tally;
  testing::RandomGuards& random = campaign_of.random();
  for (long i = 0; i < 4'000 * campaign(); ++i) {
    const int count = random.integer(2, 4);  // roots: double, triple, fourfold or spread
    const double first = random.uniform(0.05, 0.9), spread = std::pow(10.0, random.uniform(-9, 0));
    Taylor g{};
    g[0] = 1.0;
    for (int k = 0; k < count; ++k) {
      const double root = i % 3 == 0 ? first : first + spread * random.uniform(0, 1);
      for (int n = degree; n >= 0; --n) g[n] = g[n] - (n > 0 ? g[n - 1] / root : 0.0);
    }
    if (g[0] > 0.0) judge(campaign_of.wrap(g), tally);
  }
  report("several roots", tally);
  // A touch of order four is approached in steps of the square of its distance: thousands of evaluations, but never a
  // hang.
  EXPECT_LT(tally.most_evaluations, 40'000);
}

}  // namespace
}  // namespace slapstick::event
