#pragma once
/// A checksum of 64 bits (FNV-1a): any one byte that changes changes the sum.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace slapstick::store {

class Checksum {
 public:
  Checksum& add(const void* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      sum_ = (sum_ ^ static_cast<const unsigned char*>(bytes)[i]) * 0x100000001b3U;
    return *this;
  }
  /// With their number, so that nothing slips from one list into the next.
  Checksum& add(const std::vector<double>& numbers) {
    return add(static_cast<std::int64_t>(numbers.size())).add(numbers.data(), numbers.size() * sizeof(double));
  }
  Checksum& add(std::string_view text) {
    return add(static_cast<std::int64_t>(text.size())).add(text.data(), text.size());
  }
  Checksum& add(std::int64_t number) { return add(&number, sizeof number); }

  [[nodiscard]] std::int64_t sum() const { return static_cast<std::int64_t>(sum_); }
  /// Sixteen hexadecimal digits.
  [[nodiscard]] std::string text() const {
    std::string digits;
    for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[sum_ >> shift & 0xfU];
    return digits;
  }

 private:
  std::uint64_t sum_ = 0xcbf29ce484222325U;
};

}  // namespace slapstick::store
