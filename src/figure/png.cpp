/// A PNG encoder for indexed images that are mostly empty: one deflate block with fixed Huffman codes (RFC 1951, 3.2.6)
/// whose only matches are "as the pixel before" and "as the row above". Within a factor two of zlib here, without the
/// library.
#include <algorithm>
#include <array>

#include "figure/raster.hpp"

namespace slapstick::figure {
namespace {

class BitWriter {
 public:
  explicit BitWriter(std::string& out) : out_(out) {}
  /// Appends the lowest `count` bits, least significant first.
  void put(std::uint32_t bits, int count) {
    hold_ |= static_cast<std::uint64_t>(bits) << held_;
    for (held_ += count; held_ >= 8; held_ -= 8, hold_ >>= 8) out_.push_back(static_cast<char>(hold_ & 0xff));
  }
  void finish() {
    if (held_ > 0) put(0, 8 - held_);
  }

 private:
  std::string& out_;
  std::uint64_t hold_ = 0;
  int held_ = 0;
};

/// Huffman codes are sent most significant bit first.
void put_code(BitWriter& bits, std::uint32_t code, int length) {
  std::uint32_t reversed = 0;
  for (int i = 0; i < length; ++i) reversed |= (code >> i & 1u) << (length - 1 - i);
  bits.put(reversed, length);
}

void put_symbol(BitWriter& bits, std::uint32_t symbol) {
  if (symbol < 144) return put_code(bits, 0x30 + symbol, 8);
  if (symbol < 256) return put_code(bits, 0x190 + symbol - 144, 9);
  if (symbol < 280) return put_code(bits, symbol - 256, 7);
  put_code(bits, 0xC0 + symbol - 280, 8);
}

/// Match lengths 3..258 (base 3, four symbols per number of extra bits) and distances 1..32768 (base 1, two) share one
/// scheme: the value above the base is split into a symbol and extra bits.
struct Split {
  std::uint32_t symbol, extra;
  int extra_bits;
};

Split split(std::uint32_t above_base, int symbols_per_octave_log2) {
  const int n = symbols_per_octave_log2;
  int extra_bits = 0;
  while (above_base >> (n + 1 + extra_bits) != 0) ++extra_bits;
  const std::uint32_t first = static_cast<std::uint32_t>(extra_bits) << n;
  return {first + (above_base >> extra_bits), above_base & ((1u << extra_bits) - 1), extra_bits};
}

void put_match(BitWriter& bits, std::size_t length, std::size_t distance) {
  const Split l = length == 258 ? Split{28, 0, 0} : split(static_cast<std::uint32_t>(length - 3), 2);
  put_symbol(bits, 257 + l.symbol);
  bits.put(l.extra, l.extra_bits);
  const Split d = split(static_cast<std::uint32_t>(distance - 1), 1);
  put_code(bits, d.symbol, 5);
  bits.put(d.extra, d.extra_bits);
}

std::size_t match_length(const std::string& data, std::size_t at, std::size_t distance) {
  if (distance > at || distance > 32768) return 0;
  const std::size_t most = std::min<std::size_t>(258, data.size() - at);
  std::size_t n = 0;
  while (n < most && data[at + n] == data[at + n - distance]) ++n;
  return n;
}

std::uint32_t adler32(const std::string& data) {
  std::uint32_t a = 1, b = 0;
  for (std::size_t i = 0; i < data.size();) {
    for (const std::size_t end = std::min(data.size(), i + 5000); i < end; ++i)
      b += a += static_cast<unsigned char>(data[i]);
    a %= 65521;
    b %= 65521;
  }
  return b << 16 | a;
}

void append_be32(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<char>(value >> shift & 0xff));
}

std::string zlib_stream(const std::string& data, std::size_t row_bytes) {
  std::string out = "\x78\x01";
  BitWriter bits(out);
  bits.put(1, 1);  // the last block ...
  bits.put(1, 2);  // ... has fixed codes
  for (std::size_t i = 0; i < data.size();) {
    const std::size_t run = match_length(data, i, 1), above = match_length(data, i, row_bytes);
    const std::size_t length = std::max(run, above);
    if (length < 3) {
      put_symbol(bits, static_cast<unsigned char>(data[i++]));
      continue;
    }
    put_match(bits, length, run == length ? 1 : row_bytes);
    i += length;
  }
  put_symbol(bits, 256);
  bits.finish();
  append_be32(out, adler32(data));
  return out;
}

std::uint32_t crc32(const char* data, std::size_t size) {
  static const auto table = [] {
    std::array<std::uint32_t, 256> t{};
    for (std::uint32_t n = 0; n < 256; ++n) {
      t[n] = n;
      for (int k = 0; k < 8; ++k) t[n] = (t[n] & 1u) != 0 ? 0xEDB88320u ^ t[n] >> 1 : t[n] >> 1;
    }
    return t;
  }();
  std::uint32_t crc = 0xFFFFFFFFu;
  for (std::size_t i = 0; i < size; ++i) crc = table[(crc ^ static_cast<unsigned char>(data[i])) & 0xff] ^ crc >> 8;
  return ~crc;
}

void append_chunk(std::string& out, const char* type, const std::string& content) {
  append_be32(out, static_cast<std::uint32_t>(content.size()));
  const std::size_t start = out.size();
  out += type;
  out += content;
  append_be32(out, crc32(out.data() + start, out.size() - start));
}

}  // namespace

std::string encode_png(const Raster& raster) {
  std::string header, palette, opacities, rows;
  append_be32(header, static_cast<std::uint32_t>(raster.width));
  append_be32(header, static_cast<std::uint32_t>(raster.height));
  header += {8, 3, 0, 0, 0};  // 8 bits, palette, deflate, no filter, not interlaced
  for (const Ink& ink : raster.inks) {
    for (const auto channel : {ink.colour.red, ink.colour.green, ink.colour.blue})
      palette.push_back(static_cast<char>(channel));
    opacities.push_back(static_cast<char>(ink.opacity));
  }
  const auto width = static_cast<std::size_t>(raster.width);
  rows.reserve(raster.pixels.size() + raster.height);
  for (std::size_t at = 0; at < raster.pixels.size(); at += width) {
    rows.push_back(0);  // filter of this row: none
    rows.append(reinterpret_cast<const char*>(raster.pixels.data() + at), width);
  }
  std::string out = "\x89PNG\r\n\x1a\n";
  append_chunk(out, "IHDR", header);
  append_chunk(out, "PLTE", palette);
  append_chunk(out, "tRNS", opacities);
  append_chunk(out, "IDAT", zlib_stream(rows, width + 1));
  append_chunk(out, "IEND", "");
  return out;
}

}  // namespace slapstick::figure
