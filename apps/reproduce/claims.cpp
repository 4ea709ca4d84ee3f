/// The surveys, and all claims in parallel.
#include "reproduce/claims.hpp"

#include <cmath>
#include <stdexcept>

namespace slapstick::paper {
namespace {

constexpr double from = 0.56, to = 10.0;

/// A long chain, independent of all others.
struct Chain {
  std::vector<Found>* target;
  Overrides with;
  double step;
  bool up;
};

std::vector<Case*> cases(Surveys& all) {
  std::vector<Case*> out;
  for (Case& one : all.frictions) out.push_back(&one);
  out.push_back(&all.printed);
  out.push_back(&all.weak_kinetic);
  return out;
}

void find_attractors(const Study& study, Surveys& all) {
  const double step = study.sizes().survey_step;
  std::vector<Chain> chains = {{&all.down, {}, step, false}};
  for (Case* one : cases(all))
    chains.push_back({&one->survey, one->with, one == &all.paper() ? step : 2.0 * step, true});
  const int steps = static_cast<int>(std::lround((to - from) / step)), blocks = 20;  // starts at rest, in blocks
  all.rest.resize(static_cast<std::size_t>(steps) + 1);
  const int long_work = static_cast<int>(chains.size());
  study.each(long_work + blocks, [&](int k) {
    if (k < long_work) {
      const Chain& chain = chains[static_cast<std::size_t>(k)];
      *chain.target = survey(study, chain.with, from, to, chain.step, chain.up);
      return;
    }
    for (int i = k - long_work; i <= steps; i += blocks) {
      study.course().check();
      all.rest[static_cast<std::size_t>(i)] = study.find({}, from + (to - from) * i / steps, study.rest());
    }
  });
}

void find_windows(const Study& study, Surveys& all) {
  std::vector<std::pair<Case*, int>> wanted;  // six stairs of the paper's own diagram, fewer of those compared with it
  for (Case* one : cases(all)) {
    const bool other = one == &all.printed || one == &all.weak_kinetic;
    const int stairs = one == &all.paper() ? 6 : other ? 1 : study.options().quick ? 3 : 4;
    const int step = study.options().quick && one != &all.paper() ? 2 : 1;  // what the claims need: 1-1 and 3-1
    for (int n = 1; n <= stairs; n += step) wanted.emplace_back(one, n);
  }
  study.each(static_cast<int>(wanted.size()), [&](int k) {
    const auto [one, n] = wanted[static_cast<std::size_t>(k)];
    one->windows[n] = staircase_window(study, one->with, one->survey, n);
  });
}

}  // namespace

const Case& Surveys::paper() const {
  for (std::size_t i = 0; i < std::size(friction_values); ++i)
    if (friction_values[i] == 0.15) return frictions[i];
  throw std::logic_error("the paper's friction is missing");
}

Surveys make_surveys(const Study& study) {
  Surveys all;
  for (const double friction : friction_values) all.frictions.push_back({{{"friction", friction}}, {}, {}});
  all.printed.with = {{"restitution", 0.08}};
  all.weak_kinetic.with = {{"kinetic_friction", 0.1}};
  find_attractors(study, all);
  study.course().next();
  find_windows(study, all);
  return all;
}

std::vector<Claim> check_claims(const Study& study) {
  const Surveys surveys = make_surveys(study);
  study.course().next();
  const Evidence evidence{study, surveys};
  using Check = Claim (*)(const Evidence&);
  // The longest first.
  const std::pair<Check, std::size_t> checks[] = {{claim_7, 6}, {claim_8, 7}, {claim_4, 3},     {claim_6, 5},
                                                  {claim_9, 8}, {claim_5, 4}, {claim_print, 9}, {claim_1, 0},
                                                  {claim_2, 1}, {claim_3, 2}, {coexisting, 10}};
  std::vector<Claim> claims(std::size(checks));
  study.each(static_cast<int>(std::size(checks)), [&](int i) { claims[checks[i].second] = checks[i].first(evidence); });
  return claims;
}

}  // namespace slapstick::paper
