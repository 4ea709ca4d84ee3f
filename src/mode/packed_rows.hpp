#pragma once
/// Operators of eight rows on X, one after the other, of which only some columns are kept: those that are not zero, or
/// not small. A guard of a large model sees the contacts and coordinates near it.
#include <vector>

#include "event/kernels.hpp"

namespace slapstick::mode {

class PackedRows {
 public:
  /// Adds a column to the operator that is being stored ..
  void add(int column, const event::Lane8& values) {
    columns_.push_back(column);
    values_.push_back(values);
  }
  /// .. which is complete now.
  void close() { ends_.push_back(static_cast<int>(columns_.size())); }
  [[nodiscard]] bool empty() const { return ends_.size() == 1; }

  /// out = the sum of x_i times column i of operator k.
  void multiply(const event::Kernels& kernels, int k, const double* x, event::Lane8& out) const {
    kernels.gather(columns_.data() + ends_[k], values_.data() + ends_[k], ends_[k + 1] - ends_[k], x, &out);
  }

 private:
  std::vector<int> ends_ = {0};  ///< where operator k begins, and the last one ends
  std::vector<int> columns_;
  event::Lanes values_;
};

}  // namespace slapstick::mode
