/// The impacts of one instant, by the model's law, and their end where they would go on for ever.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/ranges.hpp"
#include "flow/engine.hpp"
#include "flow/impact_law.hpp"
#include "flow/mode_graph.hpp"

namespace slapstick::flow {
namespace {

/// Impacts at one instant are ended together once they are this much slower than the fastest of the instant, or more
/// than this many. Flights that the clock cannot tell may lie between them.
constexpr double slow_impacts = 0x1p-46;
constexpr long most_impacts_at_one_instant = 10'000;

}  // namespace

std::span<const int> Engine::touching() {
  touching_.clear();
  for (int s = 0; s < stops(); ++s) {
    if (gap(*system_, s, X_.data()) == 0.0) touching_.push_back(s);
  }
  return touching_;
}

/// The first stop in contact that is approaching, or -1.
int Engine::approaching() const {
  for (int s = 0; s < stops(); ++s) {
    if (gap(*system_, s, X_.data()) == 0.0 && approach_velocity(*system_, s, X_.data()) > 0.0) return s;
  }
  return -1;
}

/// All impacts of this instant, by the model's law, until no stop in contact is approaching: the end of a pile-up may
/// leave others that do.
void Engine::strike_all() {
  std::uint32_t struck = 0;
  bool piled_up = false;
  for (int stop = approaching(); stop >= 0; stop = approaching()) {
    const double speed = approach_velocity(*system_, stop, X_.data());
    at_instant_.fastest = std::max(at_instant_.fastest, speed);
    if (speed < slow_impacts * at_instant_.fastest || at_instant_.events > most_impacts_at_one_instant) {
      end_pile_up();
      piled_up = true;
      continue;
    }
    if (piles_up_again(stop)) {
      piled_up = true;
      continue;
    }
    if (touching().size() == 1 || system_->model().impact_law == ImpactLaw::sequence)
      newton(stop);
    else
      moreau(touching_);
    struck |= strikes_.back().stops;
    at_instant_.struck |= strikes_.back().stops;
    at_instant_.pile_ups.strike(strikes_.back().stops);
  }
  bouncing_.clear();
  for (int s = 0; s < stops() && !piled_up; ++s)
    if ((struck >> s & 1U) != 0 && system_->model().stops[s].restitution > 0.0) bouncing_.push_back(s);
}

/// Stops that chatter against each other, where no proof of completeness is at hand, are brought to rest once their
/// impacts at one instant have become slow: those that still approach, and all slow ones that were struck or touch and
/// act on these. The forces then decide which of them stay closed.
void Engine::end_pile_up() {
  const mode::Frame& frame = system_->frame();
  const auto candidate = [&](int s) {
    const bool slow =
        std::abs(approach_velocity(*system_, s, X_.data())) <= std::sqrt(slow_impacts) * at_instant_.fastest;
    return slow && ((at_instant_.struck >> s & 1U) != 0 || gap(*system_, s, X_.data()) == 0.0);
  };
  touching_.assign(1, approaching());
  for (std::size_t k = 0; k < touching_.size(); ++k) {
    for (int s = 0; s < stops(); ++s) {
      const bool acts = frame.mass_inverse(frame.stops[touching_[k]].own, frame.stops[s].own) != 0.0;
      if (acts && candidate(s) && ranges::find(touching_, s) == touching_.end()) touching_.push_back(s);
    }
  }
  if (ranges::all_of(touching_, [&](int s) { return system_->model().stops[s].restitution == 1.0; }))
    fail("impacts without loss follow each other without end at one instant");
  ranges::sort(touching_);
  for (int s : touching_) set_gap_zero(frame.stops[s]);
  bring_together(touching_);
  report(EventKind::chatter, touching_.front(), 0.0);
  pending_.back().error = 0x1p-53 * system_->period();
}

/// Stops come to rest: the end of a pile-up.
void Engine::bring_together(std::span<const int> stops) {
  bring_to_rest(*system_, stops, X_.data());
  strikes_.push_back({0, true});
  for (int s : stops) strikes_.back().stops |= std::uint32_t{1} << s;
  const bool scales = ranges::all_of(stops, [&](int s) { return system_->model().stops[s].corners.empty(); });
  at_instant_.pile_ups.rest(strikes_.back().stops, scales);
  ++counters_.pile_ups;
}

/// What has come to rest at this instant after such a blow does so again, in no time: no events of their own.
bool Engine::piles_up_again(int stop) {
  const std::uint32_t set = at_instant_.pile_ups.known(stop);
  if (set == 0) return false;
  touching_.clear();
  for (int s = 0; s < stops(); ++s)
    if ((set >> s & 1U) != 0) touching_.push_back(s);
  bring_together(touching_);
  spend_budget();
  return true;
}

void Engine::newton(int stop) {
  const double w = approach_velocity(*system_, stop, X_.data());
  report(EventKind::impact, stop, w);
  strike(*system_, stop, rebound(system_->model().stops[stop], w).restitution, X_.data());
  ++counters_.impacts;
  strikes_.push_back({std::uint32_t{1} << stop});
}

void Engine::moreau(std::span<const int> stops) {
  std::array<bool, System::most_contacts> hit{};
  std::array<double, System::most_contacts> w{};
  X_next_ = X_;  // as it is before the impacts
  for (std::size_t i = 0; i < stops.size(); ++i) w[i] = approach_velocity(*system_, stops[i], X_.data());
  if (!strike_together(*system_, stops, X_.data(), std::span(hit).first(stops.size())))
    fail("the impacts of this instant have no solution");
  strikes_.push_back({});
  for (std::size_t i = 0; i < stops.size(); ++i) {
    if (hit[i]) strikes_.back().stops |= std::uint32_t{1} << stops[i];
    if (!hit[i] || w[i] <= 0.0) continue;  // one that was at rest transmits an impulse
    ++counters_.impacts;
    report(EventKind::impact, stops[i], w[i], X_next_);
  }
}

}  // namespace slapstick::flow
