/// Flies one segment in balls, and proves the conditions of its mode.
#include "flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace verify {
namespace {

constexpr double radians_of_piece = 1.5;  ///< nearly: by the norm of A
constexpr double most_pieces = 4e5;
constexpr int most_walked = 4000;
constexpr double longest_band = 0x1p-10;  ///< radians
/// What is no more than this of its sizes is walked through as a band.
constexpr double band_level = 0x1p-46;

/// A double not below to - from.
double length(double from, double to) { return from == to ? 0.0 : std::nextafter(to - from, INFINITY); }

Matrix rows_of(const Mode& mode) {
  Matrix rows;
  for (const Condition& condition : mode.conditions) rows.push_back(condition.row);
  return rows;
}

}  // namespace

std::string digits(double x) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.17g", x);
  return text.data();
}

FlownMode::FlownMode(const Mechanics& of_model, const Mode& of)
    : mechanics(of_model),
      mode(of),
      flow(of.A, rows_of(of), 2 * of_model.d()),
      in_coordinates(of_model.in_coordinates(of.A), {}, 2 * of_model.n()) {}

Order order_at(const Flow& flow, std::size_t condition, const Series& h, const std::vector<double>& sizes) {
  std::vector<double> term = sizes;
  double factorial = 1.0;
  Order found;
  const int most = static_cast<int>(sizes.size());
  int rose = most;  // a derivative before that is certainly positive, if only by rounding
  for (found.order = 0; found.order < most; ++found.order) {
    const auto n = static_cast<std::size_t>(found.order);
    if (n > 0) factorial *= static_cast<double>(n);
    const double allowed = start_rounding * flow.size_of(condition, term) / factorial;
    if (h.b[n] > Ball(allowed)) return found;
    if (h.b[n] < Ball(-allowed)) {
      found.value = h.b[n].near() * factorial;
      found.rises = rose < most;
      found.certain = !found.rises;
      if (found.rises) found.order = rose;
      return found;
    }
    if (rose == most && h.b[n] > Ball(0.0)) rose = found.order;
    term = flow.apply_sizes(term);
  }
  found.rests = true;
  return found;
}

Flight::Flight(const FlownMode& flown, const Segment& segment, Balls state, double period, FlightTally& tally,
               const Refuse& refuse)
    : X(std::move(state)),
      size(flown.flow.sizes_of(X)),
      coordinates(2 * flown.mechanics.n(), 0.0),
      flown_(flown),
      segment_(segment),
      period_(period),
      tally_(tally),
      refuse_(refuse),
      proofs_(flown.mode.conditions.size()),
      drops_(proofs_.size(), 0) {}

void Flight::refuse(std::size_t condition, const std::string& what) const {
  refuse_(segment_.line, flown_.mode.conditions[condition].name + ": " + what);
}

void Flight::fly() {
  const Flow& flow = flown_.flow;
  const double T = segment_.duration, count = std::ceil(flow.nu * T / radians_of_piece);
  if (!(count <= most_pieces)) {
    size.assign(size.size(), INFINITY);
    return refuse_(segment_.line, "DURATION = " + digits(T) + " is too long to be followed: cut the segment");
  }
  const long pieces = std::max(1L, static_cast<long>(count));
  double from = 0.0;
  for (long k = 0; k < pieces; ++k) {
    const double to = k + 1 == pieces ? T : T * (static_cast<double>(k + 1) / static_cast<double>(pieces));
    const Expansion about(flow, X, Ball(length(from, to)), terms_at_start(X));
    if (k == 0) start(about);
    piece(about, from, to, k == 0);
    X = about.at(Ball(to) - Ball(from));
    from = to;
  }
  end();
}

/// Which of the conditions are zero at the start, and whether all rise.
void Flight::start(const Expansion& about) {
  for (std::size_t i = 0; i < proofs_.size(); ++i) {
    const Order order = order_at(flown_.flow, i, about.of(flown_.flow.rows[i]), flown_.flow.sizes_of(X));
    proofs_[i].rests = order.rests;
    drops_[i] = proofs_[i].rests ? 0 : static_cast<ulong>(order.order);
    ++(proofs_[i].rests ? tally_.rests : tally_.conditions);
    if (order.rises || segment_.duration == 0.0) continue;  // what lasts no time obeys any law
    failed_ = true;
    refuse(i, order.order == 0 ? "fails at the start: the value is " + digits(order.value)
                               : "fails at once: the value is zero at the start, and its derivative of order " +
                                     std::to_string(order.order) + " is " + digits(order.value));
  }
}

void Flight::piece(const Expansion& about, double from, double to, bool first) {
  const Flow& flow = flown_.flow;
  const double L = length(from, to);
  grow_sizes(L);
  for (std::size_t i = 0; i < proofs_.size() && !failed_; ++i) {
    const double allowed = rounding * flow.size_of(i, size);
    const ulong drop = first ? drops_[i] : 0;
    const Series f = about.of(flow.rows[i], drop);
    if (!proofs_[i].rests) {
      walk({i, f, drop, from, to - from, allowed, f.most(2, Ball(L))});
    } else if (const Ball most = f.most(0, Ball(L)); !(most <= Ball(allowed))) {
      failed_ = true;
      refuse(i, "does not stay zero: the value is up to " + digits(most.near()) + ", rounding explains " +
                    digits(allowed));
    }
  }
}

void Flight::grow_sizes(double L) {
  const Flow &flow = flown_.flow, &own = flown_.in_coordinates;
  const std::vector<double> sizes = flow.carry_sizes(flow.sizes_of(X), L);
  for (std::size_t i = 0; i < size.size(); ++i) size[i] = std::max(size[i], sizes[i]);
  const std::vector<double> of_own = own.carry_sizes(own.sizes_of(flown_.mechanics.in_coordinates(X)), L);
  for (std::size_t i = 0; i < coordinates.size(); ++i) coordinates[i] = std::max(coordinates[i], of_own[i]);
}

/// From the piece's start to its end, step by step.
void Flight::walk(const Piece& piece) {
  Proof& proof = proofs_[piece.condition];
  const double M = piece.M.highest();
  double t = 0.0;
  for (int n = 0; n < most_walked && t < piece.length; ++n) {
    const Ball h = piece.f.value(0, Ball(t)), h1 = piece.f.value(1, Ball(t));
    const double low = h.lowest(), slope = h1.lowest(), left = length(t, piece.length);
    const double level = band_level / rounding * piece.allowed / (piece.drop > 0 ? std::pow(t, piece.drop) : 1.0);
    const bool positive = low > 0.0 && (low > level || !proof.in_band);
    if (positive) leave_band(proof, piece.begin + t);
    if (positive && h + h1 * Ball(left) - Ball(M) * Ball(left) * Ball(left) * Ball(0.5) > Ball(0.0)) return;
    double d = 0.0;
    if (positive) {
      const double root = std::sqrt(slope * slope + 2.0 * M * low);
      d = (1.0 - 0x1p-20) * std::min(slope < 0.0 ? 2.0 * low / (root - slope) : (slope + root) / M, left);
      const Ball D(d);
      if (!(d > 0.0 && h + h1 * D - Ball(M) * D * D * Ball(0.5) > Ball(0.0))) d = 0.0;
    }
    if (!(d > 0x1p-51 * (piece.begin + t)) || !(t + d > t)) {
      d = through_band(piece, t);
      if (failed_) return;
    }
    t = std::nextafter(t + d, 0.0) > t ? std::nextafter(t + d, 0.0) : t + d;  // no hole
    if (d == left) return;
  }
  if (t >= piece.length) return;
  failed_ = true;
  refuse(piece.condition, "is too near to zero to be followed, at s = " + digits(piece.begin + t));
}

/// The longest step of halves and halves on which |h| is no more than rounding.
double Flight::through_band(const Piece& piece, double t) {
  Proof& proof = proofs_[piece.condition];
  const Ball h = abs(piece.f.value(0, Ball(t))), h1 = abs(piece.f.value(1, Ball(t)));
  if (!proof.in_band) proof.band_begin = piece.begin + t;
  proof.in_band = true;
  for (double d = length(t, piece.length); t + d > t; d *= 0.5) {
    const Ball D(d), most = h + h1 * D + piece.M * D * D * Ball(0.5);
    if (most * power(Ball(t) + D, piece.drop) <= Ball(piece.allowed)) return d;
  }
  failed_ = true;
  refuse(piece.condition, "fails at s = " + digits(piece.begin + t) + " of " + digits(segment_.duration) +
                              ": the value is " + digits(piece.f.value(0, Ball(t)).near()) + ", rounding explains " +
                              digits(piece.allowed));
  return 0.0;
}

void Flight::leave_band(Proof& proof, double at) {
  if (!proof.in_band) return;
  proof.in_band = false;
  ++tally_.touches;
  tally_.band = std::max(tally_.band, (at - proof.band_begin) / period_);
}

/// Conditions that are zero at the end, up to rounding.
void Flight::end() {
  for (std::size_t i = 0; i < proofs_.size(); ++i) {
    const Proof& proof = proofs_[i];
    const bool zero = abs(dot(flown_.flow.rows[i], X)) <= Ball(rounding * flown_.flow.size_of(i, size));
    if (proof.rests || !zero) continue;
    zeros.push_back(i);
    const double band = proof.in_band ? (segment_.duration - proof.band_begin) / period_ : 0.0;
    tally_.band = std::max(tally_.band, band);
    if (band > instant || band * period_ * flown_.flow.nu > longest_band) ++tally_.flats;
  }
}

}  // namespace verify
