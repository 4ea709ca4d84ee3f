/// Follows orbits and special points, and reads what the diagram shows of them.
#include "branch_study.hpp"

#include <algorithm>
#include <cmath>

#include "slapstick/base/error.hpp"
#include "slapstick/continuation/sentences.hpp"
#include "slapstick/orbit/find.hpp"

namespace slapstick::web {
namespace {

std::vector<orbit::EventOfOrbit> impacts_of(const orbit::Problem& problem, const orbit::Orbit& orbit) {
  std::vector<orbit::EventOfOrbit> impacts;
  for (orbit::EventOfOrbit& event : events(problem, orbit))
    if (event.kind == EventKind::impact || (event.kind == EventKind::engage && event.w > 0.0))
      impacts.push_back(std::move(event));
  return impacts;
}

/// Changes that gather at the onset of a chatter, for which the onset stands.
std::vector<bool> told_by_onset(const orbit::Branch& branch) {
  std::vector<bool> told(branch.special.size(), false);
  for (const orbit::Cascade& cascade : orbit::cascades(branch))
    for (std::size_t i = cascade.first; i <= cascade.last; ++i) told[i] = i != cascade.onset;
  return told;
}

}  // namespace

ShownOfOrbit::ShownOfOrbit(const Model& model, const BranchWish& wish)
    : shown_(wish.shown), by_periods_(wish.at == "periods") {
  const std::vector<std::string> names = state_names(model);
  const auto found = std::find(names.begin(), names.end(), shown_);
  if (found != names.end()) index_ = static_cast<int>(found - names.begin());
  if (index_ < 0 && shown_ != "w" && shown_ != "phase" && shown_ != "flight")
    throw InputError("a branch over a diagram shows w, phase or flight of impacts, or a displacement or velocity");
}

std::vector<double> ShownOfOrbit::of(const orbit::Problem& problem, const orbit::Orbit& orbit) const {
  std::vector<double> values;
  if (by_periods_ && index_ >= 0) {
    for (int period = 0; period < std::max(orbit.shape.n, 1); ++period)
      values.push_back(at_phase_zero(problem, orbit, period)[static_cast<std::size_t>(index_)]);
    return values;
  }
  const std::vector<orbit::EventOfOrbit> impacts = impacts_of(problem, orbit);
  for (std::size_t i = 0; i < impacts.size(); ++i) values.push_back(value(impacts, i, orbit));
  return values;
}

double ShownOfOrbit::value(const std::vector<orbit::EventOfOrbit>& impacts, std::size_t i,
                           const orbit::Orbit& orbit) const {
  const orbit::EventOfOrbit& impact = impacts[i];
  if (index_ >= 0) return impact.before[static_cast<std::size_t>(index_)];
  if (shown_ == "w") return impact.w;
  if (shown_ == "phase") return impact.t - std::floor(impact.t);
  const double cycle = orbit.t.back() - orbit.t.front();
  return i > 0 ? impact.t - impacts[i - 1].t : impact.t + cycle - impacts.back().t;
}

BranchStudy::BranchStudy(const Choice& choice, const BranchWish& wish, Progress progress)
    : choice_(choice),
      system_(choice.model()),
      shown_(system_.model(), wish),
      progress_(std::move(progress)),
      parameter_(wish.parameter) {
  const double now = choice.definition.present_value(parameter_, choice.set);
  problem_ = orbit::pose(choice.definition.family({parameter_}, choice.set), {now});
  how_.from = wish.from, how_.to = wish.to;
  how_.progress = [this](double, long points) { progress_(points); };
  const auto spelled = [](std::string_view option) { return std::string(option); };
  const orbit::Chosen chosen = find_orbit(*problem_, system_, choice.start_at(), {}, nullptr, spelled);
  branches_.push_back(orbit::follow(*problem_, chosen.orbit->orbit, how_));
}

const orbit::SpecialPoint& BranchStudy::point(std::size_t branch, std::size_t special) const {
  return branches_.at(branch).special.at(special);
}

Json BranchStudy::branch_json(const orbit::Branch& branch) const {
  Json points = Json::list(), special = Json::list();
  for (const orbit::Solution& solution : branch.points) {
    Json json = Json::object();
    json.set("value", solution.orbit.values.at(0)).set("stable", solution.stable()).set("label", solution.label);
    json.set("shown", Json::list(shown_.of(*problem_, solution.orbit)));
    points.push(json.set("state", Json::list(at_phase_zero(*problem_, solution.orbit))));
  }
  const std::vector<bool> in_cascade = told_by_onset(branch);
  for (std::size_t i = 0; i < branch.special.size(); ++i) {
    const orbit::SpecialPoint& one = branch.special[i];
    Json json = Json::object();
    json.set("type", std::string(name(one.type))).set("value", one.value);
    json.set("what", what_happens(one, system_)).set("becomes", what_becomes(one));
    json.set("begins", !one.born.empty()).set("inCascade", static_cast<bool>(in_cascade[i]));
    json.set("state", Json::list(at_phase_zero(*problem_, one.solution.orbit)));
    special.push(json.set("shown", Json::list(shown_.of(*problem_, one.solution.orbit))));
  }
  Json json = Json::object();
  json.set("points", std::move(points)).set("special", std::move(special));
  json.set("whole",
           branch.down.kind == orbit::BranchEnd::Kind::range && branch.up.kind == orbit::BranchEnd::Kind::range);
  return json.set("ended", sentence(branch));
}

Json BranchStudy::branches(std::size_t first) const {
  Json list = Json::list();
  for (std::size_t b = first; b < branches_.size(); ++b) list.push(branch_json(branches_[b]));
  return Json::object().set("branches", std::move(list));
}

Json BranchStudy::follow_born(std::size_t branch, std::size_t special) {
  const std::size_t known = branches_.size();
  const std::vector<orbit::Orbit> born = point(branch, special).born;  // the list of branches grows
  std::vector<std::size_t> images;
  for (const orbit::Orbit& start : born) (void)orbit::follow_born(*problem_, branches_, start, how_, images);
  return branches(known);
}

Json BranchStudy::curve(std::size_t branch, std::size_t special, const CurveWish& wish) const {
  orbit::SpecialPoint start = point(branch, special);
  const double now = choice_.definition.present_value(wish.second, choice_.set);
  start.solution.orbit.values = {start.value, now};
  const auto problem =
      orbit::pose(choice_.definition.family({parameter_, wish.second}, choice_.set), {start.value, now});
  orbit::CurveOptions how{
      .from = wish.from, .to = wish.to, .second_from = wish.second_from, .second_to = wish.second_to};
  how.progress = progress_;
  const orbit::Curve curve = orbit::locus(*problem, start, how);
  std::vector<double> first, second, motion;
  for (const orbit::CurvePoint& one : curve.points) {
    first.push_back(one.values.at(0)), second.push_back(one.values.at(1));
    motion.push_back(one.solution.is_motion ? 1.0 : 0.0);
  }
  Json met = Json::list(), json = Json::object();
  for (const orbit::CurveEvent& event : curve.met) {
    Json item = Json::object();
    item.set("type", name(event.met.front())).set("what", sentence(curve, event, system_));
    met.push(item.set("values", Json::list(event.values)));
  }
  json.set("type", std::string(name(start.type))).set("first", Json::list(first)).set("second", Json::list(second));
  json.set("motion", Json::list(motion)).set("met", std::move(met));
  json.set("whole", curve.down.kind == orbit::CurveEnd::Kind::range && curve.up.kind == orbit::CurveEnd::Kind::range);
  return json.set("ended", sentence(curve, system_));
}

}  // namespace slapstick::web
