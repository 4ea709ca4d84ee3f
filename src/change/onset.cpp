/// The end of a cascade: by the onset's own equations, or from its last grazes by the law of the stop that chatters.
#include "change/onset.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/dense.hpp"
#include "change/cascade_law.hpp"
#include "change/onset_orbit.hpp"
#include "mode/frame.hpp"

namespace slapstick::orbit {

SpecialPoint onset(const OnsetInterval& between, const Solution& nearest) {
  SpecialPoint special;
  special.type = SpecialType::CH;
  special.value = 0.5 * (between.from + between.to);
  special.error = std::abs(between.to - between.from);
  special.solution = nearest;
  special.occurrence = between.release ? Occurrence::release : Occurrence::onset;
  return special;
}

namespace {

constexpr std::size_t most_used =
    8;  ///< grazes of a cascade: with more rates taken out their own errors grow beyond what is gained

/// The restitution between impacts of a stop when the friction contacts that stick before an impact stick again long
/// before the next one: their slips last as long as the impact's speed by their friction, which goes to zero faster
/// than a flight. With g the row of the stop, F those of the contacts,
///     r' = r - (1 + r) kappa,   kappa = (g M^-1 F^T) (F M^-1 F^T)^-1 (F M^-1 g^T) / (g M^-1 g^T).
double effective_restitution(const Model& model, const mode::Frame& frame, int stop,
                             const mode::ContactStates& states) {
  std::vector<int> stuck;
  for (std::size_t i = 0; i < frame.frictions.size(); ++i)
    if (states.frictions[i] == mode::FrictionState::stick) stuck.push_back(frame.frictions[i].own);
  const double r = model.stops[stop].restitution;
  if (stuck.empty()) return r;
  const int own = frame.stops[stop].own;
  const Eigen::VectorXd push = frame.mass_inverse(stuck, own);
  const dense::LeastNorm held(Eigen::MatrixXd(frame.mass_inverse(stuck, stuck)));
  return r - (1.0 + r) * push.dot(held.solve(push)) / frame.mass_inverse(own, own);
}

/// The law of the stop's cascade (change/cascade_law.hpp).
std::optional<PlaceLimit> limit_at_stop(const Problem& problem, const SpecialPoint& nearest,
                                        const std::vector<double>& places, const std::vector<double>& errors) {
  const Model model = problem.family().model(nearest.solution.orbit.values);
  const mode::Frame frame(model);
  const int stop = nearest.margin.contact;
  if (has_friction(model, frame, stop)) return limit_with_friction(places);
  const Leg& leg = nearest.solution.orbit.shape.legs[nearest.margin.leg];
  const double r = effective_restitution(model, frame, stop, leg.states);
  if (!(r > 0.0 && r < 1.0)) return std::nullopt;
  return limit_by_rates(places, errors, cascade_rates(r, most_used));
}

std::optional<PlaceLimit> as_place(const std::optional<OnsetOrbit>& found) {
  if (!found) return std::nullopt;
  return PlaceLimit{found->orbit.parameter(), found->error};
}

/// The nearest grazes of one stop, in which each adds an impact to the next one's; between equal stops one at each.
struct Gathering {
  std::vector<double> places, errors;
  bool is_cascade = false;
};
Gathering gathering(const std::vector<Solution>& points, const std::vector<const SpecialPoint*>& grazes) {
  constexpr std::size_t fewest = 4;  // three and one more, from which the error is known
  Gathering found;
  if (grazes.size() < fewest) return found;
  const auto impacts = [&](std::size_t i) { return points[grazes[i]->after].impacts; };
  const long added = impacts(0) - impacts(1);
  for (std::size_t i = 0; i < grazes.size() && (i == 0 || impacts(i - 1) - impacts(i) == added); ++i) {
    found.places.push_back(grazes[i]->value);
    found.errors.push_back(grazes[i]->error);
  }
  found.is_cascade = added >= 1 && found.places.size() >= fewest && grazes[0]->margin.guard == mode::GuardKind::gap;
  return found;
}

/// Empty if the grazes are no cascade: if the limit is not beyond the last graze, or known no better than that graze's
/// distance from it.
std::optional<CascadeLimit> limit_of(const Problem& problem, const std::vector<Solution>& points,
                                     const std::vector<const SpecialPoint*>& grazes, std::optional<PlaceLimit>& exact) {
  Gathering all = gathering(points, grazes);
  if (!all.is_cascade) return std::nullopt;
  const double began = all.places.back();
  if (!exact) exact = as_place(onset_orbit(problem, grazes[0]->solution.orbit, grazes[0]->margin.contact));
  all.places.resize(std::min(all.places.size(), most_used));
  all.errors.resize(all.places.size());
  const auto limit = exact ? exact : limit_at_stop(problem, *grazes[0], all.places, all.errors);
  if (!limit) return std::nullopt;
  const double last = all.places[0] - all.places[1], left = limit->value - all.places[0];
  if (!(last * left > 0.0 && limit->error < std::abs(left))) return std::nullopt;
  return CascadeLimit{limit->value, limit->error, last / (all.places[1] - all.places[2]),
                      std::abs(limit->value - all.places[1]), std::abs(limit->value - began)};
}

/// The grazes of a range of special points.
template <class Iterator>
std::vector<const SpecialPoint*> grazes_of(Iterator point, const Iterator& end) {
  std::vector<const SpecialPoint*> grazes;
  for (; point != end; ++point)
    if (point->type == SpecialType::GR) grazes.push_back(&*point);
  return grazes;
}

}  // namespace

std::optional<CascadeLimit> cascade_limit(const Problem& problem, const std::vector<Solution>& points,
                                          const std::vector<SpecialPoint>& special, std::optional<PlaceLimit>& exact) {
  return limit_of(problem, points, grazes_of(special.rbegin(), special.rend()), exact);
}

std::optional<PlaceLimit> chatter_limit(const Problem& problem, const Orbit& orbit) {
  const std::optional<int> stop = chattering_stop(orbit);
  return stop ? as_place(onset_orbit(problem, orbit, *stop)) : std::nullopt;
}

std::optional<PlaceLimit> knot_limit(const Problem& problem, const Orbit& chattering) {
  const std::size_t k = chattering.legs();
  for (std::size_t i = 0; i < k; ++i) {
    if (!rests_to_knot(chattering.shape, (i + 1) % k)) continue;
    Orbit orbit = chattering;
    rotate(orbit, i);  // the chatter's tail, then the rest
    orbit.t[2] = orbit.t[1];
    const NewtonResult result = solve(problem, orbit, fixed_length(problem, k, 1), 20);
    if (!result.converged) continue;
    const double value = orbit.parameter();
    return PlaceLimit{value, std::max(result.last_step, 0x1p-52) * std::abs(value)};
  }
  return std::nullopt;
}

void sharpen_onsets(const Problem& problem, const std::vector<Solution>& points, std::vector<SpecialPoint>& special) {
  for (auto onset = special.begin(); onset != special.end(); ++onset) {
    if (onset->type != SpecialType::CH || onset->occurrence != Occurrence::onset) continue;
    std::optional<PlaceLimit> limit = chatter_limit(problem, onset->solution.orbit);
    if (!limit)
      if (const auto cascade = limit_of(problem, points, grazes_of(onset, special.end()), limit))
        limit = PlaceLimit{cascade->value, cascade->error};
    if (!limit || limit->error >= onset->error || std::abs(limit->value - onset->value) > 10.0 * onset->error) continue;
    onset->value = limit->value;
    onset->error = limit->error;
  }
}

bool chatter_lengthens(const std::vector<Solution>& points) {
  std::size_t first = points.size();
  while (first > 0 && points[first - 1].chatter) --first;
  if (first == points.size()) return false;
  return static_cast<double>(points.back().orbit.legs()) >=
         longer_burst * static_cast<double>(points[first].orbit.legs());
}

}  // namespace slapstick::orbit
