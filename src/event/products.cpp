/// Sums of products in lanes, and the table of this target's kernels. Compiled for each instruction set
/// (event/kernels.hpp).
#include "event/kernels.hpp"

#define SLAPSTICK_TEXT_OF(name) #name
#define SLAPSTICK_TEXT(name) SLAPSTICK_TEXT_OF(name)

namespace slapstick::event {
namespace {

/// Eight numbers at any place. To be read through a pointer of this type: a reference that a function returns has lost
/// the alignment in clang.
typedef double Loose8 __attribute__((vector_size(64), aligned(8), may_alias));

/// As many of the eight lanes as a register of the target has: gcc 12 keeps a sum in wider vectors in memory.
#if defined(__AVX512F__)
typedef double Part __attribute__((vector_size(64), may_alias));
#elif defined(__AVX__)
typedef double Part __attribute__((vector_size(32), may_alias));
#else
typedef double Part __attribute__((vector_size(16), may_alias));
#endif
constexpr int parts = sizeof(Lane8) / sizeof(Part);

/// out[b] = sum_i data[b * m + i] * x[i], for m known to the compiler.
template <int m>
inline void multiply_fixed(const Part* data, int blocks, const double* x, Part* out) {
  for (int b = 0; b < blocks; ++b, data += parts * m, out += parts)
    for (int part = 0; part < parts; ++part) {
      Part sum = data[part] * x[0];
      for (int i = 1; i < m; ++i) sum += data[parts * i + part] * x[i];
      out[part] = sum;
    }
}

/// For any m, in four chains: an addition waits for the one before it.
inline void multiply_any(const Part* data, int blocks, int m, const double* x, Part* out) {
  for (int b = 0; b < blocks; ++b, data += parts * m, out += parts)
    for (int part = 0; part < parts; ++part) {
      Part s0{}, s1{}, s2{}, s3{};
      int i = 0;
      for (const Part* at = data + part; i + 4 <= m; i += 4, at += 4 * parts) {
        s0 += at[0] * x[i];
        s1 += at[parts] * x[i + 1];
        s2 += at[2 * parts] * x[i + 2];
        s3 += at[3 * parts] * x[i + 3];
      }
      for (; i < m; ++i) s0 += data[parts * i + part] * x[i];
      out[part] = (s0 + s1) + (s2 + s3);
    }
}

/// The sizes of one to three coordinates with one harmonic are unrolled.
inline void product(const Lane8* rows, int blocks, int m, const double* x, Lane8* sums) {
  const auto* const data = reinterpret_cast<const Part*>(rows);
  auto* const out = reinterpret_cast<Part*>(sums);
  switch (m) {
    case 3:
      return multiply_fixed<3>(data, blocks, x, out);
    case 5:
      return multiply_fixed<5>(data, blocks, x, out);
    case 7:
      return multiply_fixed<7>(data, blocks, x, out);
    case 9:
      return multiply_fixed<9>(data, blocks, x, out);
    default:
      return multiply_any(data, blocks, m, x, out);
  }
}

void multiply(const Lane8* data, int blocks, int m, const double* x, Lane8* out) { product(data, blocks, m, x, out); }

void pass(const Lane8* step, int blocks, int m, const Lane8* x, const Lane8* floor, bool fresh, Lane8* out, Lane8* size,
          Lane8* largest, double* sizes) {
  product(step, blocks, m, reinterpret_cast<const double*>(x), out);
  Lane8 all{}, most{};
  for (int b = 0; b < blocks; ++b) {
    const Lane8 now = magnitude(out[b]);
    all += size[b] = larger(now, floor[b]);
    most += largest[b] = larger(fresh ? magnitude(x[b]) : largest[b], now);
  }
  sizes[0] = sum(all);
  sizes[1] = sum(most);
}

double magnitudes(const Lane8* x, const Lane8* floor, int blocks, Lane8* size) {
  Lane8 all{};
  for (int b = 0; b < blocks; ++b) all += size[b] = larger(magnitude(x[b]), floor[b]);
  return sum(all);
}

bool hull(const Lane8* rows, const Lane8* errors, int m, const double* x, const double* size, double more, Hull* out) {
  product(rows, 1, m, x, &out->bernstein);
  product(errors, 1, m, size, &out->bounds);
  return all_above(out->bernstein, out->bounds[hull_error] + more);
}

bool product_above(const Lane8* data, int m, const double* x, double bound) {
  Lane8 sum;
  product(data, 1, m, x, &sum);
  return all_above(sum, bound);
}

void evaluate(const Lane8* rows, int d, int m, const double* X, double x, double* values, double* slopes) {
  const Powers powers(x);
  for (int k = 0; k < d; ++k, rows += 3 * m) {
    Coefficients a;
    product(rows, 3, m, X, a.data());
    values[k] = value(a, powers);
    slopes[k] = value(derivative(a), powers);
  }
}

void gather(const int* places, const Lane8* values, int count, const double* x, Lane8* out) {
  Lane8 even{}, odd{};  // two chains: an addition waits for the one before it
  int i = 0;
  for (; i + 2 <= count; i += 2) {
    even += values[i] * x[places[i]];
    odd += values[i + 1] * x[places[i + 1]];
  }
  *out = i < count ? even + values[i] * x[places[i]] + odd : even + odd;
}

void spread(const Placed* rows, const Placed* rows_end, const Placed* columns, const Placed* columns_end, double factor,
            const double* x, Lane8* out) {
  Lane8 even{}, odd{};
  for (; columns != columns_end; ++columns) odd += columns->values * x[columns->place];
  for (; rows_end - rows >= 2; rows += 2) {
    even += rows[0].values * *reinterpret_cast<const Loose8*>(x + rows[0].place);
    odd += rows[1].values * *reinterpret_cast<const Loose8*>(x + rows[1].place);
  }
  if (rows != rows_end) even += rows->values * *reinterpret_cast<const Loose8*>(x + rows->place);
  *out = factor * (even + odd);
}

/// Of `count` columns from the first on, which share the loads of the rows. Sums over n in one order.
template <int count>
inline void enclose_columns(const HullRows& rows, const Lane8* taylor, int order, int m, Lane8* bernstein,
                            Lane8* bounds) {
  const auto* const hull = reinterpret_cast<const Part*>(rows.bernstein);
  const auto* const error = reinterpret_cast<const Part*>(rows.bounds);
  for (int part = 0; part < parts; ++part) {
    Part sum[count]{}, bound[count]{};
    for (int n = order; n < terms; ++n) {
      const Part h = hull[(n - order) * parts + part], e = error[(n - order) * parts + part];
      const auto* const term = reinterpret_cast<const double*>(taylor + (n / 8) * m) + n % 8;
#pragma GCC unroll 4
      for (int k = 0; k < count; ++k) {
        const double a = term[8 * k];
        sum[k] += h * a;
        bound[k] += e * (a < 0.0 ? -a : a);
      }
    }
    for (int k = 0; k < count; ++k) {
      reinterpret_cast<Part*>(bernstein + k)[part] = sum[k];
      reinterpret_cast<Part*>(bounds + k)[part] = bound[k];
    }
  }
}

/// In fours; of a rest the four that end with it once more.
void enclose(const HullRows& rows, const Lane8* taylor, int order, int m, Lane8* bernstein, Lane8* bounds) {
  for (int i = 0; i < m && m < 4; ++i) enclose_columns<1>(rows, taylor + i, order, m, bernstein + i, bounds + i);
  for (int from = 0; from < m && m >= 4; from += 4) {
    const int i = from + 4 <= m ? from : m - 4;
    enclose_columns<4>(rows, taylor + i, order, m, bernstein + i, bounds + i);
  }
}

}  // namespace

namespace SLAPSTICK_KERNEL {
extern const Kernels table;
constinit const Kernels table = {SLAPSTICK_TEXT(SLAPSTICK_KERNEL),
                                 first_root,
                                 multiply,
                                 pass,
                                 magnitudes,
                                 hull,
                                 product_above,
                                 evaluate,
                                 gather,
                                 spread,
                                 enclose,
                                 expand,
                                 excess,
                                 enclose_tails,
                                 finish};
}  // namespace SLAPSTICK_KERNEL

}  // namespace slapstick::event
