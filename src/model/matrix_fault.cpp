/// Finds what is wrong with a model's matrices.
#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/text.hpp"
#include "model/fault.hpp"

namespace slapstick {
namespace {

using Found = std::optional<Fault>;

/// mass, damping or stiffness, as rows and columns that coordinates name.
class NamedMatrix {
 public:
  NamedMatrix(const Model& model, const char* field, const SymmetricMatrix& entries)
      : model_(model), field_(field), entries_(entries), n_(model.coordinates.size()) {}

  [[nodiscard]] Found fault() const {
    if (entries_.empty()) return std::nullopt;
    if (entries_.size() != n_ * n_)
      return wrong("has " + std::to_string(entries_.size()) + " entries, " + std::to_string(n_ * n_) + " needed");
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = 0; j < n_; ++j) {
        if (!std::isfinite(at(i, j))) return wrong(label(i, j) + " is not a finite number");
        if (std::abs(at(i, j)) > largest)
          return wrong(label(i, j) + " is too large: beyond 1e50 the arithmetic would overflow");
      }
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (at(i, j) != at(j, i))
          return wrong("the matrix is not symmetric: " + label(i, j) + " differs from " + label(j, i));
    return std::nullopt;
  }

 private:
  [[nodiscard]] double at(std::size_t i, std::size_t j) const { return entries_[i * n_ + j]; }
  [[nodiscard]] std::string label(std::size_t i, std::size_t j) const {
    return std::string("[") + model_.coordinates[i].name + ", " + model_.coordinates[j].name + "] = " + shown(at(i, j));
  }
  [[nodiscard]] Found wrong(const std::string& what) const {
    return Fault{"matrix", -1, field_, std::string(field_) + ": " + what};
  }

  const Model& model_;
  const char* field_;
  const SymmetricMatrix& entries_;
  std::size_t n_;
};

/// Cholesky's factorisation of the coordinates' masses plus the mass matrix; a pivot that is not clearly positive is
/// the fault. Inner coordinates have none, and no rows beside the diagonal (first_inner_fault).
Found mass_fault(const Model& model) {
  const std::size_t n = model.coordinates.size();
  std::vector<double> total = model.mass;
  for (std::size_t i = 0; i < n; ++i) {
    total[i * n + i] += model.is_inner(static_cast<int>(i)) ? 1.0 : model.coordinates[i].mass;
    if (total[i * n + i] < smallest)
      return Fault{
          "coordinate", static_cast<int>(i), "mass",
          "the coordinate has no mass: its own and its entry of [matrix] mass add up to " + shown(total[i * n + i])};
  }
  const double rounding = static_cast<double>(n) * 0x1p-51;
  for (std::size_t k = 0; k < n; ++k) {
    const double before = total[k * n + k];
    double pivot = before;
    for (std::size_t j = 0; j < k; ++j) pivot -= total[k * n + j] * total[k * n + j];
    if (!(pivot > rounding * before))
      return Fault{
          "matrix", -1, "mass",
          "mass: with the coordinates' masses it is not positive definite: some motion of the coordinates up to " +
              in_quotes(model.coordinates[k].name) + " has no positive mass"};
    const double root = std::sqrt(pivot);
    total[k * n + k] = root;
    for (std::size_t i = k + 1; i < n; ++i) {
      double entry = total[i * n + k];
      for (std::size_t j = 0; j < k; ++j) entry -= total[i * n + j] * total[k * n + j];
      total[i * n + k] = entry / root;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Fault> first_matrix_fault(const Model& model) {
  if (auto fault = NamedMatrix(model, "mass", model.mass).fault()) return fault;
  if (auto fault = NamedMatrix(model, "damping", model.damping).fault()) return fault;
  if (auto fault = NamedMatrix(model, "stiffness", model.stiffness).fault()) return fault;
  return model.mass.empty() ? std::nullopt : mass_fault(model);
}

}  // namespace slapstick
