/// Builds the equations of motion of a model in contact coordinates.
#include "mechanics.hpp"

#include <algorithm>
#include <cmath>

#include "bodies.hpp"
#include "mode_builder.hpp"

namespace verify {

namespace {

double same_pair(const Pair& a, const Pair& b) {
  if (a.a == b.a && a.b == b.b) return 1.0;
  return a.a == b.b && a.b == b.a ? -1.0 : 0.0;
}

bool has_contact(const Model& model, const Pair& pair) {
  const auto on_pair = [&](const auto& contact) { return same_pair(contact.pair, pair) != 0.0; };
  return std::any_of(model.stops.begin(), model.stops.end(), on_pair) ||
         std::any_of(model.compliant.begin(), model.compliant.end(), on_pair) ||
         std::any_of(model.frictions.begin(), model.frictions.end(), on_pair);
}

/// A number is of a contact, with its constants, or of a pair alone, without any. Any other could only hide what
/// coordinates do: rounding is measured by the sizes of numbers.
bool is_needed(const Model& model, const Number& number) {
  const auto is = [&](const Pair& pair, double shift, double drift) {
    const double sign = same_pair(number.pair, pair);
    return sign != 0.0 && number.shift == sign * shift && number.drift == sign * drift;
  };
  const auto is_gap = [&](const auto& stop) { return is(stop.pair, stop.clearance, 0.0); };
  if (number.shift == 0.0 && number.drift == 0.0 && (number.pair.b == ground || has_contact(model, number.pair)))
    return true;
  return std::any_of(model.stops.begin(), model.stops.end(), is_gap) ||
         std::any_of(model.compliant.begin(), model.compliant.end(), is_gap) ||
         std::any_of(model.frictions.begin(), model.frictions.end(),
                     [&](const Friction& friction) { return is(friction.pair, 0.0, friction.belt_speed); });
}

template <class T>
void keep_each_once(std::vector<T>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

std::string words_of(const Number& number) {
  return std::to_string(number.pair.a) + " " + std::to_string(number.pair.b);
}

}  // namespace

Mechanics::Mechanics(const Model& model, long line) : model_(model), line_(line), period_(1.0) {
  for (const Force& force : model.forces) {
    if (force.harmonic > 0) harmonics_.push_back(force.harmonic);
    if (force.frequency > 0.0) tones_.push_back(force.frequency);
  }
  keep_each_once(harmonics_);
  keep_each_once(tones_);
  constexpr std::size_t most_numbers = 2000;  // matrices of balls: 1 GB
  if (size() > most_numbers)
    throw Unreadable(line_,
                     "a state of the model has " + std::to_string(size()) +
                         " numbers (displacements, velocities, two for each frequency); the verifier takes at most " +
                         std::to_string(most_numbers));
  if (!harmonics_.empty()) period_ = times(Ball::pi(), 2) / Ball(model.omega);
  place_contacts();
  for (const Number& number : model.numbers)
    if (!is_needed(model, number))
      throw Unreadable(line_, "no contact and no coordinate has the number of " + words_of(number));
  invert();
  for (const bool velocity : {false, true}) find_loops(velocity);
  set_free();
}

double Mechanics::parallel(std::size_t i, std::size_t j) const {
  return same_pair(model_.numbers[i].pair, model_.numbers[j].pair);
}

/// The number of a contact: of its pair, with this shift (if it matters) and drift.
Place Mechanics::find(const Pair& pair, const double* shift, double drift, const std::string& name) const {
  for (std::size_t i = 0; i < d(); ++i) {
    const Number& number = model_.numbers[i];
    const double sign = same_pair(number.pair, pair);
    if (sign != 0.0 && (shift == nullptr || number.shift == sign * *shift) && number.drift == sign * drift)
      return {i, sign};
  }
  throw Unreadable(line_, "there is no number of contact " + name);
}

void Mechanics::place_contacts() {
  for (const Stop& stop : model_.stops) stops_.push_back(find(stop.pair, &stop.clearance, 0.0, stop.name));
  for (const Friction& friction : model_.frictions)
    frictions_.push_back(find(friction.pair, nullptr, friction.belt_speed, friction.name));
  for (const Compliant& stop : model_.compliant) compliant_.push_back(find(stop.pair, &stop.clearance, 0.0, stop.name));
}

Balls Mechanics::pair_row(const Pair& pair) const {
  Balls row(n());
  if (pair.a != ground) row[static_cast<std::size_t>(pair.a)] = Ball(1.0);
  if (pair.b != ground) row[static_cast<std::size_t>(pair.b)] = Ball(-1.0);
  return row;
}

Matrix Mechanics::matrix_of(const Table& table, const std::vector<Element>& elements) const {
  Matrix K = zero_matrix(n(), n());
  for (std::size_t i = 0; i < table.size(); ++i)
    for (std::size_t j = 0; j < n(); ++j) K[i][j] = Ball(table[i][j]);
  for (const Element& element : elements) {
    const Balls row = pair_row(element.pair);
    for (std::size_t i = 0; i < n(); ++i) add(K[i], Ball(element.coefficient) * row[i], row);
  }
  return K;
}

void Mechanics::invert() {
  Matrix M = matrix_of(model_.mass, {});
  for (std::size_t i = 0; i < n(); ++i) M[i][i] += Ball(model_.masses[i]);
  const auto inverse = inverse_definite(M);
  if (!inverse) throw Unreadable(line_, "the masses are not positive definite");
  mass_inverse_ = *inverse;
  for (const Number& number : model_.numbers) W_.push_back(pair_row(number.pair));
  for (const bool velocity : {false, true}) choose_basis(velocity);
  inertia_ = product(product(W_, mass_inverse_), transposed(W_));
}

/// The least shifts (drifts) first; of equal ones the first in the file. Greedy: no other n numbers are less in any
/// place.
void Mechanics::choose_basis(bool velocity) {
  std::vector<std::size_t> order(d());
  std::iota(order.begin(), order.end(), 0U);
  const auto size = [&](std::size_t i) {
    return std::abs(velocity ? model_.numbers[i].drift : model_.numbers[i].shift);
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return size(i) < size(j); });
  Bodies bodies(model_.n);
  std::vector<std::size_t>& basis = bases_[velocity ? 1 : 0];
  Matrix rows, one = zero_matrix(n(), n());
  for (const std::size_t i : order) {
    if (!bodies.join(model_.numbers[i].pair)) continue;
    basis.push_back(i);
    rows.push_back(W_[i]);
  }
  for (std::size_t i = 0; i < n(); ++i) one[i][i] = Ball(1.0);
  const auto inverse = basis.size() == n() ? solve(std::move(rows), std::move(one)) : std::nullopt;
  if (!inverse) throw Unreadable(line_, "the numbers do not tell where all coordinates are");
  W_inverse_[velocity ? 1 : 0] = *inverse;
  dependence_[velocity ? 1 : 0] = product(W_, *inverse);
}

bool Mechanics::in_basis(std::size_t number, bool velocity) const {
  const std::vector<std::size_t>& all = basis(velocity);
  return std::find(all.begin(), all.end(), number) != all.end();
}

/// A number that is not in the basis closes a loop of those that it follows from; loops with a number in common are
/// one.
void Mechanics::find_loops(bool velocity) {
  std::vector<std::size_t> of(d());
  for (std::size_t i = 0; i < d(); ++i) of[i] = i;
  for (std::size_t i = 0; i < d(); ++i)
    for (std::size_t j = 0; j < n(); ++j) {
      if (dependence(velocity)[i][j].is_zero()) continue;
      const std::size_t one = of[i], other = of[basis(velocity)[j]];
      for (std::size_t& k : of) k = k == other ? one : k;
    }
  auto& loops = loops_[velocity ? 1 : 0];
  loops.resize(d());
  for (std::size_t i = 0; i < d(); ++i)
    for (std::size_t j = 0; j < d(); ++j)
      if (i == j || (of[i] == of[j] && in_basis(j, velocity))) loops[i].push_back(j);
}

Balls Mechanics::in_coordinates(const Balls& X) const {
  Balls z;
  for (const bool velocity : {false, true}) {
    Balls numbers;
    for (const std::size_t j : basis(velocity)) {
      const Number& number = model_.numbers[j];
      numbers.push_back(X[(velocity ? d() : 0) + j] + Ball(velocity ? number.drift : number.shift));
    }
    for (const Balls& row : to_coordinates(velocity)) z.push_back(dot(row, numbers));
  }
  z.insert(z.end(), X.begin() + 2 * static_cast<std::ptrdiff_t>(d()), X.end());
  return z;
}

/// With X = T z: q'' = W^-1 (the rows of u' of the basis) T z.
Matrix Mechanics::in_coordinates(const Matrix& A) const {
  const std::size_t phases = size() - 2 * d(), m = 2 * n() + phases;
  Matrix T = zero_matrix(size(), m), of_z = zero_matrix(m, m);
  for (std::size_t j = 0; j < d(); ++j) {
    for (std::size_t i = 0; i < n(); ++i) T[j][i] = T[d() + j][n() + i] = W_[j][i];
    T[j].back() = Ball(-model_.numbers[j].shift);
    T[d() + j].back() = Ball(-model_.numbers[j].drift);
  }
  for (std::size_t k = 0; k < phases; ++k) T[2 * d() + k][2 * n() + k] = Ball(1.0);
  Matrix accelerations;
  for (const std::size_t j : basis(true)) accelerations.push_back(A[d() + j]);
  const Matrix rates = product(to_coordinates(true), product(accelerations, T));
  for (std::size_t i = 0; i < n(); ++i) {
    of_z[i][n() + i] = Ball(1.0);
    of_z[n() + i] = rates[i];
  }
  for (std::size_t k = 0; k < phases; ++k)
    for (std::size_t l = 0; l < phases; ++l) of_z[2 * n() + k][2 * n() + l] = A[2 * d() + k][2 * d() + l];
  return of_z;
}

/// A row over X of the displacement, or velocity, of a pair: q = W^-1 (p + shift), q' = W^-1 (u + drift).
Balls Mechanics::over_state(const Pair& pair, bool velocity) const {
  const Balls row = product({pair_row(pair)}, to_coordinates(velocity)).front();
  Balls over(size());
  for (std::size_t k = 0; k < n(); ++k) {
    const std::size_t j = basis(velocity)[k];
    const Number& number = model_.numbers[j];
    over[(velocity ? d() : 0) + j] = row[k];
    over.back().add_product(row[k], Ball(velocity ? number.drift : number.shift));
  }
  return over;
}

/// free = W M^-1 (F - C q' - K q), rows over X.
void Mechanics::set_free() {
  const Matrix K = matrix_of(model_.stiffness, model_.springs), C = matrix_of(model_.damping, model_.dampers);
  Matrix displacement, velocity;
  for (int i = 0; i < model_.n; ++i) {
    displacement.push_back(over_state({i, ground}, false));
    velocity.push_back(over_state({i, ground}, true));
  }
  Matrix load = zero_matrix(n(), size());
  for (std::size_t i = 0; i < n(); ++i)
    for (std::size_t j = 0; j < n(); ++j) {
      add(load[i], -K[i][j], displacement[j]);
      add(load[i], -C[i][j], velocity[j]);
    }
  for (const Force& force : model_.forces) {
    Balls& row = load[static_cast<std::size_t>(force.coordinate)];
    if (force.harmonic == 0 && force.frequency == 0.0) {
      row.back() += Ball(force.amplitude);
      continue;
    }
    // a sin(j theta + phase) = a sin(phase) cos(j theta) + a cos(phase) sin(j theta)
    const std::size_t cosine = cosine_of(force);
    Ball c, s;
    cos_sin(c, s, Ball(force.phase));
    row[cosine].add_product(Ball(force.amplitude), s);
    row[cosine + 1].add_product(Ball(force.amplitude), c);
  }
  free_ = product(W_, product(mass_inverse_, load));
}

/// The number of X that is cos(j theta), or cos(w t), of a force; the sine is the next.
std::size_t Mechanics::cosine_of(const Force& force) const {
  const auto place = [](const auto& numbers, auto number) {
    return static_cast<std::size_t>(std::find(numbers.begin(), numbers.end(), number) - numbers.begin());
  };
  const std::size_t k =
      force.harmonic > 0 ? place(harmonics_, force.harmonic) : harmonics_.size() + place(tones_, force.frequency);
  return 2 * d() + 2 * k;
}

Balls Mechanics::extended(const std::vector<double>& p, const std::vector<double>& u, const Clock& at) const {
  Balls X(p.begin(), p.end());
  X.insert(X.end(), u.begin(), u.end());
  for (const int j : harmonics_) {
    Ball c, s;
    cos_sin_pi(c, s, Ball(2.0 * j) * Ball(at.fraction));
    X.push_back(c);
    X.push_back(s);
  }
  const Ball t = (Ball(static_cast<double>(at.period)) + Ball(at.fraction)) * period_;
  for (const double frequency : tones_) {
    Ball c, s;
    cos_sin(c, s, Ball(frequency) * t);
    X.push_back(c);
    X.push_back(s);
  }
  X.emplace_back(1.0);
  return X;
}

Balls Mechanics::contact_numbers(const std::vector<double>& q, const std::vector<double>& v) const {
  Balls p, u;
  const Balls x(q.begin(), q.end()), rate(v.begin(), v.end());
  for (std::size_t i = 0; i < d(); ++i) {
    p.push_back(dot(W_[i], x) - Ball(model_.numbers[i].shift));
    u.push_back(dot(W_[i], rate) - Ball(model_.numbers[i].drift));
  }
  p.insert(p.end(), u.begin(), u.end());
  return p;
}

const Mode& Mechanics::mode(const ContactStates& states) {
  std::unique_ptr<Mode>& mode = modes_[states];
  if (!mode) mode = std::make_unique<Mode>(ModeBuilder(*this, states).build());
  return *mode;
}

}  // namespace verify
