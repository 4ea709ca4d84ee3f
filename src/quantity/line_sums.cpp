/// Sums exponentials of equally spaced frequencies.
#include "quantity/line_sums.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/phase.hpp"

namespace slapstick::quantity {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t most_lines_one_by_one = 12;  ///< lines that are summed one by one
constexpr std::ptrdiff_t half = 16;                ///< points of the grid on either side of a term
constexpr std::size_t points_of_line = 4;          ///< of the grid, at least

Complex phase(double turns) {
  const auto [cosine, sine] = of_turns(turns - std::floor(turns));
  return {cosine, -sine};
}

std::size_t power_of_two(std::size_t least) {
  std::size_t size = 1;
  while (size < least) size *= 2;
  return size;
}

}  // namespace

void fourier_transform(std::vector<Complex>& x) {
  const std::size_t N = x.size();
  for (std::size_t i = 1, j = 0; i < N; ++i) {  // bits in reverse order
    std::size_t bit = N / 2;
    for (; (j & bit) != 0; bit /= 2) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(x[i], x[j]);
  }
  std::vector<Complex> roots(N / 2);
  for (std::size_t k = 0; k < roots.size(); ++k) roots[k] = phase(static_cast<double>(k) / static_cast<double>(N));
  for (std::size_t size = 2; size <= N; size *= 2)
    for (std::size_t begin = 0; begin < N; begin += size)
      for (std::size_t k = 0; k < size / 2; ++k) {
        Complex &a = x[begin + k], &b = x[begin + k + size / 2];
        const Complex& root = roots[k * (N / size)];
        const Complex turned{b.real() * root.real() - b.imag() * root.imag(),
                             b.real() * root.imag() + b.imag() * root.real()};
        b = a - turned;
        a += turned;
      }
}

/// With s = points / (2 lines) the Gaussian leaves out exp(-half^2 / width), and its images add exp(-pi^2 width
/// (1 - 1/s)) to the last line. The width makes both exp(-pi half sqrt(1 - 1/s)), 4e-16 for s = 2.
LineSums::LineSums(double T, std::size_t count) : T_(T), count_(count) {
  if (count <= most_lines_one_by_one) {
    lines_.resize(count);
    return;
  }
  const std::size_t size = power_of_two(points_of_line * count);
  grid_.assign(size, 0.0);
  const double s = static_cast<double>(size) / (2.0 * static_cast<double>(count));
  width_ = static_cast<double>(half) / (std::numbers::pi * std::sqrt(1.0 - 1.0 / s));
  for (std::ptrdiff_t j = 0; j <= half; ++j) falls_.push_back(std::exp(-static_cast<double>(j * j) / width_));
}

void LineSums::add(double c, double t) {
  const double turn = t / T_ - std::floor(t / T_);
  if (grid_.empty())
    add_to_lines(c, turn);
  else
    add_to_grid(c, turn);
}

void LineSums::add_to_lines(double c, double turn) {
  constexpr std::size_t powers = 32;  // multiplied up before the phase is computed anew
  const Complex z = phase(turn);
  for (std::size_t first = 0; first < lines_.size(); first += powers) {
    Complex p = c * phase(static_cast<double>(first) * turn);
    const std::size_t last = std::min(first + powers, lines_.size());
    for (std::size_t k = first; k < last; ++k) {
      lines_[k] += p;
      p = {p.real() * z.real() - p.imag() * z.imag(), p.real() * z.imag() + p.imag() * z.real()};
    }
  }
}

/// exp(-(x - j)^2 / width) = exp(-x^2 / width) exp(2 x / width)^j exp(-j^2 / width), x in [0, 1).
void LineSums::add_to_grid(double c, double turn) {
  const std::size_t size = grid_.size(), mask = size - 1;
  const double place = turn * static_cast<double>(size), whole = std::floor(place), x = place - whole;
  const auto at = static_cast<std::size_t>(whole);
  const double middle = c * std::exp(-x * x / width_), rise = std::exp(2.0 * x / width_), fall = 1.0 / rise;
  double up = middle, down = middle;
  grid_[at & mask] += middle;
  for (std::size_t j = 1; j < static_cast<std::size_t>(half); ++j) {
    up *= rise;
    down *= fall;
    grid_[(at + j) & mask] += up * falls_[j];
    grid_[(at + size - j) & mask] += down * falls_[j];
  }
  up *= rise;
  grid_[(at + static_cast<std::size_t>(half)) & mask] += up * falls_.back();
}

std::vector<Complex> LineSums::take() {
  if (!grid_.empty()) return from_grid();
  std::vector<Complex> sums(lines_.size());
  std::swap(sums, lines_);
  return sums;
}

/// The transform of exp(-x^2 / width) at k / N: sqrt(pi width) exp(-width (pi k / N)^2).
std::vector<Complex> LineSums::from_grid() {
  std::vector<Complex> x(grid_.begin(), grid_.end());
  fourier_transform(x);
  std::vector<Complex> sums(count_);
  const double N = static_cast<double>(grid_.size()), scale = std::sqrt(std::numbers::pi * width_);
  for (std::size_t k = 0; k < count_; ++k) {
    const double turn = std::numbers::pi * static_cast<double>(k) / N;
    sums[k] = x[k] * (std::exp(width_ * turn * turn) / scale);
  }
  std::fill(grid_.begin(), grid_.end(), 0.0);
  return sums;
}

}  // namespace slapstick::quantity
