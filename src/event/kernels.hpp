#pragma once
/// What a motion spends its time in, compiled from one text for every instruction set, and chosen when the program
/// runs.
///
/// All work in lanes of eight doubles and in one order, so that each gives the same bits; wider vectors only do more
/// lanes at once. Their sources (first_root.cpp, products.cpp, expansion.cpp) are compiled once a target, in its own
/// namespace; tools/check_objects proves that they define nothing that the linker might take for another target's.
#include <vector>

#include "event/expansion.hpp"
#include "event/first_root.hpp"

namespace slapstick::event {

/// Eight numbers and the place of what they multiply.
struct Placed {
  int place;
  Lane8 values;
};
using PlacedRows = std::vector<Placed, LaneAllocator<Placed>>;

/// Vectors pass by address: how they would by value depends on the instruction set.
struct Kernels {
  const char* name;  ///< "scalar" (what every processor of this kind has), "sse4", "avx2" or "avx512"
  Root (*first_root)(const GuardWindow& guard, double x_end, long& evaluations);
  /// out[b] = sum_i data[b m + i] x[i], b < blocks, i < m.
  void (*multiply)(const Lane8* data, int blocks, int m, const double* x, Lane8* out);
  /// From window to window: out = step x as by `multiply`, magnitude = max(|out|, floor),
  /// largest = max(largest, |out|), or of |x| and |out| where a flight is `fresh`. All of `blocks` lanes.
  /// `sizes`: the sums of magnitude and of largest.
  void (*pass)(const Lane8* step, int blocks, int m, const Lane8* x, const Lane8* floor, bool fresh, Lane8* out,
               Lane8* magnitude, Lane8* largest, double* sizes);
  /// magnitude = max(|x|, floor), of `blocks` lanes. @returns its sum
  double (*magnitudes)(const Lane8* x, const Lane8* floor, int blocks, Lane8* magnitude);
  /// A guard's hull: bernstein = sum_i rows[i] x[i], bounds = sum_i errors[i] magnitude[i]. @returns whether it is
  /// above its error and `more`
  bool (*hull)(const Lane8* rows, const Lane8* errors, int m, const double* x, const double* magnitude, double more,
               Hull* out);
  /// Is every lane of sum_i data[i] x[i] above the bound?
  bool (*all_above)(const Lane8* data, int m, const double* x, double bound);
  /// Of d rows of 24 Taylor coefficients each (3 m groups): their values and derivatives at x.
  void (*evaluate)(const Lane8* rows, int d, int m, const double* X, double x, double* values, double* slopes);
  /// out = sum of values[i] x[place[i]], i < count.
  void (*gather)(const int* places, const Lane8* values, int count, const double* x, Lane8* out);
  /// out = factor (sum of rows times the eight numbers from their place on + sum of columns times the number at their
  /// place).
  void (*spread)(const Placed* rows, const Placed* rows_end, const Placed* columns, const Placed* columns_end,
                 double factor, const double* x, Lane8* out);
  /// The hulls of the columns of a guard's Taylor rows, x^order divided out: m Bernstein coefficients and bounds each.
  void (*enclose)(const HullRows& rows, const Lane8* taylor, int order, int m, Lane8* bernstein, Lane8* bounds);

  // Of an Expansion, once the first row of `high` is filled in:
  void (*expand)(const Expansion& e);  ///< all terms, their bounds and peaks
  /// The largest of what the terms n >= 24 add to a row by a column, over a quarter of u times its scale, for
  /// r = `ratio`; grows like r^24.
  double (*excess)(const Expansion& e, const double* weights, double ratio);
  void (*enclose_tails)(const Expansion& e, const double* weights, double ratio);
  void (*finish)(const Expansion& e,
                 const Weights& weights);  ///< T_n, n < 24, and the values and slopes at the window's end
};

/// The kernels that run: those of the environment's SLAPSTICK_TARGET, otherwise the widest that this processor has.
/// @throws InputError if SLAPSTICK_TARGET names none, or one that this processor lacks
/// @throws NumericalError if the processor does not compute as IEEE 754 says
const Kernels& kernels();

#if defined(SLAPSTICK_KERNEL)
namespace SLAPSTICK_KERNEL {
Root first_root(const GuardWindow& guard, double x_end, long& evaluations);
void expand(const Expansion& e);
double excess(const Expansion& e, const double* weights, double ratio);
void enclose_tails(const Expansion& e, const double* weights, double ratio);
void finish(const Expansion& e, const Weights& weights);
}  // namespace SLAPSTICK_KERNEL
#endif

}  // namespace slapstick::event
