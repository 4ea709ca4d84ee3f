/// Cuts pieces of a motion into steps, and writes quantities as polynomials on them.
#include "quantity/tracer.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/set_bits.hpp"
#include "quantity/terms.hpp"

namespace slapstick::quantity {

/// The Taylor polynomials of a mode's rows on steps of length `longest`: coefficients = taylor X, row by row.
struct Tracer::Expansion {
  Expansion(const Model& model, const mode::Frame& frame, std::shared_ptr<const mode::Outline> of, double step,
            const Rates* rates)
      : kept(std::move(of)),
        outline(*kept),
        formulas(model, frame, *kept, rates),
        longest(step),
        rate(rates != nullptr ? rates->outline : nullptr) {}

  /// The quantities where the kinks' rows have these signs; null: not yet known
  struct Branch {
    std::vector<bool> above;
    std::vector<Term> terms;
    std::vector<Row> rows;
    Matrix taylor;
  };

  Branch& branch(const std::vector<bool>& above, const std::vector<Quantity>& quantities);
  [[nodiscard]] Branch branch_of(const std::vector<Formula>& all) const;
  [[nodiscard]] Matrix taylor_of(const std::vector<Row>& rows) const;

  std::shared_ptr<const mode::Outline> kept;
  const mode::Outline& outline;
  Formulas formulas;
  double longest;
  const mode::OutlineDerivative* rate;
  Matrix kinks, flow;
  std::vector<Branch> branches;
};

/// Rows c A^j h^j / j!, j = 0 .. 23, one block for each c.
Matrix Tracer::Expansion::taylor_of(const std::vector<Row>& rows) const {
  Matrix all(static_cast<Eigen::Index>(rows.size()) * (taylor_degree + 1), outline.system.rows());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    RowVector term = rows[r].value;
    for (int j = 0; j <= taylor_degree; ++j) {
      all.row(static_cast<Eigen::Index>(r) * (taylor_degree + 1) + j) = term;
      term = (longest / (j + 1)) * (term * outline.system);
    }
  }
  return all;
}

Tracer::Expansion::Branch& Tracer::Expansion::branch(const std::vector<bool>& above,
                                                     const std::vector<Quantity>& quantities) {
  for (Branch& known : branches)
    if (known.above == above) return known;
  std::vector<Formula> all;
  all.reserve(quantities.size());
  for (const Quantity& quantity : quantities) all.push_back(formulas.of(quantity, above));
  branches.push_back(branch_of(all));
  branches.back().above = above;
  return branches.back();
}

/// A term for each formula.
Tracer::Expansion::Branch Tracer::Expansion::branch_of(const std::vector<Formula>& all) const {
  Branch made;
  const auto place = [&](const Row& row) {
    const auto same = [&](const Row& one) { return one.value == row.value && one.rate == row.rate; };
    const auto found = std::find_if(made.rows.begin(), made.rows.end(), same);
    if (found != made.rows.end()) return static_cast<std::size_t>(found - made.rows.begin());
    made.rows.push_back(row);
    return made.rows.size() - 1;
  };
  const auto nothing = [](const Row& row) { return row.value.isZero(0.0) && row.rate.isZero(0.0); };
  for (const Formula& formula : all) {
    Term term;
    if (!nothing(formula.linear)) term.linear = place(formula.linear);
    for (const auto& [left, right] : formula.products) {
      if (nothing(left) || nothing(right)) continue;
      const std::size_t a = place(left), b = place(right);
      term.products.emplace_back(a, b);
    }
    made.terms.push_back(std::move(term));
  }
  made.taylor = taylor_of(made.rows);
  return made;
}

/// The tail of a chatter: the quantities between its impacts, and the sum of these, the integrals of the mean pushes.
struct Tracer::Tail {
  Expansion::Branch branch;  ///< a term for each quantity, and one for the push of each stop
  struct Push {
    std::vector<Number> shares;  ///< of each quantity, in the sum
    Number sum = {};
  };
  std::vector<Push> pushes;
};

Tracer::Tracer(const Model& model, const mode::Frame& frame, Number period, const std::vector<Quantity>& of,
               Listener& listener, const Rates* rates)
    : model_(model),
      frame_(frame),
      of_(of),
      listener_(listener),
      rates_(rates),
      jumps_(model, frame, period, of, rates),
      values_(of.size()),
      value_rates_(rates != nullptr ? of.size() : 0) {}

Tracer::~Tracer() = default;

Tracer::Expansion& Tracer::expansion(const std::shared_ptr<const mode::Outline>& outline, double longest,
                                     const PieceRates* rates) {
  for (const auto& known : modes_)
    if (known->kept == outline || known->outline.states == outline->states) return *known;
  std::optional<Rates> of_mode;
  if (rates != nullptr) of_mode.emplace(Rates{rates_->model, rates_->frame, &rates->outline});
  auto made = std::make_unique<Expansion>(model_, frame_, outline, longest, of_mode ? &*of_mode : nullptr);
  made->kinks = made->taylor_of(made->formulas.kinks());
  const auto m = outline->system.rows();
  Matrix term = Matrix::Identity(m, m);
  made->flow = term;
  for (int j = 1; j <= taylor_degree; ++j) {
    term = (longest / j) * (outline->system * term);
    made->flow += term;
  }
  modes_.push_back(std::move(made));
  return *modes_.back();
}

void Tracer::piece(const std::shared_ptr<const mode::Outline>& outline, double longest, const double* X, double begin,
                   double duration, const PieceRates* rates) {
  if (chatter_ != 0) jumps_.chatter(chatter_);
  std::optional<VelocityJump> jump;
  if (last_ != nullptr) jump = jump_before(*outline, X, rates != nullptr ? rates->X : nullptr);
  if (jump && chatter_ == 0) listener_.jump(*jump);
  jumps_.forget();
  Expansion& mode = expansion(outline, longest, rates);
  at_.X = Eigen::Map<const Vector>(X, frame_.size());
  if (rates != nullptr) at_.by = Eigen::Map<const Vector>(rates->X, frame_.size());
  const double end = begin + duration, begin_rate = rates != nullptr ? rates->begin : 0.0,
               end_rate = rates != nullptr ? rates->duration : 0.0;
  double from_rate = 0.0;
  behind_ = nullptr;
  if (chatter_ != 0) begin_tail(mode);
  // Between two events at one instant a piece has no length, and yet its ends move apart.
  if (duration == 0.0 && end_rate != 0.0)
    step(mode, 0.0, {begin, 0.0, values_, value_rates_, begin_rate, 0.0, end_rate});
  for (double left = duration; left > 0.0;) {
    catch_up();
    Number length{std::min(left, mode.longest), 0.0};
    if (left <= mode.longest) length.rate = end_rate;
    if (!mode.formulas.kinks().empty())
      if (const Number kink = to_first_kink(mode, length.value); kink.value < length.value) length = kink;
    step(mode, length.value, {end - left, length.value, values_, value_rates_, begin_rate, from_rate, length.rate});
    from_rate = length.rate;
    left -= length.value;
  }
  if (chatter_ != 0) tell_tail(std::move(jump), {begin, begin_rate});
  if (rates != nullptr) at_.by += end_rate * (outline->system * at_.X);
  const auto slips = [](mode::FrictionState state) { return state != mode::FrictionState::stick; };
  const auto& frictions = outline->states.frictions;
  const bool slipped = std::any_of(frictions.begin(), frictions.end(), slips);
  jumps_.go_on({end, begin_rate + end_rate}, slipped ? Number{duration, end_rate} : Number{});
  last_ = outline.get();
}

void Tracer::begin_tail(const Expansion& mode) {
  const Formulas& formulas = mode.formulas;
  std::vector<bool> above;
  for (const Row& kink : formulas.kinks()) above.push_back(kink.value.dot(at_.X) > 0.0);
  std::vector<Formulas::Borne> chatter;
  for (const int stop : set_bits(chatter_)) chatter.push_back(formulas.borne_in_chatter(stop, at_.X, at_.by));
  std::vector<Formula> all;
  for (const Quantity& quantity : of_) all.push_back(formulas.in_chatter(quantity, above, chatter));
  std::vector<Tail::Push> pushes;
  for (const Formulas::Borne& of_stop : chatter) {
    all.push_back({formulas.press_in_chatter(of_stop)});
    auto& shares = pushes.emplace_back().shares;
    for (const Quantity& quantity : of_) shares.push_back(formulas.share_in_chatter(quantity, of_stop.stop));
  }
  tail_ = std::make_unique<Tail>(Tail{mode.branch_of(all), std::move(pushes)});
}

/// The pushes of the impacts that a step stands for.
void Tracer::add_to_tail(const Step& place) {
  Polynomial push, rate;
  for (std::size_t i = 0; i < tail_->pushes.size(); ++i) {
    const Term& term = tail_->branch.terms[of_.size() + i];
    Number& sum = tail_->pushes[i].sum;
    combine(term, rows_, push);
    sum.value += place.length * push.integral();
    if (rates_ == nullptr) continue;
    combine_rates(term, rows_, row_rates_, rate);
    sum.rate += place.length * rate.integral() + push.at(1.0) * place.to_rate - push.at(0.0) * place.from_rate;
  }
}

/// The jump with which the tail began, and the impulses of all impacts that are left.
void Tracer::tell_tail(std::optional<VelocityJump> jump, Number begin) {
  if (!jump) jump = VelocityJump{begin, std::vector<Number>(of_.size()), {}};
  for (const Tail::Push& push : tail_->pushes)
    for (std::size_t k = 0; k < of_.size(); ++k) jump->impulses[k] += push.shares[k] * push.sum;
  listener_.jump(*jump);
  tail_.reset();
  chatter_ = 0;
}

/// At most `length`: the step ends where a kink's row passes zero. The place moves by -k_p / k' with the parameter.
Number Tracer::to_first_kink(const Expansion& mode, double length) {
  std::vector<Polynomial> rows;
  scale_rows(mode.kinks * at_.X, length / mode.longest, rows);
  double first = 1.0;
  std::size_t which = rows.size();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Polynomial& row = rows[k];
    const double rounding = 0x1p-45 * row.size();
    if (std::abs(row.a[0]) > row.size(1)) continue;
    event::possible_zeros(row, event::Bernstein(row), 0.0, 1.0, 0x1p-53 * row.size(), [&](double x) {
      if (x > 0x1p-20 && x < first && std::abs(row.at(x)) <= rounding) first = x, which = k;
    });
  }
  if (which == rows.size() || rates_ == nullptr) return {first * length, 0.0};
  const Moving here = at_;
  move_rates(mode, first * length);
  const Row& row = mode.formulas.kinks()[which];
  const Number now = row.at(at_.X, at_.by);
  const double slope = row.value.dot(mode.outline.system * at_.X);
  at_ = here;
  return {first * length, -now.rate / slope};
}

/// One step of the trace, and on to its end.
void Tracer::step(Expansion& mode, double length, const Step& place) {
  evaluate(mode, length);
  listener_.step(place);
  if (tail_ != nullptr) add_to_tail(place);
  if (rates_ != nullptr) return move_rates(mode, length);
  behind_ = &mode;
  behind_by_ = length;
}

void Tracer::catch_up() {
  if (behind_ != nullptr) move(*behind_, behind_by_);
  behind_ = nullptr;
}

void Tracer::arrive(const double* X) {
  at_.X = Eigen::Map<const Vector>(X, frame_.size());
  behind_ = nullptr;
}

/// Taylor's terms over a step of length `longest`, of X and of Y.
void Tracer::expand(const Expansion& mode) {
  const Eigen::Index m = at_.X.size();
  terms_.resize(m, taylor_degree + 1);
  rate_terms_.resize(m, taylor_degree + 1);
  terms_.col(0) = at_.X;
  rate_terms_.col(0) = at_.by;
  for (int j = 1; j <= taylor_degree; ++j) {
    const double part = mode.longest / j;
    terms_.col(j) = part * (mode.outline.system * terms_.col(j - 1));
    rate_terms_.col(j) = part * (mode.outline.system * rate_terms_.col(j - 1) + mode.rate->system * terms_.col(j - 1));
  }
}

/// `values_` and `value_rates_` on the next step.
void Tracer::evaluate(Expansion& mode, double length) {
  const double ratio = length / mode.longest;
  above_.clear();
  if (!mode.formulas.kinks().empty()) {
    scale_rows(mode.kinks * at_.X, ratio, rows_);
    for (const Polynomial& row : rows_) above_.push_back(row.at(0.5) > 0.0);
  }
  const Expansion::Branch& branch = tail_ != nullptr ? tail_->branch : mode.branch(above_, of_);
  coefficients_.noalias() = branch.taylor * at_.X;
  scale_rows(coefficients_, ratio, rows_);
  for (std::size_t k = 0; k < of_.size(); ++k) combine(branch.terms[k], rows_, values_[k]);
  if (mode.rate == nullptr) return;
  expand(mode);
  rate_coefficients_.resize(coefficients_.size());
  for (std::size_t r = 0; r < branch.rows.size(); ++r)
    rate_coefficients_.segment(static_cast<Eigen::Index>(r) * (taylor_degree + 1), taylor_degree + 1) =
        (branch.rows[r].rate * terms_ + branch.rows[r].value * rate_terms_).transpose();
  scale_rows(rate_coefficients_, ratio, row_rates_);
  for (std::size_t k = 0; k < of_.size(); ++k) combine_rates(branch.terms[k], rows_, row_rates_, value_rates_[k]);
}

/// X goes on by exp(A length).
void Tracer::move(const Expansion& mode, double length) {
  if (length == mode.longest) {
    next_.X.noalias() = mode.flow * at_.X;
    at_.X.swap(next_.X);
    return;
  }
  Vector term = at_.X;
  for (int j = 1; j <= taylor_degree; ++j) {
    next_.X.noalias() = mode.outline.system * term;
    term = (length / j) * next_.X;
    at_.X += term;
  }
}

/// X and Y go on.
void Tracer::move_rates(const Expansion& mode, double length) {
  Moving term = at_;
  for (int j = 1; j <= taylor_degree; ++j) {
    next_.by.noalias() = mode.outline.system * term.by;
    next_.by += mode.rate->system * term.X;
    next_.X.noalias() = mode.outline.system * term.X;
    term.X = (length / j) * next_.X;
    term.by = (length / j) * next_.by;
    at_.X += term.X;
    at_.by += term.by;
  }
}

void Tracer::impact(int stop, double w) {
  if (last_ != nullptr) jumps_.impact(stop, w, at_);  // of X its derivative alone, which is never behind
}

void Tracer::finish(const double* X, const mode::Outline& next, const double* X_rate) {
  if (last_ == nullptr) return;
  if (const auto jump = jump_before(next, X, X_rate)) listener_.jump(*jump);
}

/// What lies between the end of the last piece and X.
std::optional<VelocityJump> Tracer::jump_before(const mode::Outline& next, const double* X, const double* X_rate) {
  if (!jumps_.may_come(*last_, next)) {
    jumps_.forget();
    return std::nullopt;
  }
  catch_up();
  Moving after{Eigen::Map<const Vector>(X, frame_.size()), {}};
  if (X_rate != nullptr) after.by = Eigen::Map<const Vector>(X_rate, frame_.size());
  return jumps_.between(*last_, at_, next, after);
}

}  // namespace slapstick::quantity
