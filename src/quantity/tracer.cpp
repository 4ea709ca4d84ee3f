/// Cuts pieces of a motion into steps, and finds the impulses between them.
#include "quantity/tracer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slapstick::quantity {

namespace {

constexpr int degree = 23;

/// A row over X whose polynomial is needed.
struct Term {
  std::vector<std::pair<std::size_t, std::size_t>> products;  ///< of rows
  std::optional<std::size_t> linear;
};

/// Zero from the degree on.
void widen(int to, Polynomial& f) {
  while (f.degree < to) f.a[static_cast<std::size_t>(++f.degree)] = 0.0;
}

void add_product(const Polynomial& f, const Polynomial& g, Polynomial& sum) {
  widen(f.degree + g.degree, sum);
  for (int i = 0; i <= f.degree; ++i)
    for (int j = 0; j <= g.degree; ++j)
      sum.a[static_cast<std::size_t>(i + j)] += f.a[static_cast<std::size_t>(i)] * g.a[static_cast<std::size_t>(j)];
}

/// The rows of Expansion::taylor_of as polynomials on a part of its steps, without the terms that are below rounding.
void scale_rows(const Vector& coefficients, double ratio, std::vector<Polynomial>& out) {
  constexpr double negligible = 0x1p-60;
  out.resize(static_cast<std::size_t>(coefficients.size()) / (degree + 1));
  for (std::size_t r = 0; r < out.size(); ++r) {
    Polynomial& f = out[r];
    double power = 1.0, size = 0.0;
    for (int j = 0; j <= degree; ++j, power *= ratio) {
      const double a = power * coefficients[static_cast<Eigen::Index>(r) * (degree + 1) + j];
      f.a[static_cast<std::size_t>(j)] = a;
      size += std::abs(a);
    }
    f.degree = degree;
    while (f.degree > 0 && std::abs(f.a[static_cast<std::size_t>(f.degree)]) <= negligible * size) --f.degree;
  }
}

}  // namespace

/// The Taylor polynomials of a mode's rows on steps of length `longest`: coefficients = taylor X, row by row.
struct Tracer::Expansion {
  Expansion(const Model& model, const mode::Frame& frame, std::shared_ptr<const mode::Outline> of, double step)
      : kept(std::move(of)), outline(*kept), formulas(model, frame, *kept), longest(step) {}

  /// The quantities where the kinks' rows have these signs; null: not yet known
  struct Branch {
    std::vector<bool> above;
    std::vector<Term> terms;
    Matrix taylor;
    std::size_t rows = 0;
  };

  Branch& branch(const std::vector<bool>& above, const std::vector<Quantity>& quantities);
  [[nodiscard]] Matrix taylor_of(const std::vector<RowVector>& rows) const;

  std::shared_ptr<const mode::Outline> kept;
  const mode::Outline& outline;
  Formulas formulas;
  double longest;
  Matrix kinks, flow;
  std::vector<Branch> branches;
};

/// Rows c A^j h^j / j!, j = 0 .. 23, one block for each c.
Matrix Tracer::Expansion::taylor_of(const std::vector<RowVector>& rows) const {
  Matrix all(static_cast<Eigen::Index>(rows.size()) * (degree + 1), outline.system.rows());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    RowVector term = rows[r];
    for (int j = 0; j <= degree; ++j) {
      all.row(static_cast<Eigen::Index>(r) * (degree + 1) + j) = term;
      term = (longest / (j + 1)) * (term * outline.system);
    }
  }
  return all;
}

Tracer::Expansion::Branch& Tracer::Expansion::branch(const std::vector<bool>& above, const std::vector<Quantity>& quantities) {
  for (Branch& known : branches)
    if (known.above == above) return known;
  Branch made;
  made.above = above;
  std::vector<RowVector> rows;
  const auto place = [&](const RowVector& row) {
    const auto found = std::find(rows.begin(), rows.end(), row);
    if (found != rows.end()) return static_cast<std::size_t>(found - rows.begin());
    rows.push_back(row);
    return rows.size() - 1;
  };
  for (const Quantity& quantity : quantities) {
    const Formula formula = formulas.of(quantity, above);
    Term term;
    if (!formula.linear.isZero(0.0)) term.linear = place(formula.linear);
    for (const auto& [left, right] : formula.products) {
      if (left.isZero(0.0) || right.isZero(0.0)) continue;
      const std::size_t a = place(left), b = place(right);
      term.products.emplace_back(a, b);
    }
    made.terms.push_back(std::move(term));
  }
  made.rows = rows.size();
  made.taylor = taylor_of(rows);
  branches.push_back(std::move(made));
  return branches.back();
}

Tracer::Tracer(const Model& model, const mode::Frame& frame, double period, const std::vector<Quantity>& of,
               Listener& listener)
    : model_(model), frame_(frame), period_(period), of_(of), listener_(listener), values_(of.size()),
      marks_(model.stops.size() + model.frictions.size() + model.compliant_stops.size() + 1) {}

Tracer::~Tracer() = default;

Tracer::Expansion& Tracer::expansion(const std::shared_ptr<const mode::Outline>& outline, double longest) {
  for (const auto& known : modes_)
    if (known->kept == outline || known->outline.states == outline->states) return *known;
  auto made = std::make_unique<Expansion>(model_, frame_, outline, longest);
  made->kinks = made->taylor_of(made->formulas.kinks());
  const auto m = outline->system.rows();
  Matrix term = Matrix::Identity(m, m);
  made->flow = term;
  for (int j = 1; j <= degree; ++j) {
    term = (longest / j) * (outline->system * term);
    made->flow += term;
  }
  modes_.push_back(std::move(made));
  return *modes_.back();
}

void Tracer::piece(const std::shared_ptr<const mode::Outline>& outline, double longest, const double* X, double begin,
                   double duration) {
  next_ = outline.get();
  if (last_ != nullptr) tell_blow(X);
  struck_ = 0;
  Expansion& mode = expansion(outline, longest);
  X_ = Eigen::Map<const Vector>(X, frame_.size());
  const double end = begin + duration;
  end_ = begin;
  for (double left = duration; left > 0.0;) {
    double length = std::min(left, mode.longest);
    if (!mode.formulas.kinks().empty()) length = to_first_kink(mode, length);
    step(mode, length);
    left -= length;
    end_ = end - left;
  }
  end_ = end;
  const auto slips = [](mode::FrictionState state) { return state != mode::FrictionState::stick; };
  if (std::any_of(next_->states.frictions.begin(), next_->states.frictions.end(), slips)) slid_ += duration;
  last_ = next_;
}

/// At most `length`: the step ends where a kink's row passes zero.
double Tracer::to_first_kink(const Expansion& mode, double length) const {
  std::vector<Polynomial> rows;
  scale_rows(mode.kinks * X_, length / mode.longest, rows);
  double first = 1.0;
  for (const Polynomial& row : rows) {
    const double rounding = 0x1p-45 * row.size();
    if (std::abs(row.a[0]) > row.size(1)) continue;
    event::possible_zeros(row, event::Bernstein(row), 0.0, 1.0, 0x1p-53 * row.size(), [&](double x) {
      if (x > 0x1p-20 && x < first && std::abs(row.at(x)) <= rounding) first = x;
    });
  }
  return first * length;
}

void Tracer::step(Expansion& mode, double length) {
  const double ratio = length / mode.longest;
  above_.clear();
  if (!mode.formulas.kinks().empty()) {
    scale_rows(mode.kinks * X_, ratio, rows_);
    for (const Polynomial& row : rows_) above_.push_back(row.at(0.5) > 0.0);
  }
  const Expansion::Branch& branch = mode.branch(above_, of_);
  coefficients_.noalias() = branch.taylor * X_;
  scale_rows(coefficients_, ratio, rows_);
  for (std::size_t k = 0; k < of_.size(); ++k) {
    const Term& term = branch.terms[k];
    values_[k].degree = 0;
    values_[k].a[0] = 0.0;
    if (term.linear) {
      const Polynomial& row = rows_[*term.linear];
      values_[k].degree = row.degree;
      std::copy_n(row.a.begin(), row.degree + 1, values_[k].a.begin());
    }
    for (const auto& [a, b] : term.products) add_product(rows_[a], rows_[b], values_[k]);
  }
  listener_.step({end_, length, values_});
  move(mode, length);
}

/// X_ goes on by exp(A length).
void Tracer::move(const Expansion& mode, double length) {
  if (length == mode.longest) {
    next_X_.noalias() = mode.flow * X_;
    X_.swap(next_X_);
    return;
  }
  Vector term = X_;
  for (int j = 1; j <= degree; ++j) {
    next_X_.noalias() = mode.outline.system * term;
    term = (length / j) * next_X_;
    X_ += term;
  }
}

double value_at(const Quantity& quantity, const Struck& impact) {
  using Kind = Quantity::Kind;
  const bool one_stop = quantity.index >= 0;
  const Since& since = one_stop ? impact.own : impact.any;
  if (one_stop && quantity.index != impact.contact) return std::numeric_limits<double>::quiet_NaN();
  if (quantity.kind == Kind::speed) return impact.w;
  if (quantity.kind == Kind::impulse) return impact.impulse;
  if (quantity.kind == Kind::loss) return impact.loss;
  if (quantity.kind == Kind::flight) return since.flight;
  return quantity.kind == Kind::sliding ? since.sliding : std::numeric_limits<double>::quiet_NaN();
}

void Tracer::impact(int stop, double w) {
  if (last_ == nullptr) return;
  strike(std::uint32_t{1} << static_cast<unsigned>(stop));
  const auto known = std::find_if(impacts_.begin(), impacts_.end(), [&](const Struck& one) { return one.contact == stop; });
  if (known == impacts_.end()) impacts_.push_back(meet(stop, w));
}

void Tracer::begin_flight(int contact, double time, double slid) {
  const Mark mark{time, slid_ - slid};
  marks_[static_cast<std::size_t>(contact)] = mark;
  if (!marks_.back() || time >= marks_.back()->time) marks_.back() = mark;
}

/// @param contact  -1: any
Since Tracer::since(int contact) const {
  const auto& mark = contact < 0 ? marks_.back() : marks_[static_cast<std::size_t>(contact)];
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  return mark ? Since{(end_ - mark->time) / period_, (slid_ - mark->slid) / period_} : Since{unknown, unknown};
}

/// An impact here and now: it ends a flight and begins one.
Struck Tracer::meet(int contact, double w) {
  const Struck met{contact, w, 0.0, 0.0, since(-1), since(contact)};
  begin_flight(contact, end_);
  return met;
}

void Tracer::finish(const double* X, const mode::Outline& next) {
  if (last_ == nullptr) return;
  next_ = &next;
  tell_blow(X);
}

/// What lies between the end of the last piece and X.
void Tracer::tell_blow(const double* X) {
  Blow blow{end_, std::vector<double>(of_.size(), 0.0), {}};
  const bool struck = struck_ != 0;
  if (struck) blow_of_stops(X, blow);
  if (last_->states.compliant != next_->states.compliant) {
    let_go(*next_, blow);
    engage(*next_, blow);
  }
  const bool any = std::any_of(blow.impulses.begin(), blow.impulses.end(), [](double one) { return one != 0.0; });
  if (struck || any || !blow.impacts.empty()) listener_.blow(blow);
  struck_ = 0;
  impacts_.clear();
}

/// M dv = -sum_i g_i P_i over the stops that were struck: in contact coordinates dw_i = -sum_j D_ij P_j. Each takes P_i
/// (w_i- + w_i+) / 2.
void Tracer::blow_of_stops(const double* X, Blow& blow) {
  std::vector<int> stops;
  for (int i = 0; i < static_cast<int>(model_.stops.size()); ++i)
    if ((struck_ >> static_cast<unsigned>(i) & 1U) != 0) stops.push_back(i);
  const auto count = static_cast<Eigen::Index>(stops.size());
  const auto row = [&](Eigen::Index i) { return frame_.stops[static_cast<std::size_t>(stops[static_cast<std::size_t>(i)])]; };
  Matrix D(count, count);
  Vector jump(count), sum(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto u = static_cast<Eigen::Index>(frame_.u(row(i).own));
    jump[i] = row(i).sign * (X[u] - X_[u]);
    sum[i] = row(i).sign * (X[u] + X_[u]);
    for (Eigen::Index j = 0; j < count; ++j)
      D(i, j) = row(i).sign * row(j).sign * frame_.mass_inverse(row(i).own, row(j).own);
  }
  const Vector P = -mode::least_norm_inverse(D) * jump, loss = 0.5 * P.cwiseProduct(sum);
  share(stops, P, loss, Eigen::Map<const Vector>(X, frame_.size()) - X_, blow);
  for (Struck& impact : impacts_) {
    const auto i = static_cast<Eigen::Index>(std::find(stops.begin(), stops.end(), impact.contact) - stops.begin());
    impact.impulse = P[i];
    impact.loss = loss[i];
  }
  blow.impacts = impacts_;
}

/// The impulses of all quantities.
void Tracer::share(const std::vector<int>& stops, const Vector& P, const Vector& loss, const Vector& change, Blow& blow) const {
  const Formulas formulas(model_, frame_, *last_);
  const auto of_one = [&](Quantity::Kind kind, int index) {
    if (kind == Quantity::Kind::acceleration)
      return formulas.velocity(index).segment(frame_.d, frame_.n).dot(change.segment(frame_.d, frame_.n));
    const auto i = std::find(stops.begin(), stops.end(), index) - stops.begin();
    if (i == P.size()) return 0.0;
    if (kind == Quantity::Kind::force) return P[i];
    return kind == Quantity::Kind::power ? loss[i] : 0.0;
  };
  for (std::size_t k = 0; k < of_.size(); ++k)
    blow.impulses[k] = of_one(of_[k].kind, of_[k].index) - (of_[k].minus >= 0 ? of_one(of_[k].kind, of_[k].minus) : 0.0);
}

/// A compliant stop that lets go beyond its gap takes the energy of its spring; one that pushes again brings it back.
void Tracer::let_go(const mode::Outline& next, Blow& blow) const {
  for (std::size_t k = 0; k < of_.size(); ++k) {
    if (of_[k].kind != Quantity::Kind::power) continue;
    const int compliant = of_[k].index - static_cast<int>(model_.stops.size() + model_.frictions.size());
    if (compliant < 0 || compliant >= static_cast<int>(model_.compliant_stops.size())) continue;
    const auto at = static_cast<std::size_t>(compliant);
    const auto detached = [&](const mode::Outline& mode) {
      return mode.states.compliant[at] == mode::CompliantState::detached ? 1.0 : 0.0;
    };
    const double sense = detached(next) - detached(*last_);
    const double delta = X_[frame_.compliant[at].own];
    blow.impulses[k] += sense * 0.5 * model_.compliant_stops[at].stiffness * delta * delta;
  }
}

/// A compliant stop that is met from its free side, as section/stop_choice.hpp counts them.
void Tracer::engage(const mode::Outline& next, Blow& blow) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const int first = static_cast<int>(model_.stops.size() + model_.frictions.size());
  for (std::size_t i = 0; i < model_.compliant_stops.size(); ++i) {
    const bool met = last_->states.compliant[i] == mode::CompliantState::off && next.states.compliant[i] != mode::CompliantState::off;
    const double w = met ? frame_.velocity_row(frame_.compliant[i]).dot(X_) : 0.0;
    if (!(w > 0.0)) continue;
    blow.impacts.push_back(meet(first + static_cast<int>(i), w));
    blow.impacts.back().impulse = blow.impacts.back().loss = unknown;
  }
}

}  // namespace slapstick::quantity
