#pragma once
/// What a motion spends its time in, compiled from one text for every instruction set, and chosen when the program runs.
///
/// All work in lanes of eight doubles and in one order, so that each gives the same bits; wider vectors only do more lanes at once. Their sources
/// (first_root.cpp, products.cpp) are compiled once a target, in its own namespace; tools/check_objects proves that they define nothing that the
/// linker might take for another target's.
#include <vector>

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
  /// Is every lane of sum_i data[i] x[i] above the bound?
  bool (*all_above)(const Lane8* data, int m, const double* x, double bound);
  /// Of d rows of 24 Taylor coefficients each (3 m groups): their values and derivatives at x.
  void (*evaluate)(const Lane8* rows, int d, int m, const double* X, double x, double* values, double* slopes);
  /// out = sum of values[i] x[place[i]], i < count.
  void (*gather)(const int* places, const Lane8* values, int count, const double* x, Lane8* out);
  /// out = factor (sum of rows times the eight numbers from their place on + sum of columns times the number at their place).
  void (*spread)(const Placed* rows, const Placed* rows_end, const Placed* columns, const Placed* columns_end, double factor, const double* x,
                 Lane8* out);
};

/// The kernels that run: those of the environment's SLAPSTICK_TARGET, otherwise the widest that this processor has.
/// @throws InputError if SLAPSTICK_TARGET names none, or one that this processor lacks
/// @throws NumericalError if the processor does not compute as IEEE 754 says
const Kernels& kernels();

#if defined(SLAPSTICK_KERNEL)
namespace SLAPSTICK_KERNEL {
Root first_root(const GuardWindow& guard, double x_end, long& evaluations);
}
#endif

}  // namespace slapstick::event
