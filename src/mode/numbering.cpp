/// Numbers the contacts of a model, the nearest of each pair first.
#include "mode/numbering.hpp"

#include <algorithm>
#include <cmath>

#include "base/dense.hpp"
#include "base/ranges.hpp"
#include "mode/assembly.hpp"

namespace slapstick::mode {
namespace {

using Numbers = std::vector<Number>;

/// The number sign * (row . q - shift, row . q' - drift): one that is there already, or a new one.
ContactRow find_or_add(Numbers& all, const Number& wanted) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double sign = same_direction(all[i].row, wanted.row);
    if (sign != 0.0 && all[i].shift == sign * wanted.shift && all[i].drift == sign * wanted.drift)
      return {static_cast<int>(i), sign};
  }
  all.push_back(wanted);
  return {static_cast<int>(all.size()) - 1, 1.0};
}

/// A friction contact, or a slider, shares the velocity of any displacement of its pair, whatever its shift.
ContactRow find_or_add_velocity(Numbers& all, const RowVector& row, double drift) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double sign = same_direction(all[i].row, row);
    if (sign != 0.0 && all[i].drift == sign * drift) return {static_cast<int>(i), sign};
  }
  return find_or_add(all, {row, 0.0, drift});
}

/// What a shift or a drift in the basis may cost the motion: ten bits, which are 1e-13 of its size.
constexpr double allowed = 0x1p10;
/// How much farther the basis may be than another contact of the pair. A contact state has the numbers of the basis
/// only. At a contact of clearance c that shift leaves the displacement c with the rounding of twice c, so that the
/// contact is found closed again (Frame::enter: four roundings). At c = 0 the displacement is exact by any shift.
constexpr double found_again = 2.0;

/// Is a before b, which the file has first: at rest rather than on a belt, or so much nearer that b would lose it, or
/// cost digits?
/// @param length  to which the forces move the masses
bool nearer(const Number& a, const Number& b, double length) {
  const double drift = std::abs(a.drift) - std::abs(b.drift), near = std::abs(a.shift), first = std::abs(b.shift);
  if (drift != 0.0) return drift < 0.0;
  return (near > 0.0 && found_again * near < first) || allowed * std::max(near, length) < first;
}

/// Numbers of one pair, by their indices: the first contact's, and the nearest.
struct Pair {
  int first, nearest;
  bool plain = false;  ///< the nearest is far: row . q itself carries the motion
};

std::vector<Pair> pairs_of(const Numbers& all, double length) {
  std::vector<Pair> pairs;
  for (int i = 0; i < static_cast<int>(all.size()); ++i) {
    const auto same = [&](const Pair& pair) { return same_direction(all[pair.first].row, all[i].row) != 0; };
    const auto known = ranges::find_if(pairs, same);
    if (known == pairs.end())
      pairs.push_back({i, i});
    else if (nearer(all[i], all[known->nearest], length))
      known->nearest = i;
  }
  return pairs;
}

/// The least of both that is not 0.
double least_of(double a, double b) { return a == 0.0 ? b : b == 0.0 ? a : std::min(a, b); }

double least_of(const Vector& sizes) {
  double least = 0.0;
  for (const double size : sizes) least = least_of(least, size);
  return least;
}

/// Of a signal its largest value, or slope; 1 of what is no signal. A step has no slope.
double largest_factor(const Model& model, const Force& force) {
  if (force.signal < 0) return 1.0;
  const Signal& signal = model.signals[static_cast<std::size_t>(force.signal)];
  const std::vector<Signal::Knot>& knots = signal.knots;
  const double unit = signal.in_periods ? model.forcing_period() : 1.0;
  double largest = force.rate ? 0.0 : std::abs(knots.front().value);
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const double apart = unit * (knots[i].time - knots[i - 1].time), rise = knots[i].value - knots[i - 1].value;
    largest = std::max(largest, std::abs(!force.rate ? knots[i].value : apart > 0.0 ? rise / apart : 0.0));
  }
  return largest;
}

/// What the nearest contacts of the other pairs add to the extent of the forces: a length, a speed of a belt.
Extent extent_around(const Numbers& all, const std::vector<Pair>& pairs, std::size_t but, Extent forces) {
  Extent others;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (k == but) continue;
    others.length = least_of(others.length, std::abs(all[pairs[k].nearest].shift));
    others.speed = least_of(others.speed, std::abs(all[pairs[k].nearest].drift));
  }
  return {std::max(forces.length, others.length), std::max(forces.speed, others.speed)};
}

/// Would this number cost the motion more than it may? One number more costs time only.
/// Where nothing else in the model gives a length (a speed), the number's own is the model's.
bool far(const Number& number, Extent extent) {
  const auto beyond = [](double size, double own) { return own > 0.0 && std::abs(size) > allowed * own; };
  return beyond(number.shift, extent.length) || beyond(number.drift, extent.speed);
}

class Order {
 public:
  explicit Order(int n) : basis_(0, n) {}

  /// False if the row follows from those that are there.
  bool extend(const RowVector& row) {
    Matrix trial(basis_.rows() + 1, basis_.cols());
    trial << basis_, row;
    if (dense::rank(trial) < trial.rows()) return false;
    basis_ = trial;
    return true;
  }
  void put(int number) { places_.push_back(number); }
  [[nodiscard]] bool full() const { return basis_.rows() == basis_.cols(); }
  [[nodiscard]] bool has(int number) const { return ranges::find(places_, number) != places_.end(); }
  [[nodiscard]] const std::vector<int>& places() const { return places_; }

 private:
  Matrix basis_;
  std::vector<int> places_;  ///< indices of numbers
};

/// The pairs that are independent of the ones before, each by its nearest number or by row . q; unit rows complete
/// them, from the last coordinate on; then what follows from these.
std::vector<int> basis_first(Numbers& all, const std::vector<Pair>& pairs, int n) {
  Order order(n);
  const Numbers contacts = all;
  for (const Pair& pair : pairs) {
    if (!order.extend(contacts[pair.first].row)) continue;
    order.put(pair.plain ? static_cast<int>(all.size()) : pair.nearest);
    if (pair.plain) all.push_back({contacts[pair.first].row});
  }
  for (int i = n - 1; i >= 0 && !order.full(); --i) {
    const RowVector unit = RowVector::Unit(n, i);
    if (!order.extend(unit)) continue;
    order.put(static_cast<int>(all.size()));
    all.push_back({unit});
  }
  for (int i = 0; i < static_cast<int>(contacts.size()); ++i)
    if (!order.has(i)) order.put(i);
  return order.places();
}

/// Gives the nearest number of each pair the row of the first.
void turn_nearest(Numbers& all, const std::vector<Pair>& pairs, const std::vector<std::vector<ContactRow>*>& contacts) {
  for (const Pair& pair : pairs) {
    Number& nearest = all[pair.nearest];
    if (nearest.row == all[pair.first].row) continue;
    nearest = {-nearest.row, 0.0 - nearest.shift, 0.0 - nearest.drift};
    for (std::vector<ContactRow>* rows : contacts)
      for (ContactRow& contact : *rows)
        if (contact.own == pair.nearest) contact.sign = -contact.sign;
  }
}

/// A contact with no stop of its own, by the nearest number of its pair if that has the same rate.
ContactRow with_nearest(const Numbers& all, const std::vector<Pair>& pairs, ContactRow contact) {
  for (const Pair& pair : pairs) {
    const double sign = same_direction(all[pair.nearest].row, all[contact.own].row);
    if (sign != 0.0 && all[pair.nearest].drift == sign * all[contact.own].drift)
      contact = {pair.nearest, sign * contact.sign};
  }
  return contact;
}

}  // namespace

int same_direction(const RowVector& a, const RowVector& b) {
  if (a == b) return 1;
  return a == -b ? -1 : 0;
}

namespace {

/// By which number the pairs are numbered: as the model says, or by the nearest.
void choose(const Model& model, Extent forces, const Numbers& all, const std::vector<ContactRow>& contacts,
            std::vector<Pair>& pairs) {
  const bool given = !pairs.empty() && model.numbered_by.size() == pairs.size();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    pairs[k].plain =
        given ? model.numbered_by[k] < 0 : far(all[pairs[k].nearest], extent_around(all, pairs, k, forces));
    if (given && !pairs[k].plain) pairs[k].nearest = contacts[model.numbered_by[k]].own;
  }
}

}  // namespace

Numbering::Numbering(const Model& model) {
  const int n = model.size();
  Numbers all;
  for (const Stop& stop : model.stops) stops.push_back(find_or_add(all, {pair_row(n, stop), stop.clearance}));
  for (const CompliantStop& stop : model.compliant_stops)
    compliant.push_back(find_or_add(all, {pair_row(n, stop), stop.clearance}));
  for (const FrictionContact& contact : model.frictions)
    frictions.push_back(find_or_add_velocity(all, pair_row(n, contact), contact.belt_speed));
  for (const Characteristic& one_of : model.characteristics)
    if (one_of.inner >= 0) sliders.push_back(find_or_add_velocity(all, outer_row(n, one_of), 0.0));
  const Extent forces = extent_of_forces(model);
  std::vector<Pair> pairs = pairs_of(all, forces.length);
  const auto contacts = [&] {
    std::vector<ContactRow> rows = stops;
    rows.insert(rows.end(), compliant.begin(), compliant.end());
    rows.insert(rows.end(), frictions.begin(), frictions.end());
    rows.insert(rows.end(), sliders.begin(), sliders.end());
    return rows;
  };
  choose(model, forces, all, contacts(), pairs);
  for (std::vector<ContactRow>* rows : {&frictions, &sliders})  // one at rest shares the velocity of the nearest stop
    for (ContactRow& contact : *rows) contact = with_nearest(all, pairs, contact);
  turn_nearest(all, pairs, {&stops, &compliant, &frictions, &sliders});
  const std::vector<ContactRow> rows_of = contacts();
  for (const Pair& pair : pairs) {
    const auto owner = ranges::find(rows_of, pair.nearest, &ContactRow::own);
    chosen.push_back(pair.plain ? -1 : static_cast<int>(owner - rows_of.begin()));
  }
  const std::vector<int> order = basis_first(all, pairs, n);
  std::vector<int> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    numbers.push_back(all[order[i]]);
    place[order[i]] = static_cast<int>(i);
  }
  for (std::vector<ContactRow>* rows : {&stops, &compliant, &frictions, &sliders})
    for (ContactRow& contact : *rows) contact.own = place[contact.own];
}

Extent extent_of_forces(const Model& model) {
  double F = 0.0, slowest = model.omega, fastest = model.omega;
  for (const Force& force : model.forces) {
    F = std::max(F, std::abs(force.amplitude) * largest_factor(model, force));
    slowest = least_of(slowest, force.frequency);
    fastest = std::max(fastest, force.frequency);
  }
  for (const FrictionContact& contact : model.frictions)
    F = std::max(F, contact.static_friction * (contact.normal ? std::abs(contact.normal->constant) : 1.0));
  const Vector k = stiffness_matrix(model).diagonal().cwiseAbs();
  const double mass = least_of(mass_matrix(model).diagonal()), stiffness = least_of(k);
  Extent extent;
  if (stiffness > 0.0) extent.length = F / stiffness;
  if (slowest > 0.0) extent.length = std::max(extent.length, F / (mass * slowest * slowest));
  extent.speed = extent.length * std::max(fastest, std::sqrt(k.maxCoeff() / mass));
  return extent;
}

Family numbered_alike(Family family, const std::vector<double>& values) {
  const std::vector<int> chosen = Numbering(family.model(values)).chosen;
  family.model = [model = family.model, chosen](const std::vector<double>& at) {
    Model made = model(at);
    made.numbered_by = chosen;
    return made;
  };
  return family;
}

}  // namespace slapstick::mode
