/// Follows the orbit of a motion, as `slapstick continue` does, and reads what the diagram shows.
#include <algorithm>
#include <cmath>

#include "analysis.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/continuation/branch.hpp"
#include "slapstick/continuation/sentences.hpp"
#include "slapstick/orbit/find.hpp"

namespace slapstick::web {
namespace {

/// What a diagram shows of an orbit: a number for each impact of a cycle, or for each of its periods.
class Shown {
 public:
  Shown(const orbit::Problem& problem, const Model& model, const BranchWish& wish) : problem_(problem), wish_(wish) {
    const std::vector<std::string> names = state_names(model);
    const auto found = std::find(names.begin(), names.end(), wish.shown);
    if (found != names.end()) index_ = static_cast<int>(found - names.begin());
    if (index_ < 0 && wish.shown != "w" && wish.shown != "phase" && wish.shown != "flight")
      throw InputError("a branch over a diagram shows w, phase or flight of impacts, or a displacement or velocity");
  }

  [[nodiscard]] std::vector<double> of(const orbit::Orbit& orbit) const {
    std::vector<double> values;
    if (wish_.at == "periods" && index_ >= 0) {
      for (int period = 0; period < std::max(orbit.shape.n, 1); ++period)
        values.push_back(at_phase_zero(problem_, orbit, period)[static_cast<std::size_t>(index_)]);
      return values;
    }
    const std::vector<orbit::EventOfOrbit> impacts = impacts_of(orbit);
    for (std::size_t i = 0; i < impacts.size(); ++i) values.push_back(value(impacts, i, orbit));
    return values;
  }

 private:
  [[nodiscard]] std::vector<orbit::EventOfOrbit> impacts_of(const orbit::Orbit& orbit) const {
    std::vector<orbit::EventOfOrbit> impacts;
    for (orbit::EventOfOrbit& event : events(problem_, orbit))
      if (event.kind == EventKind::impact || (event.kind == EventKind::engage && event.w > 0.0))
        impacts.push_back(std::move(event));
    return impacts;
  }

  [[nodiscard]] double value(const std::vector<orbit::EventOfOrbit>& impacts, std::size_t i,
                             const orbit::Orbit& orbit) const {
    const orbit::EventOfOrbit& impact = impacts[i];
    if (index_ >= 0) return impact.before[static_cast<std::size_t>(index_)];
    if (wish_.shown == "w") return impact.w;
    if (wish_.shown == "phase") return impact.t - std::floor(impact.t);
    const double cycle = orbit.t.back() - orbit.t.front();
    return i > 0 ? impact.t - impacts[i - 1].t : impact.t + cycle - impacts.back().t;
  }

  const orbit::Problem& problem_;
  const BranchWish& wish_;
  int index_ = -1;
};

Json point_json(const orbit::Solution& solution, const Shown& shown, const orbit::Problem& problem) {
  Json json = Json::object();
  json.set("value", solution.orbit.values.at(0)).set("stable", solution.stable()).set("label", solution.label);
  json.set("motion", solution.is_motion).set("shown", Json::list(shown.of(solution.orbit)));
  return json.set("state", Json::list(at_phase_zero(problem, solution.orbit)));
}

Json special_json(const orbit::SpecialPoint& point, const Shown& shown, const System& system) {
  Json json = Json::object();
  json.set("type", std::string(name(point.type))).set("value", point.value);
  json.set("what", what_happens(point, system)).set("becomes", what_becomes(point));
  return json.set("shown", Json::list(shown.of(point.solution.orbit)));
}

}  // namespace

Json branch_of(const Choice& choice, const BranchWish& wish) {
  const double now = choice.definition.present_value(wish.parameter, choice.set);
  const auto problem = orbit::pose(choice.definition.family({wish.parameter}, choice.set), {now});
  const System system(choice.model());
  const Shown shown(*problem, system.model(), wish);
  const auto spelled = [](std::string_view option) { return std::string(option); };
  const orbit::Chosen chosen = find_orbit(*problem, system, choice.start_at(), {}, nullptr, spelled);
  const orbit::Branch branch = follow(*problem, chosen.orbit->orbit, {.from = wish.from, .to = wish.to});
  Json points = Json::list(), special = Json::list();
  for (const orbit::Solution& point : branch.points) points.push(point_json(point, shown, *problem));
  for (const orbit::SpecialPoint& point : branch.special) special.push(special_json(point, shown, system));
  Json json = Json::object();
  json.set("points", std::move(points)).set("special", std::move(special)).set("failed", branch.failed());
  return json.set("ended", sentence(branch));
}

}  // namespace slapstick::web
