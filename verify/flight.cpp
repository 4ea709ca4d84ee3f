/// Flies one segment in balls, and checks what is claimed of its guards.
#include "flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace verify {
namespace {

constexpr double rounding = 0x1p-40;        ///< of sums, in units of the sizes of what is added
constexpr double start_rounding = 0x1p-44;  ///< the same, of a zero at the start
constexpr double instant = 0x1p-30;         ///< events within it, in periods, are at one instant
constexpr double reach_of_series = 4.0;     ///< radians, nearly: longer pieces are cut
constexpr double most_cuts = 1e5;

/// A double not below to - from.
double length(double from, double to) { return from == to ? 0.0 : std::nextafter(to - from, INFINITY); }

}  // namespace

std::string digits(double x) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.17g", x);
  return text.data();
}

Flight::Flight(const Flow& flow, const Mode& mode, const Segment& segment, double period, Tally& tally,
               const Refuse& refuse)
    : X(segment.state.begin(), segment.state.end()),
      size(flow.sizes_of(X)),
      flow_(flow),
      mode_(mode),
      segment_(segment),
      period_(period),
      tally_(tally),
      refuse_(refuse),
      proofs_(mode.guards.size()) {}

void Flight::refuse(long line, std::size_t guard, const std::string& what) const {
  refuse_(line, "guard " + std::to_string(guard) + " (" + mode_.guards[guard].kind + "): " + what);
}

double Flight::size_of(std::size_t guard, const std::vector<double>& sizes) const {
  double sum = 0.0;
  for (const auto& [j, c] : mode_.guards[guard].row) sum += std::abs(c) * sizes[static_cast<std::size_t>(j)];
  return sum;
}

/// Every guard has one claim, but where there is no time for a zero.
void Flight::collect() {
  std::vector<bool> seen(proofs_.size());
  for (const Claim& claim : segment_.claims) {
    const auto g = static_cast<std::size_t>(claim.guard);
    if (seen[g]) refuse(claim.line, g, "is claimed twice");
    seen[g] = true;
    ++(claim.rest ? tally_.rests : tally_.guards);
    tally_.steps += static_cast<long>(claim.steps.size());
    if (claim.rest || steps_follow(claim)) proofs_[g].claim = &claim;
    if (!claim.rest) limit_reaches(claim);
  }
  for (std::size_t g = 0; g < seen.size(); ++g)
    if (!seen[g] && segment_.duration > 0.0) refuse(segment_.line, g, "neither `prove` nor `rest`");
}

/// What can be said of the steps without the flow.
bool Flight::steps_follow(const Claim& claim) {
  const auto g = static_cast<std::size_t>(claim.guard);
  const auto fail = [&](long line, std::size_t j, const std::string& what) {
    refuse(line, g, "step " + std::to_string(j) + ": " + what);
    return false;
  };
  if (claim.steps.empty() && claim.limit > 0.0) return refuse(claim.line, g, "there is no step"), false;
  for (std::size_t j = 0; j < claim.steps.size(); ++j) {
    const Step& step = claim.steps[j];
    const Ball end = Ball(step.s) + Ball(step.d);
    if (j == 0 && step.s != 0.0) return fail(step.line, j, "starts at s = " + digits(step.s) + ", not at 0");
    if (j > 0 && !(step.s > claim.steps[j - 1].s)) return fail(step.line, j, "does not start behind the one before");
    if (!(step.s < claim.limit)) return fail(step.line, j, "starts at s = " + digits(step.s) + ", at or behind LIMIT");
    const bool last = j + 1 == claim.steps.size();
    const double next = last ? claim.limit : claim.steps[j + 1].s;
    if (!(end >= Ball(next)))
      return fail(
          step.line, j,
          "ends at " + digits(end.near()) + ", before " + (last ? "LIMIT, " : "the next starts, ") + digits(next));
    if (!(step.M >= 0.0)) return fail(step.line, j, "M = " + digits(step.M) + " is negative");
    const Ball d(step.d), there = Ball(step.h) + Ball(step.h1) * d - Ball(step.M) * d * d * Ball(0.5);
    if (!(step.h > 0.0)) return fail(step.line, j, "its parabola is " + digits(step.h) + " at its start, not positive");
    if (!(there > Ball(0.0)))
      return fail(step.line, j, "its parabola is " + digits(there.near()) + " at its end, not positive");
  }
  return true;
}

void Flight::limit_reaches(const Claim& claim) {
  const End& end = segment_.end;
  const auto g = static_cast<std::size_t>(claim.guard);
  const bool zero = end.kind == EndKind::zero && end.index == claim.guard;
  const bool touch = end.kind == EndKind::touch && end.index == claim.guard;
  const double missing = segment_.duration - claim.limit;
  const std::string text = "LIMIT = " + digits(claim.limit) + " is " + digits(missing) + " short of DURATION";
  if (missing < 0.0)
    refuse(claim.line, g, "LIMIT = " + digits(claim.limit) + " is behind DURATION = " + digits(segment_.duration));
  if (missing <= 0.0 || touch) return;
  if (zero) {
    if (missing > end.size + 0x1p-52 * segment_.duration)
      refuse(claim.line, g, text + ", more than DELTA = " + digits(end.size));
  } else if (end.kind == EndKind::cut) {
    refuse(claim.line, g, text);
  } else if (missing > instant * period_) {
    note_flat(missing);
  } else {
    ++tally_.ties;
    tally_.tie = std::max(tally_.tie, missing / period_);
  }
}

/// A zero or a tie whose place rounding leaves open for longer than an instant: between, |h| must be within rounding.
void Flight::note_flat(double length) {
  ++tally_.flats;
  tally_.flat = std::max(tally_.flat, length / period_);
}

std::vector<double> Flight::cuts() {
  std::vector<double> at{0.0, segment_.duration};
  for (const Proof& proof : proofs_) {
    if (proof.claim == nullptr || proof.claim->rest) continue;
    at.push_back(proof.claim->limit);
    for (const Step& step : proof.claim->steps) at.push_back(step.s);
  }
  const double most = reach_of_series / flow_.nu;
  for (double n = 1; n * most < segment_.duration; ++n) at.push_back(n * most);
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  at.erase(std::upper_bound(at.begin(), at.end(), segment_.duration), at.end());
  at.erase(at.begin(), std::lower_bound(at.begin(), at.end(), 0.0));
  return at;
}

void Flight::fly() {
  collect();
  if (!(flow_.nu * segment_.duration / reach_of_series <= most_cuts))
    return refuse_(segment_.line,
                   "DURATION = " + digits(segment_.duration) + " is too long to be followed: cut the segment");
  const std::vector<double> at = cuts();
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    double reach = length(at[i], at[i + 1]);
    std::size_t terms = 0;
    for (const Proof& proof : proofs_) {
      if (i > 0 || proof.claim == nullptr || proof.claim->order == 0 || proof.claim->steps.empty()) continue;
      const auto& steps = proof.claim->steps;
      reach = std::max(reach, length(0.0, std::min(steps[0].d, 16.0 * reach_of_series / flow_.nu)));
      terms = std::max(terms, static_cast<std::size_t>(proof.claim->order) + 8);
    }
    const Expansion about(flow_, X, Ball(reach), terms);
    for (const Proof& proof : proofs_)
      if (i == 0 && proof.claim != nullptr) order(about, *proof.claim);
    piece(about, at[i], at[i + 1]);
    X = about.at(Ball(at[i + 1]) - Ball(at[i]));
  }
  end();
}

/// The zero that a claim has at the start.
void Flight::order(const Expansion& about, const Claim& claim) {
  if (claim.order == 0) return;
  const auto g = static_cast<std::size_t>(claim.guard);
  const Series h = about.of(flow_.guards[g]);
  std::vector<double> term = flow_.sizes_of(X);
  Ball factorial(1.0);
  for (std::size_t n = 0; n < static_cast<std::size_t>(claim.order); ++n) {
    if (n > 0) factorial = times(std::move(factorial), n);
    const Ball derivative = h.b[n] * factorial;
    const double allowed = start_rounding * size_of(g, term);
    if (!(abs(derivative) <= Ball(allowed)))
      refuse(claim.line, g,
             "has no zero of order " + std::to_string(claim.order) + ": derivative " + std::to_string(n) + " is " +
                 digits(derivative.near()) + ", rounding explains " + digits(allowed));
    term = flow_.apply_sizes(term);
  }
}

void Flight::piece(const Expansion& about, double from, double to) {
  const std::vector<double> sizes = flow_.carry_sizes(flow_.sizes_of(X), length(from, to));
  for (std::size_t i = 0; i < size.size(); ++i) size[i] = std::max(size[i], sizes[i]);
  for (std::size_t g = 0; g < proofs_.size(); ++g) {
    Proof& proof = proofs_[g];
    if (proof.claim == nullptr) continue;
    if (proof.claim->rest)
      at_rest(about.of(flow_.guards[g]), *proof.claim, Ball(to) - Ball(from), size_of(g, sizes));
    else if (from < proof.claim->limit)
      step(about, proof, from, to);
    else if (segment_.end.kind == EndKind::touch && segment_.end.index == proof.claim->guard)
      flat(about.of(flow_.guards[g]), *proof.claim, Ball(to) - Ball(from), segment_.end.size, "NOISE = ");
    else if (segment_.duration - proof.claim->limit > instant * period_)
      flat(about.of(flow_.guards[g]), *proof.claim, Ball(to) - Ball(from), rounding * size_of(g, size),
           "rounding explains ");
  }
}

void Flight::at_rest(const Series& h, const Claim& claim, const Ball& t, double size_there) {
  const Ball most = h.most(0, t);
  if (!(most <= Ball(rounding * size_there)))
    refuse(claim.line, static_cast<std::size_t>(claim.guard),
           "does not rest: up to " + digits(most.near()) + ", rounding explains " + digits(rounding * size_there));
}

void Flight::step(const Expansion& about, Proof& proof, double from, double to) {
  const auto& steps = proof.claim->steps;
  const Balls& row = flow_.guards[static_cast<std::size_t>(proof.claim->guard)];
  if (proof.step + 1 < steps.size() && steps[proof.step + 1].s == from) ++proof.step;
  const Step& now = steps[proof.step];
  if (proof.step > 0 || proof.claim->order == 0) return lower_bound(about.of(row), *proof.claim, now, from, to);
  if (from > 0.0) return;
  const double covered = steps.size() > 1 ? steps[1].s : proof.claim->limit;
  if (flow_.nu * covered > 16.0 * reach_of_series)
    return refuse(now.line, static_cast<std::size_t>(proof.claim->guard), "step 0 is too long to be followed");
  lower_bound(about.of(row, static_cast<std::size_t>(proof.claim->order)), *proof.claim, now, 0.0, covered);
}

void Flight::lower_bound(const Series& f, const Claim& claim, const Step& step, double from, double to) {
  const auto g = static_cast<std::size_t>(claim.guard);
  const auto name = [&] { return "step " + std::to_string(&step - claim.steps.data()) + ": "; };
  if (step.s == from) {
    const Ball &h = f.b[0], &h1 = f.b[1];
    if (!(h >= Ball(step.h)))
      refuse(step.line, g, name() + "h >= " + digits(step.h) + " claimed, it is " + digits(h.near()));
    if (!(h1 >= Ball(step.h1)))
      refuse(step.line, g, name() + "h' >= " + digits(step.h1) + " claimed, it is " + digits(h1.near()));
  }
  if (!f.curvature_within(Ball(step.M), 0.0, length(from, to)))
    refuse(step.line, g,
           name() + "|h''| <= " + digits(step.M) + " claimed, it is up to " +
               digits(f.most(2, Ball(length(from, to))).near()) + " behind s = " + digits(from));
}

/// Behind the limit of a guard that touches, or whose zero is flat.
void Flight::flat(const Series& h, const Claim& claim, const Ball& t, double allowed, const char* why) {
  const Ball most = h.most(0, t);
  if (!(most <= Ball(allowed)))
    refuse(claim.line, static_cast<std::size_t>(claim.guard),
           "is up to " + digits(most.near()) + " between LIMIT and DURATION, " + why + digits(allowed));
}

void Flight::end() {
  const End& end = segment_.end;
  if (end.kind != EndKind::zero && end.kind != EndKind::touch) return;
  const auto g = static_cast<std::size_t>(end.index);
  const double noise = rounding * size_of(g, size);
  if (proofs_[g].claim != nullptr && proofs_[g].claim->rest) refuse(end.line, g, "rests, and cannot end the segment");
  const Ball here = dot(flow_.guards[g], X);
  if (end.kind == EndKind::touch) {
    ++tally_.touches;
    if (!(end.size <= noise))
      refuse(end.line, g, "NOISE = " + digits(end.size) + ", rounding explains " + digits(noise));
    if (!(abs(here) <= Ball(end.size)))
      refuse(end.line, g, "is " + digits(here.near()) + " at DURATION, more than NOISE");
    return;
  }
  if (!(flow_.nu * end.size <= 16.0 * reach_of_series))
    return refuse(end.line, g, "DELTA = " + digits(end.size) + " is too long to be followed");
  const Ball delta(end.size);
  const Series behind = Expansion(flow_, X, delta).of(flow_.guards[g]);
  if (end.size <= instant * period_)
    tally_.delta = std::max(tally_.delta, end.size / period_);
  else if (behind.most(0, delta) <= Ball(noise))
    note_flat(end.size);
  else
    refuse(end.line, g,
           "DELTA = " + digits(end.size) + " is more than 2^-30 periods, and h is more than rounding there");
  const Ball after = behind.value(0, delta);
  if (segment_.duration > 0.0 ? !(after < Ball(0.0)) : !(abs(here) <= Ball(noise)))
    refuse(end.line, g, "has no zero at the end: it is " + digits(after.near()) + " at DURATION + DELTA");
}

}  // namespace verify
