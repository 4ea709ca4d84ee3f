#pragma once
/// The graph whose edges are pairs of bodies that are joined: rows x_a - x_b are independent if and only if their edges
/// form no loop. So ranks are exact, and no number is compared with zero.
#include <numeric>
#include <vector>

#include "certificate.hpp"

namespace verify {

class Bodies {
 public:
  explicit Bodies(int n) : root_(static_cast<std::size_t>(n) + 1) { std::iota(root_.begin(), root_.end(), 0U); }
  /// False if they were joined already.
  bool join(const Pair& pair) {
    const std::size_t a = root(pair.a), b = root(pair.b);
    root_[a] = b;
    return a != b;
  }
  [[nodiscard]] bool joined(const Pair& pair) const { return root(pair.a) == root(pair.b); }

 private:
  [[nodiscard]] std::size_t root(int body) const {
    std::size_t k = body == ground ? root_.size() - 1 : static_cast<std::size_t>(body);
    while (root_[k] != k) k = root_[k];
    return k;
  }
  std::vector<std::size_t> root_;  ///< the ground is the last
};

}  // namespace verify
