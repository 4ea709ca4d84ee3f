#pragma once
/// Random numbers that depend on a seed and a batch's number only: the same campaign for any number of threads.
#include <cmath>
#include <cstdint>

namespace campaign {

/// splitmix64 (Steele, Lea and Flood 2014).
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t batch) : state_(seed * 0x9e3779b97f4a7c15u) {
    state_ ^= next() + batch * 0xd1342543de82ef95u;
    next();
  }

  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  /// In [low, high).
  double uniform(double low, double high) { return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53; }
  /// 10^uniform.
  double decades(double low, double high) { return std::pow(10.0, uniform(low, high)); }
  /// 0 .. count - 1.
  int below(int count) { return static_cast<int>((next() >> 32) * static_cast<std::uint64_t>(count) >> 32); }
  bool one_in(int count) { return below(count) == 0; }
  double sign() { return one_in(2) ? 1.0 : -1.0; }

 private:
  std::uint64_t state_;
};

}  // namespace campaign
