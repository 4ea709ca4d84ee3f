/// Finds a cycle in which sliders rest that hardly slip, by a machine whose limits these sliders do not reach.
#include "section/at_limits.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "flow/contact_state.hpp"
#include "flow/engine.hpp"
#include "section/attraction.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/stage.hpp"

namespace slapstick::section {
namespace {

using Eigen::VectorXd;
using Sliders = std::vector<mode::SliderRow>;

const Sliders& sliders_of(const System& system) { return system.compiled().frame().sliders; }

double between(const mode::SliderRow& slider) { return slider.high - slider.low; }

/// Of a slider in a cycle: from its start to the end, and from its least to its greatest value.
struct Way {
  double moved = 0.0, width = 0.0;
};

std::vector<Way> ways(const System& system, const VectorXd& x, double duration, Stop stop) {
  const Sliders& sliders = sliders_of(system);
  Motion motion(system, flow::user_state(system, x));
  const auto at = [&](std::size_t i) { return motion.engine().extended()[static_cast<std::size_t>(sliders[i].own)]; };
  std::vector<Way> all(sliders.size());
  std::vector<double> start, least, greatest;
  for (std::size_t i = 0; i < sliders.size(); ++i) start.push_back(at(i));
  least = greatest = start;
  const Instant end = Instant{}.plus(duration);
  for (bool goes_on = true; goes_on && !stopped(stop);) {
    goes_on = motion.advance(end) == Outcome::event;
    for (std::size_t i = 0; i < sliders.size(); ++i) {
      least[i] = std::min(least[i], at(i));
      greatest[i] = std::max(greatest[i], at(i));
      all[i] = {at(i) - start[i], greatest[i] - least[i]};
    }
  }
  return all;
}

/// Does it slip one way, and hardly? To both sides a slider slips in each cycle. Newton's method leaves 1e-11 of a
/// place; a real slip as short as this is taken for a touch.
bool touches(const mode::SliderRow& slider, const Way& way) {
  constexpr double hardly = 1e-9;  // of the way between the limits
  return std::abs(way.moved) > 0.5 * way.width && way.width <= hardly * between(slider);
}

/// The machine with the limits of some sliders a little farther apart: those do not slip.
System raised(const System& system, const std::vector<std::size_t>& some) {
  constexpr double farther = 1.0 + 0x1p-10;  // the cycle is the same for any that is farther than the slips
  Model model = system.model();
  for (const std::size_t i : some) {
    auto& corners = model.characteristics[static_cast<std::size_t>(sliders_of(system)[i].characteristic)].corners;
    for (Characteristic::Corner& corner : corners) corner = {corner.at * farther, corner.force * farther};
  }
  return System(model);
}

}  // namespace

std::optional<VectorXd> clear_of_limits(const ReturnMap& map, const VectorXd& x, int n, const VectorXd& scale,
                                        Stop stop) {
  constexpr double first = 1e-11, last = 1e-6, farther = 4.0;  // of the way between the limits
  const System& system = map.translations().system();
  const Sliders& sliders = sliders_of(system);
  if (sliders.empty()) return std::nullopt;
  try {
    const double duration = map.value(x, n, stop).duration;
    const std::vector<Way> seen = ways(system, x, duration, stop);
    std::vector<std::size_t> some;
    for (std::size_t i = 0; i < sliders.size(); ++i)
      if (touches(sliders[i], seen[i])) some.push_back(i);
    const auto resting = some.empty() ? nullptr : map.of(raised(system, some));
    if (!resting) return std::nullopt;
    bool clear = false;  // the first that is clear may be so by rounding: the next is taken
    for (double on = first; on < last && !stopped(stop); on *= farther) {
      VectorXd there = x;
      for (const std::size_t i : some)
        there[sliders[i].own] += seen[i].moved + std::copysign(on * between(sliders[i]), seen[i].moved);
      there = nearest_fixed_point(*resting, there, n, scale, stop);
      if (clear) return there;
      const std::vector<Way> left = ways(system, there, duration, stop);
      clear = std::all_of(some.begin(), some.end(), [&](std::size_t i) { return left[i].width == 0.0; });
    }
  } catch (const InputError&) {
  } catch (const NumericalError&) {
  }
  return std::nullopt;
}

}  // namespace slapstick::section
