/// Expands rows into series, four at once, and encloses what they leave out. Compiled for each instruction set
/// (event/kernels.hpp).
#include "event/expansion.hpp"

#include <cmath>

#include "event/kernels.hpp"

namespace slapstick::event {
namespace {

/// As many of the four lanes as a register of the target has.
#if defined(__AVX__)
typedef double Part __attribute__((vector_size(32), may_alias));
#else
typedef double Part __attribute__((vector_size(16), may_alias));
#endif
constexpr int parts = sizeof(Lane4) / sizeof(Part);

Part* part_of(Lane4* lanes, int part) { return reinterpret_cast<Part*>(lanes) + part; }
inline Part size_of(const Part& x) { return x < 0.0 ? -x : x; }
inline Part larger_of(const Part& a, const Part& b) { return a > b ? a : b; }
inline double greatest_of(const Part& x) {
  double most = x[0];
  for (int k = 1; k < static_cast<int>(sizeof(Part) / sizeof(double)); ++k) most = x[k] > most ? x[k] : most;
  return most;
}

/// high + low += x + rest, what the sum rounds off included.
[[gnu::always_inline]] inline void add(Part& high, Part& low, const Part& x, const Part& rest) {
  const Part sum = high + x, part = sum - high;
  low += ((high - (sum - part)) + (x - part)) + rest;
  high = sum;
}

/// 2^-floor(log2 n)
inline double halving(int n) {
  double factor = 1.0;
  for (; n > 1; n /= 2) factor *= 0.5;
  return factor;
}

/// t'_n from t'_{n-1}. All arrays have a stride of `parts`.
inline void step(const Expansion& e, double factor, const Part* high, const Part* low, Part* upper, Part* next_high,
                 Part* next_low) {
  for (int k = 0; k < e.m * parts; k += parts) {
    const Part c = 0x8000001p0 * high[k];
    upper[k] = c - (c - high[k]);
  }
  for (int j = 0; j < e.m; ++j) {
    Part sum{}, rest{};
    for (int at = e.column_ends[j]; at < e.column_ends[j + 1]; ++at) {
      const MatrixEntry& a = e.entries[at];
      const int k = a.row * parts;
      const Part h = high[k], u = upper[k], l = h - u, p = h * a.value;
      add(sum, rest, p, (((u * a.upper - p) + u * a.lower + l * a.upper) + l * a.lower) + low[k] * a.value);
    }
    const Part total = sum + rest;
    next_high[j * parts] = factor * total;
    next_low[j * parts] = factor * (rest - (total - sum));
  }
}

/// The same in doubles, and a bound of its error: `error` of the term before, and what q products and sums round.
inline void rough_step(const Expansion& e, double factor, const Part* term, const Part* error, Part* next,
                       Part* next_error) {
  for (int j = 0; j < e.m; ++j) {
    Part sum{}, size{}, carried{};
    for (int at = e.column_ends[j]; at < e.column_ends[j + 1]; ++at) {
      const MatrixEntry& a = e.entries[at];
      const int k = a.row * parts;
      const double magnitude = a.value < 0.0 ? -a.value : a.value;
      sum += term[k] * a.value;
      size += size_of(term[k]) * magnitude;
      carried += error[k] * magnitude;
    }
    const double roundings = (e.column_ends[j + 1] - e.column_ends[j] + 4) * unit_roundoff;
    next[j * parts] = factor * sum;
    next_error[j * parts] = factor * (carried + roundings * size);
  }
}

/// e'_n from e'_{n-1}.
inline void error_step(const Expansion& e, double factor, const Part* term, const Part* error, Part* next_error) {
  for (int j = 0; j < e.m; ++j) {
    Part sum{};
    for (int at = e.column_ends[j]; at < e.column_ends[j + 1]; ++at) {
      const MatrixEntry& a = e.entries[at];
      const int k = a.row * parts;
      sum += error[k] * (a.value < 0.0 ? -a.value : a.value) + unit_roundoff * size_of(term[k]) * a.size;
    }
    next_error[j * parts] = factor * sum;
  }
}

/// The largest size of each block of columns.
inline void note_peaks(const Expansion& e, const Part* term, Part* peaks) {
  for (int b = 0; b < blocks; ++b) {
    Part most{};
    for (int i = e.block_ends[b]; i < e.block_ends[b + 1]; ++i) most = larger_of(most, size_of(term[i * parts]));
    peaks[b * parts] = most;
  }
}

void expand_part(const Expansion& e, int group, int part) {
  const auto row = static_cast<std::ptrdiff_t>(e.m) * parts;
  Part* const high = part_of(e.high + static_cast<std::ptrdiff_t>(group) * all_terms * e.m, part);
  Part* const low = part_of(e.low + static_cast<std::ptrdiff_t>(group) * terms * e.m, part);
  Part* const dropped = part_of(e.dropped + static_cast<std::ptrdiff_t>(group) * (all_terms - terms) * e.m, part);
  Part* const errors = part_of(e.errors + static_cast<std::ptrdiff_t>(group) * error_terms * e.m, part);
  Part* const peaks = part_of(e.peaks + static_cast<std::ptrdiff_t>(group) * (terms + 1) * blocks, part);
  Part *const scratch = part_of(e.scratch, part), *const other = scratch + row;
  for (std::ptrdiff_t k = 0; k < row; k += parts) low[k] = errors[k] = Part{};
  note_peaks(e, high, peaks);
  for (int n = 1; n < terms; ++n) {
    step(e, halving(n), high + (n - 1) * row, low + (n - 1) * row, scratch, high + n * row, low + n * row);
    note_peaks(e, high + n * row, peaks + n * blocks * parts);
  }
  for (int n = 1; n < error_terms; ++n)
    error_step(e, halving(n), high + (n - 1) * row, errors + (n - 1) * row, errors + n * row);
  for (std::ptrdiff_t k = 0; k < row; k += parts)
    scratch[k] = 2.0 * unit_roundoff * size_of(high[(terms - 1) * row + k]);
  Part *error = scratch, *next_error = other;
  for (int n = terms; n < all_terms; ++n) {
    rough_step(e, halving(n), high + (n - 1) * row, error, high + n * row, next_error);
    for (std::ptrdiff_t k = 0; k < row; k += parts)
      dropped[(n - terms) * row + k] = size_of(high[n * row + k]) + next_error[k];
    Part* const swapped = error;
    error = next_error;
    next_error = swapped;
  }
  note_peaks(e, dropped + (all_terms - 1 - terms) * row, peaks + terms * blocks * parts);
}

/// The scales of the blocks, by rows: the largest kept term of the row itself, or of the displacements, the latter
/// times what the row has of them.
void set_scales(const Expansion& e, const double* weights) {
  double common[blocks] = {};
  for (int group = 0; group < e.groups; ++group)
    for (int part = 0; part < parts; ++part) {
      const Part* const peaks = part_of(e.peaks + static_cast<std::ptrdiff_t>(group) * (terms + 1) * blocks, part);
      Part* const scales = part_of(e.scales + group * blocks, part);
      const Part reads = *part_of(e.displacements + group, part);
      for (int b = 0; b < blocks; ++b) {
        Part most{};
        for (int n = 0; n < terms; ++n) most = larger_of(most, weights[n] * peaks[(n * blocks + b) * parts]);
        scales[b * parts] = most;
        const double greatest = greatest_of(reads * most);
        common[b] = greatest > common[b] ? greatest : common[b];
      }
    }
  for (int group = 0; group < e.groups; ++group)
    for (int part = 0; part < parts; ++part) {
      Part* const scales = part_of(e.scales + group * blocks, part);
      Part share{};
      for (int b = 0; b < blocks; ++b)
        if (common[b] > 0.0) share = larger_of(share, scales[b * parts] / common[b]);
      for (int b = 0; b < blocks; ++b) scales[b * parts] = larger_of(scales[b * parts], share * common[b]);
    }
}

/// Of one part of a group: nu, the largest |T_39| over its scale, and by how much the scales of blocks are raised.
struct Rest {
  Part nu, last, raised[blocks];
};

/// The largest sum over a column of a block of what leads to it: from other blocks, and from its own.
inline Part led_to(const Expansion& e, const Part* scales, int b, Part own) {
  Part most{};
  for (int i = e.block_ends[b]; i < e.block_ends[b + 1]; ++i) {
    Part sum{};
    for (int from = 0; from < blocks; ++from) sum += (from == b ? own : scales[from * parts]) * e.reach[from * e.m + i];
    most = larger_of(most, sum);
  }
  return most;
}

/// The norm of A H in which a row t counts max_i |t_i| / scale_i, and that of T_39. Columns that no row reaches have no
/// scale.
///
/// What moves by the clock acts on all bodies of a machine at once, and nothing leads back: its scales are raised until
/// the norm of its columns is half of what the tail's bound allows. Else many bodies would have no window at all.
inline Rest rest_of(const Expansion& e, const Part* scales, const Part* last_peaks, double ratio, double last_weight) {
  constexpr int clock = 2;  // the first block
  Rest rest{};
  for (int b = 0; b < blocks; ++b) {
    const Part none{}, one = none + 1.0, scale = scales[b * parts], unreached = none + INFINITY;
    Part most = led_to(e, scales, b, scale);
    const Part over = scale > 0.0 ? ratio * most / (0.5 * all_terms * scale) : none;
    rest.raised[b] = b < clock ? one : larger_of(one, over);
    const Part size = rest.raised[b] * scale;
    if (b >= clock) most = led_to(e, scales, b, size);
    rest.nu = larger_of(rest.nu, most > 0.0 ? (scale > 0.0 ? most / size : unreached) : none);
    rest.last = larger_of(rest.last, scale > 0.0 ? last_weight * last_peaks[b * parts] / size : none);
  }
  rest.nu *= ratio;
  return rest;
}

}  // namespace

namespace SLAPSTICK_KERNEL {

void expand(const Expansion& e) {
  for (int group = 0; group < e.groups; ++group)
    for (int part = 0; part < parts; ++part) expand_part(e, group, part);
}

double excess(const Expansion& e, const double* weights, double ratio) {
  set_scales(e, weights);
  Part worst{};
  for (int group = 0; group < e.groups; ++group)
    for (int part = 0; part < parts; ++part) {
      const Part* const dropped =
          part_of(e.dropped + static_cast<std::ptrdiff_t>(group) * (all_terms - terms) * e.m, part);
      const Part* const peaks = part_of(e.peaks + static_cast<std::ptrdiff_t>(group) * (terms + 1) * blocks, part);
      const Part* const scales = part_of(e.scales + group * blocks, part);
      const Rest of_rest = rest_of(e, scales, peaks + terms * blocks * parts, ratio, weights[all_terms - 1]);
      const Part none{}, unbounded = none + INFINITY, nu = of_rest.nu, last = of_rest.last;
      const Part share =
          last > 0.0 ? (nu < 1.0 * all_terms ? last * (nu / all_terms) / (1.0 - nu / (all_terms + 1)) : unbounded)
                     : none;
      for (int b = 0; b < blocks; ++b) {
        const Part scale = scales[b * parts];
        Part most{};
        for (int i = e.block_ends[b]; i < e.block_ends[b + 1]; ++i) {
          Part sum{};
          for (int n = terms; n < all_terms; ++n) sum += weights[n] * dropped[((n - terms) * e.m + i) * parts];
          most = larger_of(most, sum);
        }
        const Part over = most / (0.25 * unit_roundoff * scale),
                   beyond = share * of_rest.raised[b] * (4.0 / unit_roundoff);
        worst = larger_of(worst, scale > 0.0 ? over + beyond : (most > 0.0 ? unbounded : none));
      }
    }
  return greatest_of(worst);
}

void enclose_tails(const Expansion& e, const double* weights, double ratio) {
  set_scales(e, weights);
  for (int group = 0; group < e.groups; ++group)
    for (int part = 0; part < parts; ++part) {
      const auto row = static_cast<std::ptrdiff_t>(e.m) * parts;
      const Part* const dropped =
          part_of(e.dropped + static_cast<std::ptrdiff_t>(group) * (all_terms - terms) * e.m, part);
      const Part* const peaks = part_of(e.peaks + static_cast<std::ptrdiff_t>(group) * (terms + 1) * blocks, part);
      const Part* const scales = part_of(e.scales + group * blocks, part);
      Part* const tails = part_of(e.tails + static_cast<std::ptrdiff_t>(group) * 3 * e.m, part);
      const Rest of_rest = rest_of(e, scales, peaks + terms * blocks * parts, ratio, weights[all_terms - 1]);
      const Part none{}, unbounded = none + INFINITY, nu = of_rest.nu, last = of_rest.last,
                         left = nu / (1.0 - nu / all_terms);
      const auto bounded = [&](const Part& x) {
        return last > 0.0 ? (nu < 1.0 * all_terms ? last * x : unbounded) : none;
      };
      const Part value = bounded((nu / all_terms) / (1.0 - nu / (all_terms + 1))), slope = bounded(left),
                 curvature = bounded(nu * (all_terms - 1.0) + nu * left);
      for (int b = 0; b < blocks; ++b)
        for (int i = e.block_ends[b]; i < e.block_ends[b + 1]; ++i) {
          Part sum{}, first{}, second{};
          for (int n = terms; n < all_terms; ++n) {
            const Part term = weights[n] * dropped[(n - terms) * row + i * parts];
            sum += term;
            first += n * term;
            second += n * (n - 1.0) * term;
          }
          const Part scale = of_rest.raised[b] * scales[b * parts];
          const auto at = i * parts;
          tails[at] = value < unbounded ? sum + value * scale : unbounded;
          tails[row + at] = value < unbounded ? first + slope * scale : unbounded;
          tails[2 * row + at] = value < unbounded ? second + curvature * scale : unbounded;
        }
    }
}

/// From the last term on: the sums S_j of the terms n >= j, and the sum of S_j over j >= 1, which is that of n T_n.
void finish(const Expansion& e, const Weights& w) {
  for (int group = 0; group < e.groups; ++group)
    for (int part = 0; part < parts; ++part) {
      const auto row = static_cast<std::ptrdiff_t>(e.m) * parts;
      Part* const high = part_of(e.high + static_cast<std::ptrdiff_t>(group) * all_terms * e.m, part);
      const Part* const low = part_of(e.low + static_cast<std::ptrdiff_t>(group) * terms * e.m, part);
      Part* const ends = part_of(e.ends + static_cast<std::ptrdiff_t>(group) * 4 * e.m, part);
      for (std::ptrdiff_t i = 0; i < row; i += parts) {
        Part sum{}, rest{}, slope{}, slope_rest{};
        for (int n = all_terms - 1; n >= terms; --n) {
          sum += high[n * row + i] * w.high[n];
          slope += sum;
        }
        for (int n = terms - 1; n >= 0; --n) {
          const Part h = high[n * row + i], c = 0x8000001p0 * h, u = c - (c - h), l = h - u, p = h * w.high[n];
          const Part lost = (((u * w.upper[n] - p) + u * w.lower[n] + l * w.upper[n]) + l * w.lower[n]) +
                            (h * w.low[n] + low[n * row + i] * w.high[n]);
          const Part term = p + lost;
          high[n * row + i] = term;
          add(sum, rest, term, lost - (term - p));
          if (n > 0) add(slope, slope_rest, sum, rest);
        }
        ends[i] = sum;
        ends[row + i] = rest;
        ends[2 * row + i] = slope;
        ends[3 * row + i] = slope_rest;
      }
    }
}

}  // namespace SLAPSTICK_KERNEL

}  // namespace slapstick::event
