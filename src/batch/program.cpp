/// The numbers of a flat program: a mode's rows, its window and its norms.
#include "batch/program.hpp"

#include <algorithm>
#include <cmath>

#include "batch/constants.hpp"
#include "batch/shape.hpp"
#include "flow/chatter.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::batch {
namespace {

/// The norm of the states of a mode: the largest of |p_i|, |u_i| / speed and `least`, which streams and the constant
/// count as. |A X| <= rate |X|.
struct Norm {
  double speed = 1.0, least = 1.0, rate = 1.0;
};

/// Sums of sizes of the entries of u_i': over p, over u, over streams and the constant.
struct RowSizes {
  double p = 0.0, u = 0.0, f = 0.0;
};

RowSizes sizes_of(const mode::RowVector& row, int n) {
  const auto sizes = row.cwiseAbs();
  return {sizes.head(n).sum(), sizes.segment(n, n).sum(), sizes.tail(row.size() - 2 * n).sum()};
}

/// With speed = rate - drift / least:  |p'| <= |u| + drift <= rate |X|, and |u_i'| <= (p + u speed + f / least) |X|
/// <= speed^2 |X|, where least >= f / (speed^2 - p - u speed). A tenth more than the rate without forces leaves room
/// for those.
Norm norm_of(const mode::Matrix& system, const mode::Frame& frame, double fastest_stream) {
  double slowest = 0.5 / frame.period, drift = 0.0;
  std::vector<RowSizes> rows;
  for (int i = 0; i < frame.n; ++i) {
    const RowSizes row = rows.emplace_back(sizes_of(system.row(frame.n + i), frame.n));
    slowest = std::max(slowest, 1.1 * 0.5 * (row.u + std::sqrt(row.u * row.u + 4.0 * row.p)));
    drift = std::max(drift, std::abs(frame.drift[i]));
  }
  Norm norm;
  norm.speed = std::max(slowest, fastest_stream);
  norm.least = 10.0 * drift / norm.speed;
  for (const RowSizes& row : rows) {
    norm.least = std::max(norm.least, row.f / (norm.speed * norm.speed - row.p - row.u * norm.speed));
    if (row.p > 0.0) norm.least = std::max(norm.least, row.f / row.p);  // about what a displacement is
  }
  norm.least = norm.least > 0.0 ? norm.least * (1.0 + 0x1p-40) : 1.0;
  norm.rate = norm.speed + drift / norm.least;
  return norm;
}

/// Writes row . (p, u, f, 1) at `out`, each part times its factor.
void write_row(const mode::RowVector& row, const Shape& shape, const mode::Frame& frame, double p, double u, double f,
               double* out) {
  const int n = frame.n, k = shape.layout.k;
  for (int i = 0; i < n; ++i) {
    out[i] = p * row[i];
    out[n + i] = u * row[n + i];
  }
  for (int s = 0; s < k; ++s) {
    const auto h =
        std::find(frame.harmonics.begin(), frame.harmonics.end(), shape.harmonic[static_cast<std::size_t>(s)]) -
        frame.harmonics.begin();
    out[2 * n + s] = f * row[2 * n + 2 * h + (shape.cosine_of[static_cast<std::size_t>(s)] != 0 ? 0 : 1)];
  }
  out[2 * n + k] = f * row[frame.one()];
}

void write_slot(const SlotRows& slot, const Shape& shape, const mode::Frame& frame, const Norm& norm, double H, int s,
                double* words) {
  const Layout& at = shape.layout;
  write_row(slot.row, shape, frame, 1.0, 1.0 / H, 1.0, words + at.slot(s));
  const RowSizes sizes = sizes_of(slot.row, frame.n);
  double* const numbers = words + at.slot_number(s, 0);
  numbers[Layout::lower] = slot.limit;
  numbers[Layout::upper] = slot.guard[at_upper] >= 0 ? slot.limit : no_limit;
  numbers[Layout::norm] = (sizes.p + norm.speed * sizes.u + sizes.f / norm.least) * (1.0 + 0x1p-40);
  numbers[Layout::start_norm] = slot.slot.own >= 0 ? 0.0 : numbers[Layout::norm];
  numbers[Layout::linked] = slot.slot.gap >= 0 ? 1.0 : 0.0;
  if (slot.slot.gap < 0) return;
  const mode::ContactRow& stop = frame.stops[static_cast<std::size_t>(slot.slot.gap)];
  words[at.gap(s) + stop.own] = -stop.sign;
}

}  // namespace

ModelWords model_words(const Model& model, const mode::Frame& frame) {
  ModelWords words;
  words.period = frame.period;
  for (std::size_t i = 0; i < model.stops.size(); ++i) {
    const mode::ContactRow& stop = frame.stops[i];
    words.restitution[i] = model.stops[i].restitution;
    for (int j = 0; j < frame.n; ++j)
      words.impulse[i][j] = -(1.0 + words.restitution[i]) *
                            (stop.sign * frame.mass_inverse(j, stop.own) / frame.mass_inverse(stop.own, stop.own));
  }
  for (std::size_t i = 0; i < model.compliant_stops.size(); ++i)
    words.zero_force_rate[i] = -model.compliant_stops[i].stiffness / model.compliant_stops[i].damping;
  return words;
}

bool make_words(const Model& model, const mode::Frame& frame, Shape& shape, int mode, double* words) {
  const mode::Outline outline(model, frame, states_of(shape, mode));
  const std::vector<SlotRows> slots = slots_of(outline, frame);
  if (slots.size() > static_cast<std::size_t>(shape.layout.slots)) return false;
  if (shape.known[static_cast<std::size_t>(mode)] == 0) add_mode(model, frame, outline, slots, mode, shape);
  if (!has_shape(shape, mode, slots)) return false;
  const Layout& at = shape.layout;
  double fastest = 0.0;
  for (const int j : shape.harmonic) fastest = std::max(fastest, j * model.omega);
  const Norm norm = norm_of(outline.system, frame, fastest);
  const double H = longest_window / norm.rate;
  std::fill_n(words, at.size(), 0.0);
  words[Layout::window] = H;
  words[Layout::window_periods] = H / frame.period;
  words[Layout::inverse_speed] = (1.0 + 0x1p-40) / norm.speed;
  words[Layout::least_size] = norm.least;
  words[Layout::chatter] = 2.0 *
                           flow::fastest_chatter(MotionOptions{}.chatter_tolerance * frame.period * frame.period) *
                           norm.rate * norm.rate;
  for (int s = 0; s < at.k; ++s) {
    const double rate = shape.harmonic[static_cast<std::size_t>(s)] * model.omega * H;
    words[Layout::rates + s] = rate;
  }
  for (int i = 0; i < at.n; ++i) {
    words[at.drift(i)] = frame.drift[i] * H;
    write_row(outline.system.row(at.n + i), shape, frame, H * H, H, H * H, words + at.row(i));
  }
  for (int s = 0; s < static_cast<int>(slots.size()); ++s)
    write_slot(slots[static_cast<std::size_t>(s)], shape, frame, norm, H, s, words);
  return true;
}

}  // namespace slapstick::batch
