#pragma once
/// The series c exp(A s) = sum_n t_n s^n of several rows c at once, four in the lanes of a vector: t_0 = c,
/// t_{n+1} = t_n A / (n + 1).
///
/// Terms n < 24 are double-doubles (base/double_double.hpp), the later ones doubles with a bound of their rounding. A
/// term is kept as
///     t'_n = c (2^k A)^n / (2^e_1 .. 2^e_n),     e_n = floor(log2 n),
/// so that no step divides: a step is a sum of products in which what each product and sum rounds off is summed beside
/// (Ogita, Rump and Oishi, "Accurate sum and dot product", SIAM J. Sci. Comput. 26 (2005)). A window of length H takes
/// t_n H^n = t'_n w_n, w_n = r^n 2^e_1 .. 2^e_n / n!,
/// r = H / 2^k.
///
/// Rounding, relative to the sizes of what is added, u = 2^-53 and q the most entries of a column of A: the products'
/// and sums' own errors are exact and their sum loses q u of itself, less than q^2 u^2; q products with the low parts
/// lose 3 q u^2; a normalised sum u^2. Together less than (q + 2)^2 u^2 a step, and w_n and the last product 40 u^2
/// more.
///
/// The functions are kernels (event/kernels.hpp): one text for every instruction set, the same bits.
#include "event/window.hpp"

namespace slapstick::event {

inline constexpr int all_terms = 40;   ///< of which `terms` are kept
inline constexpr int error_terms = 8;  ///< whose errors by the rounding of A are known
inline constexpr int blocks = 4;       ///< of columns: displacements, velocities, phases, constant

/// An entry of 2^k A.
struct MatrixEntry {
  int row;
  double value, upper, lower;  ///< and its halves (`split`)
  double size;                 ///< the sizes of the terms that it was made of, at least |value|
};

/// w_n as double-doubles, with the halves of the high parts, and as doubles for the terms that are dropped.
struct Weights {
  double high[all_terms], upper[terms], lower[terms], low[terms];
};

/// The arrays of a group of four rows lie behind those of the group before.
struct Expansion {
  int m = 0, groups = 0;
  const int* column_ends =
      nullptr;  ///< [m + 1]: the entries of column i are those from column_ends[i] to column_ends[i + 1]
  const MatrixEntry* entries = nullptr;
  int block_ends[blocks + 1] = {};  ///< the columns of block b are those from block_ends[b] to block_ends[b + 1]
  double* reach = nullptr;          ///< [block][m]: sum of |A_ki| over the rows k of a block
  Lane4* displacements = nullptr;   ///< [1]: 1 for a row that reads a displacement, else 0
  Lane4* high = nullptr;            ///< [40][m]: t'_n, once `finish` is through T_n for n < 24
  Lane4* low = nullptr;             ///< [24][m]
  Lane4* dropped = nullptr;         ///< [16][m]: bounds of |t'_n|, n >= 24
  Lane4* errors = nullptr;          ///< [8][m]: e'_n = (e'_{n-1} |A| + u |t'_{n-1}| S) / 2^e_n
  Lane4* peaks = nullptr;           ///< [25][4]: the largest |t'_n| of each block, n < 24, and of the bound of t'_39
  Lane4* scales = nullptr;          ///< [4]: of the blocks, of the last call of `excess` or `enclose_tails`
  Lane4* tails = nullptr;           ///< [3][m]: sum |T_n|, sum n |T_n|, sum n (n - 1) |T_n| over n >= 24
  Lane4* ends = nullptr;            ///< [4][m]: sum T_n and sum n T_n over all n, each as what is rounded and the rest
  Lane4* scratch = nullptr;         ///< [2 m], shared
};

}  // namespace slapstick::event
