/// Runs the model of a certificate again and compares the motions.
#include "retold.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <sstream>
#include <vector>

#include "certificate.hpp"
#include "slapstick/certify/certificate.hpp"

namespace campaign {
namespace {

using namespace slapstick;

/// Of states, in units of the greatest number of the run; of times, in periods. Errors grow along a motion.
constexpr double same = 1e-6;

/// Of speeds, in units of the greatest number, and of times, in periods: forgeries change claims by 2^-14 or more, and
/// the engine lists the last impacts of a chatter, or sums them, by what it can prove.
constexpr double nothing = 1e-6, no_time = 1e-7;

/// The engine lists a chatter that is cut near its limit bounce by bounce: so near to the end the end alone counts.
constexpr double near_end = 1e-6;

/// Segments between events: what was cut is one again, and what lasts no time is left out.
struct Told {
  verify::Model model;
  verify::Start start;
  verify::Done done;
  std::vector<verify::Segment> segments;
  /// what is said that no motion can have: an event that changes nothing, an impact without speed
  std::string impossible;
};

Told read(const std::string& text) {
  std::istringstream in(text);
  verify::Reader reader(in);
  Told told;
  bool cut = false;
  verify::Segment before;
  for (verify::Segment segment; reader.next(segment); before = segment) {
    const bool none = before.end == verify::EndKind::event && before.duration == 0.0 && before.blows.empty();
    if (none && segment.number > 0 && before.states == segment.states)
      told.impossible = "an event that changes nothing";
    for (const verify::Impact& impact : segment.impacts)
      if (!(impact.w > 0.0)) told.impossible = "an impact without speed";
    if (!cut || told.segments.empty()) {
      told.segments.push_back(segment);
    } else {
      verify::Segment& whole = told.segments.back();
      whole.duration += segment.duration;
      whole.end = segment.end;
      whole.blows = segment.blows;
      whole.impacts = segment.impacts;
    }
    cut = segment.end == verify::EndKind::cut;
  }
  told.model = reader.model();
  told.start = reader.start();
  told.done = reader.done();
  return told;
}

SymmetricMatrix flat(const verify::Table& table) {
  SymmetricMatrix all;
  for (const auto& row : table) all.insert(all.end(), row.begin(), row.end());
  return all;
}

Model model_of(const verify::Model& told) {
  Model model;
  model.name = "retold";
  for (std::size_t i = 0; i < told.masses.size(); ++i)
    model.coordinates.push_back({"x" + std::to_string(i + 1), told.masses[i]});
  for (const auto& [pair, k] : told.springs) model.springs.push_back({pair.a, pair.b, k});
  for (const auto& [pair, c] : told.dampers) model.dampers.push_back({pair.a, pair.b, c, c < 0.0});
  for (const verify::Force& f : told.forces)
    model.forces.push_back({f.coordinate, f.harmonic, f.amplitude, f.phase, f.frequency});
  int k = 0;
  const auto name = [&k](const char* of) { return of + std::to_string(k++); };
  for (const verify::Stop& s : told.stops) {
    model.stops.push_back({name("stop"), s.pair.a, s.pair.b, s.clearance, s.restitution});
    for (const auto& [speed, restitution] : s.corners) model.stops.back().corners.push_back({speed, restitution});
  }
  for (const verify::Friction& f : told.frictions) {
    model.frictions.push_back({name("friction"), f.pair.a, f.pair.b, f.belt_speed, f.static_limit, f.kinetic});
    if (!f.normal) continue;
    NormalForce& normal = model.frictions.back().normal.emplace();
    normal.constant = f.normal->constant;
    normal.compliant_stop = f.normal->compliant;
    for (const auto& [i, stiffness, damping] : f.normal->terms) normal.terms.push_back({i, stiffness, damping});
  }
  for (const verify::Compliant& s : told.compliant)
    model.compliant_stops.push_back({name("compliant"), s.pair.a, s.pair.b, s.clearance, s.stiffness, s.damping,
                                     s.law == verify::Compliant::Law::pulls, s.law == verify::Compliant::Law::bounded});
  for (const verify::Polyline& p : told.polylines) {
    constexpr std::array overs = {Characteristic::Over::displacement, Characteristic::Over::velocity,
                                  Characteristic::Over::zones};
    const auto over = overs[static_cast<std::size_t>(p.over)];
    model.characteristics.push_back({name("polyline"), p.pair.a, p.pair.b, over, {}, p.slope_below, p.slope_above});
    for (const auto& [at, force] : p.corners) model.characteristics.back().corners.push_back({at, force});
  }
  model.mass = flat(told.mass);
  model.damping = flat(told.damping);
  model.stiffness = flat(told.stiffness);
  model.impact_law = told.in_sequence ? ImpactLaw::sequence : ImpactLaw::moreau;
  model.omega = told.omega;
  return model;
}

std::string run_again(const Told& told) {
  State start;
  for (std::size_t i = 0; i < told.start.q.size(); ++i) {
    start.push_back(told.start.q[i]);
    start.push_back(told.start.v[i]);
  }
  std::string text;
  const System system(model_of(told.model));
  certify::Certificate again(system, start, [&](const std::string& lines) { text += lines; });
  again.run({told.done.at.period, told.done.at.fraction}, [](Instant) { return true; });
  again.finish();
  return text;
}

double apart(const verify::Clock& a, const verify::Clock& b) {
  return std::abs(static_cast<double>(a.period - b.period) + (a.fraction - b.fraction));
}

double scale_of(const Told& told) {
  double scale = 0.0;
  for (const verify::Segment& segment : told.segments)
    for (const auto* numbers : {&segment.p, &segment.u})
      for (const double x : *numbers) scale = std::max(scale, std::abs(x));
  return scale;
}

/// Positions (or velocities) of the coordinates from those of the numbers: the first n of these are a tree of pairs
/// that the ground is part of.
std::vector<double> coordinates(const verify::Model& model, const std::vector<double>& numbers, bool velocities) {
  const auto n = static_cast<std::size_t>(model.n);
  std::vector<double> x(n + 1, 0.0);  // the ground is the last
  std::vector<bool> known(n + 1, false);
  known[n] = true;
  const auto body = [n](int k) { return k == verify::ground ? n : static_cast<std::size_t>(k); };
  for (std::size_t round = 0; round < n; ++round)
    for (std::size_t i = 0; i < n; ++i) {
      const verify::Number& number = model.numbers[i];
      const std::size_t a = body(number.pair.a), b = body(number.pair.b);
      const double apart = numbers[i] + (velocities ? number.drift : number.shift);
      if (known[a] == known[b]) continue;
      known[a] ? x[b] = x[a] - apart : x[a] = x[b] + apart;
      known[a] = known[b] = true;
    }
  return x;
}

/// The greatest difference of two states.
template <class At>
double apart(const verify::Model& one, const At& a, const verify::Model& other, const At& b) {
  double most = 0.0;
  for (const bool velocities : {false, true}) {
    const auto x = coordinates(one, velocities ? a.u : a.p, velocities);
    const auto y = coordinates(other, velocities ? b.u : b.p, velocities);
    for (std::size_t i = 0; i < x.size(); ++i) most = std::max(most, std::abs(x[i] - y[i]));
  }
  return most;
}

/// The engine's runs start at phase 0: forces are later by the phase of the start.
void begin_at_zero(Told& told) {
  const verify::Clock from = told.start.at;
  const double turn = 2.0 * std::acos(-1.0), period = told.model.forced() ? turn / told.model.omega : 1.0;
  const double t = (static_cast<double>(from.period) + from.fraction) * period;
  for (verify::Force& force : told.model.forces)
    force.phase += force.harmonic * turn * from.fraction + force.frequency * t;
  const auto earlier = [from](verify::Clock& at) {
    at.period -= from.period;
    at.fraction -= from.fraction;
    if (at.fraction >= 0.0) return;
    at.fraction += 1.0;
    --at.period;
  };
  for (verify::Segment& segment : told.segments) earlier(segment.start);
  earlier(told.done.at);
}

void leave_out_nothing(Told& told, double scale) {
  while (told.segments.size() > 1 && apart(told.segments.back().start, told.done.at) < near_end)
    told.segments.pop_back();
  const double period = told.model.forced() ? 2.0 * std::acos(-1.0) / told.model.omega : 1.0;
  std::vector<verify::Segment> kept;
  for (const verify::Segment& segment : told.segments) {
    if (kept.empty() || segment.duration > no_time * period) {
      kept.push_back(segment);
    } else {
      kept.back().impacts.insert(kept.back().impacts.end(), segment.impacts.begin(), segment.impacts.end());
    }
  }
  for (verify::Segment& segment : kept) {
    const auto slow = [scale](const verify::Impact& impact) { return std::abs(impact.w) <= nothing * scale; };
    auto& impacts = segment.impacts;
    impacts.erase(std::remove_if(impacts.begin(), impacts.end(), slow), impacts.end());
  }
  told.segments = std::move(kept);
}

/// The number of a pair with a constant part: shift of a stop, drift of a friction contact.
std::size_t number_of(const Told& told, const verify::Pair& pair, double verify::Number::*part, double constant) {
  std::size_t own = 0;
  for (std::size_t i = 0; i < told.model.numbers.size(); ++i) {
    const verify::Number& number = told.model.numbers[i];
    const bool as_is = number.pair.a == pair.a && number.pair.b == pair.b && number.*part == constant;
    const bool turned = number.pair.a == pair.b && number.pair.b == pair.a && number.*part == -constant;
    if (as_is || turned) own = i;
  }
  return own;
}

/// A contact whose velocity stays zero may as well be called slipping: its force is the same. A stop at its gap on a
/// pair that friction holds may be called open or closed: how the two share the force makes no motion.
void call_rest_stick(Told& told) {
  const double still = 1e-12 * scale_of(told);
  const auto rests = [&](std::size_t i, std::size_t own) {
    const verify::Segment& now = told.segments[i];
    const bool last = i + 1 == told.segments.size();
    const auto &p = last ? told.done.p : told.segments[i + 1].p, &u = last ? told.done.u : told.segments[i + 1].u;
    const double moved = p[own] - now.p[own] - told.model.numbers[own].drift * now.duration;
    return now.u[own] == 0.0 && u[own] == 0.0 && std::abs(moved) <= still;  // not from rest to rest
  };
  const auto all_segments = [&](std::size_t own, const auto& call) {
    for (std::size_t i = 0; i < told.segments.size(); ++i)
      if (rests(i, own)) call(told.segments[i]);
  };
  for (std::size_t k = 0; k < told.model.frictions.size(); ++k) {
    const verify::Friction& friction = told.model.frictions[k];
    const std::size_t own = number_of(told, friction.pair, &verify::Number::drift, friction.belt_speed);
    all_segments(own, [&](verify::Segment& segment) { segment.states.slip[k] = 0; });
  }
  for (std::size_t k = 0; k < told.model.stops.size(); ++k) {
    const verify::Stop& stop = told.model.stops[k];
    const std::size_t own = number_of(told, stop.pair, &verify::Number::shift, stop.clearance);
    all_segments(own, [&](verify::Segment& segment) {
      if (segment.p[own] == 0.0) segment.states.closed[k] = true;
    });
  }
}

std::string compared(Told told, Told truth) {
  if (!told.impossible.empty()) return told.impossible;
  const double scale = scale_of(truth), allowed = same * scale;
  leave_out_nothing(told, scale);
  leave_out_nothing(truth, scale);
  call_rest_stick(told);
  call_rest_stick(truth);
  for (std::size_t i = 0; i < told.segments.size() && i < truth.segments.size(); ++i) {
    const verify::Segment &a = told.segments[i], &b = truth.segments[i];
    const std::string where = "segment " + std::to_string(i) + ": ";
    if (apart(a.start, b.start) > same) return where + "its instant";
    if (apart(told.model, a, truth.model, b) > allowed) return where + "its state";
    if (a.states != b.states) return where + "its contacts";
    const bool last = i + 1 == told.segments.size();  // a run that ends at an event may say so, or be cut there
    if (!last && a.end != b.end) return where + "its end";
    if (a.impacts.size() != b.impacts.size()) return where + "its impacts";
    for (std::size_t k = 0; k < a.impacts.size(); ++k)
      if (a.impacts[k].stop != b.impacts[k].stop || std::abs(a.impacts[k].w - b.impacts[k].w) > allowed)
        return where + "an impact";
  }
  if (told.segments.size() != truth.segments.size()) return "the number of events";
  return apart(told.model, told.done, truth.model, truth.done) > allowed ? "the end" : "";
}

}  // namespace

std::string told_otherwise(const std::string& certificate) {
  Told told = read(certificate);
  begin_at_zero(told);
  try {
    return compared(told, read(run_again(told)));
  } catch (const std::exception& error) {
    return std::string("no such motion: ") + error.what();
  }
}

}  // namespace campaign
