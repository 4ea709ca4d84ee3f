#include "property/machine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "slapstick/base/error.hpp"

namespace slapstick::test {
namespace {

class Draw {
 public:
  Draw(std::uint64_t seed, const Shape& shape) : random_(seed), shape_(shape) {}

  Machine machine(std::uint64_t seed) {
    Machine m;
    m.seed = seed;
    m.model.name = "machine";
    bodies(m.model);
    forcing(m.model);
    start(m);
    contacts(m);
    if (shape_.laws) laws(m);
    return m;
  }

 private:
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool one_in(int n) { return integer(1, n) == 1; }
  double decades(double low, double high) { return std::pow(10.0, real(low, high)); }

  void bodies(Model& m) {
    const int n = integer(shape_.least_coordinates, shape_.most_coordinates);
    for (int i = 0; i < n; ++i) {
      const int neighbour = i == 0 || one_in(3) ? ground : i - 1;
      m.coordinates.push_back({"x" + std::to_string(i + 1), decades(-0.7, 0.7)});
      if (i == 0 || !one_in(5)) m.springs.push_back({i, neighbour, decades(-0.5, 0.7)});
      if (!one_in(3)) m.dampers.push_back({i, one_in(2) ? ground : neighbour, decades(-2, 0)});
      if (one_in(2)) m.springs.push_back({i, i == 0 || one_in(2) ? ground : i - 1, real(0.1, 2)});
    }
  }

  void forcing(Model& m) {
    const int last = m.size() - 1;
    m.omega = real(0.3, 4);
    m.forces = {{integer(0, last), 1, real(0.5, 2), real(0, 6)}};
    if (one_in(2)) m.forces.push_back({integer(0, last), integer(1, 3), real(0, 1), real(0, 6)});
    if (one_in(3)) m.forces.push_back({integer(0, last), 0, real(-1, 1), 0.0});
  }

  void start(Machine& m) {
    m.start.assign(2 * m.model.coordinates.size(), 0.0);
    if (shape_.at_rest && one_in(4)) return;
    for (double& x : m.start) x = real(-1, 1);
  }

  /// Contacts are placed around the start, so that it is one. One alone of a kind is there more often than not.
  void contacts(Machine& m) {
    const auto count = [&](int most) { return most == 1 ? (one_in(4) ? 0 : 1) : integer(0, most); };
    int stops = 0, frictions = 0, compliant = 0;
    while (stops + frictions + compliant == 0)
      stops = count(shape_.most_stops), frictions = count(shape_.most_frictions),
      compliant = count(shape_.most_compliant);
    const double r = restitution();
    for (int k = 0; k < stops; ++k) stop(m, stops, shape_.one_restitution ? r : restitution());
    for (int k = 0; k < frictions; ++k) friction(m.model);
    for (int k = 0; k < compliant; ++k) compliant_stop(m);
    m.model.impact_law = shape_.sequence && one_in(2) ? ImpactLaw::sequence : ImpactLaw::moreau;
  }

  /// One in three is that of an earlier contact, in either direction.
  std::pair<int, int> pair(const Model& m) {
    int a = integer(0, m.size() - 1), b = integer(-1, m.size() - 1);
    if (a == b) b = ground;
    if (!m.stops.empty() && one_in(3)) a = m.stops.back().a, b = m.stops.back().b;
    if (one_in(2)) std::swap(a, b);
    return {a, b};
  }

  double restitution() {
    constexpr std::array values{0.0, 0.3, 0.5, 0.8, 0.95, 1.0};
    return std::min(one_in(2) ? values[integer(0, 5)] : real(0, 1), shape_.most_restitution);
  }

  static double between(const State& s, int a, int b) {
    const auto at = [&](int i) { return i == ground ? 0.0 : s[2 * static_cast<std::size_t>(i)]; };
    return at(a) - at(b);
  }

  static std::string numbered(const char* word, std::size_t before) {
    return before == 0 ? word : word + std::to_string(before + 1);
  }

  void stop(Machine& m, int most, double r) {
    auto& all = m.model.stops;
    if (static_cast<int>(all.size()) >= most) return;
    const std::pair ends = pair(m.model);
    const auto [a, b] = ends;
    const double y = between(m.start, a, b);
    const double gap = shape_.least_gap == 0.0 && one_in(6) ? 0.0 : real(shape_.least_gap, 0.8);
    if (std::ranges::any_of(all,
                            [&](const Stop& s) { return std::pair(s.a, s.b) == ends || std::pair(s.b, s.a) == ends; }))
      return;  // one side of a pair has one stop: see the other side below
    all.push_back({numbered("stop", all.size()), a, b, y + gap, r});
    if (static_cast<int>(all.size()) < most && one_in(3))
      all.push_back({numbered("stop", all.size()), b, a, -y + real(shape_.least_gap + 0.1, 0.8), r});
  }

  void friction(Model& m) {
    const auto [a, b] = pair(m);
    const double f_s = real(0.05, 0.8), f_k = one_in(2) || shape_.one_friction ? f_s : f_s * real(0, 1);
    const double belt = one_in(3) && !shape_.one_friction ? real(-0.4, 0.4) : 0.0;
    m.frictions.push_back({numbered("friction", m.frictions.size()), a, b, belt, f_s, f_k});
  }

  void compliant_stop(Machine& m) {
    const auto [a, b] = pair(m.model);
    auto& all = m.model.compliant_stops;
    const double clearance = between(m.start, a, b) + real(-0.1, 0.4);
    all.push_back({numbered("compliant", all.size()), a, b, clearance, decades(0, 1.3), real(0, 0.5), one_in(2)});
  }

  /// Every law in about every second machine, together with what the machine has already.
  void laws(Machine& m) {
    for (int k = integer(0, 2); k > 0; --k) characteristic(m);
    for (FrictionContact& f : m.model.frictions)
      if (one_in(2)) f.normal = normal_force(m.model);
    for (CompliantStop& c : m.model.compliant_stops) c.bounded = !c.pulls && one_in(2);
    for (Stop& s : m.model.stops)
      if (one_in(2)) s.corners = {{real(0.1, 0.5), s.restitution}, {real(0.6, 2), s.restitution * real(0.3, 1)}};
  }

  void characteristic(Machine& m) {
    const auto [a, b] = pair(m.model);
    const auto over = static_cast<Characteristic::Over>(integer(0, 2));
    auto& all = m.model.characteristics;
    all.push_back({numbered("bent", all.size()), a, b, over, {}, real(0, 0.4), real(0, 0.4)});
    double at = over == Characteristic::Over::velocity ? real(-1, 0) : between(m.start, a, b) + real(-0.6, 0);
    for (int k = integer(1, 3); k > 0; --k, at += real(0.2, 0.6)) {
      const double size = over == Characteristic::Over::velocity ? 0.3 : 0.8;
      all.back().corners.push_back({at, over == Characteristic::Over::zones ? real(0, 0.6) : real(-size, size)});
    }
  }

  NormalForce normal_force(const Model& m) {
    NormalForce normal{real(-0.2, 1.5), {{integer(0, m.size() - 1), real(-0.4, 0.4), real(-0.1, 0.1)}}, -1};
    if (!m.compliant_stops.empty() && one_in(2))
      normal.compliant_stop = integer(0, static_cast<int>(m.compliant_stops.size()) - 1);
    if (normal.compliant_stop >= 0 && one_in(2)) normal.terms.clear(), normal.constant = 0.0;
    return normal;
  }

  std::mt19937_64 random_;
  const Shape& shape_;
};

/// Do pairs of contacts, each counted once, close a loop of coordinates and ground?
bool has_loops(const Model& m) {
  std::vector<std::pair<int, int>> pairs;
  const auto add = [&](const auto& contacts) {
    for (const auto& c : contacts) pairs.emplace_back(std::min(c.a, c.b), std::max(c.a, c.b));
  };
  add(m.stops), add(m.frictions), add(m.compliant_stops);
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<int> group(m.coordinates.size() + 1);
  std::iota(group.begin(), group.end(), 0);
  for (const auto& [a, b] : pairs) {
    const int from = group[static_cast<std::size_t>(a + 1)], to = group[static_cast<std::size_t>(b + 1)];
    if (from == to) return true;
    std::ranges::replace(group, from, to);
  }
  return false;
}

}  // namespace

Machine random_machine(std::uint64_t seed, const Shape& shape) {
  Draw draw(seed, shape);
  for (;;) {
    Machine machine = draw.machine(seed);
    if (shape.loops || !has_loops(machine.model)) return machine;
  }
}

bool is_of(const Shape& shape, const Machine& machine) {
  const Model& m = machine.model;
  if (m.stops.size() + m.frictions.size() + m.compliant_stops.size() == 0) return false;
  if (m.size() < shape.least_coordinates || (!shape.loops && has_loops(m))) return false;
  for (const Stop& s : m.stops) {
    const auto at = [&](int i) { return i == ground ? 0.0 : machine.start[2 * static_cast<std::size_t>(i)]; };
    if (s.clearance - (at(s.a) - at(s.b)) < shape.least_gap) return false;
    if (s.restitution > shape.most_restitution) return false;
    if (shape.one_restitution && s.restitution != m.stops[0].restitution) return false;
  }
  if (std::ranges::any_of(m.frictions, [](const FrictionContact& f) { return f.static_friction == 0.0; }))
    return false;  // without friction both directions of slip are one motion
  for (const FrictionContact& f : m.frictions)
    if (shape.one_friction && (f.static_friction != f.kinetic_friction || f.belt_speed != 0.0)) return false;
  try {
    validate(m);
    validate(m, machine.start);
  } catch (const InputError&) {
    return false;
  }
  return true;
}

rc::Gen<Machine> machines(const Shape& shape) {
  return rc::Gen<Machine>([shape](const rc::Random& random, int) {
    rc::Random stream = random;
    return rc::shrinkable::shrinkRecur(random_machine(stream.next(), shape), [shape](const Machine& machine) {
      return rc::seq::fromContainer(simpler(machine, shape));
    });
  });
}

}  // namespace slapstick::test
