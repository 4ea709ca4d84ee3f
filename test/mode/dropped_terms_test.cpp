/// What a window's Taylor rows leave out must be within the bounds that the event kernel is given, for the guard, its
/// slope and its curvature: the terms n >= 24 by a recursion of their own, beside the rounding of those that are kept.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <set>

#include "mode/mode.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick::mode {
namespace {

constexpr std::size_t most_modes = 400;  ///< of a model; of one with more combinations this many are drawn

/// The states that each contact of a model may have.
struct Choices {
  explicit Choices(const Model& model) {
    stops.assign(model.stops.size(), {StopState::open, StopState::closed});
    for (const FrictionContact& friction : model.frictions) {
      frictions.push_back({FrictionState::slip_minus, FrictionState::stick, FrictionState::slip_plus});
      if (friction.normal) frictions.back().push_back(FrictionState::unloaded);
    }
    for (const CompliantStop& stop : model.compliant_stops) {
      compliant.push_back({CompliantState::off, CompliantState::on});
      if (!stop.pulls && stop.damping > 0.0) compliant.back().push_back(CompliantState::detached);
      if (stop.bounded) compliant.back().push_back(CompliantState::bounded);
    }
    for (const Characteristic& characteristic : model.characteristics) {
      pieces.emplace_back(characteristic.corners.size() + 1);
      std::iota(pieces.back().begin(), pieces.back().end(), 0);
    }
  }

  std::vector<std::vector<StopState>> stops;
  std::vector<std::vector<FrictionState>> frictions;
  std::vector<std::vector<CompliantState>> compliant;
  std::vector<std::vector<int>> pieces;
};

/// Every combination of contact states; of very many, drawn ones.
std::vector<ContactStates> all_states(const Model& model) {
  const Choices choices(model);
  std::vector<ContactStates> all = {{}};
  std::mt19937_64 random(1);
  const auto extend = [&](auto member, const auto& values_of_each) {
    for (const auto& values : values_of_each) {
      std::vector<ContactStates> more;
      for (const ContactStates& states : all)
        for (const auto value : values) {
          more.push_back(states);
          (more.back().*member).push_back(value);
        }
      std::shuffle(more.begin(), more.end(), random);
      more.resize(std::min(more.size(), most_modes));
      all = std::move(more);
    }
  };
  extend(&ContactStates::stops, choices.stops);
  extend(&ContactStates::frictions, choices.frictions);
  extend(&ContactStates::compliant, choices.compliant);
  extend(&ContactStates::pieces, choices.pieces);
  return all;
}

/// Sums over the terms of a guard by one column, kept ones n >= 2 and dropped ones n >= 24.
struct Sums {
  double slope = 0.0, curvature = 0.0;
  void add(int n, double term) {
    slope += n * term;
    curvature += n * (n - 1.0) * term;
  }
};

/// The largest share of the bounds that a column's dropped terms and rounding take together.
double largest_share(const Mode& mode) {
  constexpr int terms = 120;  // of c A^n H^n / n!: with a window of some three radians the last is below 1e-100
  const int m = mode.size();
  double largest = 0.0;
  for (int g = 0; g < mode.guard_count(); ++g) {
    std::vector<Sums> kept(static_cast<std::size_t>(m)), dropped(static_cast<std::size_t>(m));
    RowVector term = mode.guards()[static_cast<std::size_t>(g)].row;
    for (int n = 0; n < terms; ++n) {
      for (int i = 0; i < m; ++i) {
        auto& sums = n < event::terms ? kept : dropped;
        if (n >= 2) sums[static_cast<std::size_t>(i)].add(n, std::abs(term[i]));
      }
      term = term * mode.system() * (mode.window() / (n + 1));
    }
    for (int i = 0; i < m; ++i) {
      std::vector<double> X(static_cast<std::size_t>((m + 7) / 8 * 8), 0.0);
      X[static_cast<std::size_t>(i)] = 1.0;
      event::Hull hull;
      mode.enclose(g, 0, X.data(), X.data(), hull);
      const auto at = static_cast<std::size_t>(i);
      const double slope = dropped[at].slope + mode.noise_factor() * kept[at].slope;
      const double curvature = dropped[at].curvature + mode.noise_factor() * kept[at].curvature;
      if (slope > 0.0) largest = std::max(largest, slope / hull.bounds[event::slope_noise]);
      if (curvature > 0.0) largest = std::max(largest, curvature / hull.bounds[event::curvature_noise]);
    }
  }
  return largest;
}

/// Sums of |c A^n H^n / n!| over n >= 24, and the largest term n < 24 of every block, of a row c.
struct Row {
  std::vector<double> dropped;
  std::array<double, 4> scale{};
};
Row row_over(const Mode& mode, const RowVector& c, int d, double window) {
  const int m = mode.size();
  Row row{std::vector<double>(static_cast<std::size_t>(m), 0.0)};
  RowVector term = c;
  for (int n = 0; n < 120; ++n) {
    for (int i = 0; i < m; ++i) {
      const double size = std::abs(term[i]);
      double& scale = row.scale[static_cast<std::size_t>(i == m - 1 ? 3 : i >= 2 * d ? 2 : i / d)];
      if (n < event::terms)
        scale = std::max(scale, size);
      else
        row.dropped[static_cast<std::size_t>(i)] += size;
    }
    term = term * mode.system() * (window / (n + 1));
  }
  return row;
}

/// What a window of this length drops, over what it may: the rule of docs/developers/proofs.md, section 2, by a
/// recursion of its own.
double excess(const Mode& mode, int d, double window) {
  const int m = mode.size();
  std::vector<Row> rows;
  for (const Guard& guard : mode.guards()) rows.push_back(row_over(mode, guard.row, d, window));
  std::array<double, 4> common{};
  for (int i = 0; i < d; ++i) {
    rows.push_back(row_over(mode, RowVector::Unit(m, i), d, window));
    for (std::size_t b = 0; b < 4; ++b) common[b] = std::max(common[b], rows.back().scale[b]);
  }
  double most = 0.0;
  for (const Row& row : rows) {
    double share = 0.0;
    for (std::size_t b = 0; b < 4; ++b)
      if (common[b] > 0.0) share = std::max(share, row.scale[b] / common[b]);
    for (int i = 0; i < m; ++i) {
      const auto b = static_cast<std::size_t>(i == m - 1 ? 3 : i >= 2 * d ? 2 : i / d);
      const double scale = std::max(row.scale[b], share * common[b]);
      if (scale > 0.0)
        most = std::max(most, row.dropped[static_cast<std::size_t>(i)] / (0.25 * event::unit_roundoff * scale));
    }
  }
  return most;
}

/// The built-in models, and those that have every law of force.
std::vector<std::string> models() {
  std::vector<std::string> all = builtin_models();
  for (const char* file : {"pressed-pair.toml", "every-stop.toml"})
    all.push_back(std::string(SLAPSTICK_ORBIT_MODELS) + file);
  return all;
}

TEST(DroppedTerms, OfSlopesAndCurvaturesAreWithinTheirBounds) {
  constexpr double rounding = 1e-9;  // of the recursion here
  std::set<GuardKind> kinds;
  for (const std::string& name : models()) {
    const Model model = load_model(name).build();
    const Frame frame(model);
    const std::vector<ContactStates> all = all_states(model);
    double largest = 0.0;
    for (const ContactStates& states : all) {
      const Mode mode(model, frame, states);
      for (const Guard& guard : mode.guards()) kinds.insert(guard.kind);
      largest = std::max(largest, largest_share(mode));
    }
    std::printf("%s: %zu modes, %.4f\n", name.c_str(), all.size(), largest);
    EXPECT_LE(largest, 1.0 + rounding) << name;
    const bool bends = largest > 0.0;  // guards of free bodies under constant forces are exact polynomials
    EXPECT_TRUE(!bends || largest > 0.5) << name << ": the bounds are empty";
  }
  EXPECT_EQ(kinds.size(), static_cast<std::size_t>(GuardKind::beyond) + 1) << "a kind of guard is in no model";
}

/// Longer, and it would drop too much; shorter, and every motion pays for more windows.
TEST(Window, IsAsLongAsWhatItDropsAllows) {
  int bounded = 0;
  for (const char* name : {"vibro-impact", "two-blocks-on-belt", "drill-string", "stick-slip-impact", "spool"}) {
    const Model model = load_model(name).build();
    const Frame frame(model);
    for (const ContactStates& states : all_states(model)) {
      const Mode mode(model, frame, states);
      EXPECT_LE(excess(mode, frame.d, mode.window()), 1.0 + 1e-9) << name;
      const double longer = excess(mode, frame.d, 1.002 * mode.window());   // a step of its bisection is 0.07 %
      EXPECT_TRUE(longer > 1.0 || longer == 0.0) << name << ' ' << longer;  // 0: its series ends by itself
      bounded += longer > 1.0;
    }
  }
  EXPECT_GT(bounded, 20);
}

}  // namespace
}  // namespace slapstick::mode
