/// What a window's Taylor rows leave out must be within the bounds that the event kernel is given, for the guard, its
/// slope and its curvature: the terms n >= 24 by a recursion of their own, beside the rounding of those that are kept.
#include <gtest/gtest.h>

#include "mode/mode.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick::mode {
namespace {

/// Every combination of contact states.
std::vector<ContactStates> all_states(const Model& model) {
  std::vector<ContactStates> all = {{}};
  const auto extend = [&](auto member, auto values) {
    std::vector<ContactStates> more;
    for (const ContactStates& states : all)
      for (const auto value : values) {
        more.push_back(states);
        (more.back().*member).push_back(value);
      }
    all = std::move(more);
  };
  for (std::size_t i = 0; i < model.stops.size(); ++i)
    extend(&ContactStates::stops, std::vector{StopState::open, StopState::closed});
  for (std::size_t i = 0; i < model.frictions.size(); ++i)
    extend(&ContactStates::frictions,
           std::vector{FrictionState::slip_minus, FrictionState::stick, FrictionState::slip_plus});
  for (std::size_t i = 0; i < model.compliant_stops.size(); ++i)
    extend(&ContactStates::compliant, std::vector{CompliantState::off, CompliantState::on});
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

TEST(DroppedTerms, OfSlopesAndCurvaturesAreWithinTheirBounds) {
  constexpr double rounding = 1e-9;  // of the recursion here
  for (const std::string& name : builtin_models()) {
    const Model model = load_model(name).build();
    const Frame frame(model);
    double largest = 0.0;
    for (const ContactStates& states : all_states(model))
      largest = std::max(largest, largest_share({model, frame, states}));
    std::printf("%s: %.4f\n", name.c_str(), largest);
    EXPECT_LE(largest, 1.0 + rounding) << name;
    const bool bends = largest > 0.0;  // guards of free bodies under constant forces are exact polynomials
    EXPECT_TRUE(!bends || largest > 0.5) << name << ": the bounds are empty";
  }
}

}  // namespace
}  // namespace slapstick::mode
