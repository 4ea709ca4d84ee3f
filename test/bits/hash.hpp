#pragma once
/// A hash of numbers, all bits of a double: FNV-1a (Fowler, Noll, Vo) of bytes, the least significant of a number
/// first.
#include <cstdint>
#include <cstring>

namespace slapstick {

class Hash {
 public:
  void add(std::uint64_t bits) {
    for (int byte = 0; byte < 8; ++byte, bits >>= 8) value_ = (value_ ^ (bits & 255)) * 1099511628211U;
  }
  void add(double x) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    add(bits);
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037U;
};

}  // namespace slapstick
