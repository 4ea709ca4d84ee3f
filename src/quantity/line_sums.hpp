#pragma once
/// Sums S_k = sum_j c_j exp(-2 pi i k t_j / T), k = 0 .. count - 1, over real c_j at any instants t_j.
///
/// A few lines are summed one by one. Many lines are summed on a grid: every term is spread over 2 * half points of it
/// by a Gaussian, the grid is transformed by one FFT, and each line is divided by the transform of the Gaussian. The
/// grid has four points for each line, so that what the Gaussian leaves out and what its images add is below 1e-13 sum
/// |c_j|, as rounding is. Cost: some 30 ns a term for any number of lines, and an FFT for each call of `take`.
/// Source: Dutt and Rokhlin (1993); Greengard and Lee (2004) for the Gaussian. Threads: one at a time.
#include <complex>
#include <cstddef>
#include <vector>

namespace slapstick::quantity {

class LineSums {
 public:
  LineSums(double T, std::size_t count);

  void add(double c, double t);
  /// The sums; they begin anew.
  [[nodiscard]] std::vector<std::complex<double>> take();

 private:
  void add_to_lines(double c, double turn);
  void add_to_grid(double c, double turn);
  [[nodiscard]] std::vector<std::complex<double>> from_grid();

  double T_;
  std::size_t count_;
  std::vector<std::complex<double>> lines_;  ///< few: the sums ..
  std::vector<double> grid_;                 ///< .. many: the grid, and the factors of its Gaussian
  std::vector<double> falls_;                ///< exp(-(pi j)^2 ..) of its points
  double width_ = 0.0;                       ///< of the Gaussian exp(-x^2 / width), x in steps of the grid
};

/// In place: X_k = sum_j x_j exp(-2 pi i j k / N); N a power of two. Source: Cooley and Tukey (1965).
void fourier_transform(std::vector<std::complex<double>>& x);

}  // namespace slapstick::quantity
