#pragma once
/// Operators of eight rows on X, one after the other, of which only some columns are kept: those that are not zero, or not small. A guard of a large
/// model sees the contacts and coordinates near it.
#include <vector>

#include "event/window.hpp"

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

  /// The sum of x_i times column i of operator k.
  [[nodiscard]] event::Lane8 times(int k, const double* x) const {
    event::Lane8 even{}, odd{};  // two chains: an addition waits for the one before it
    int i = ends_[k];
    const int end = ends_[k + 1];
    for (; i + 2 <= end; i += 2) {
      even += values_[i] * x[columns_[i]];
      odd += values_[i + 1] * x[columns_[i + 1]];
    }
    return i < end ? even + values_[i] * x[columns_[i]] + odd : even + odd;
  }

 private:
  std::vector<int> ends_ = {0};  ///< where operator k begins, and the last one ends
  std::vector<int> columns_;
  event::Lanes values_;
};

}  // namespace slapstick::mode
