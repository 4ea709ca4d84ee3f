/// Writes a table as an .npz file: a ZIP archive of .npy arrays, without compression.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "io/column_table.hpp"

namespace slapstick {
namespace {

static_assert(std::endian::native == std::endian::little, ".npy headers say '<'");

/// CRC-32 of ISO 3309, as ZIP has it.
std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0) {
  static const auto table = [] {
    std::array<std::uint32_t, 256> made{};
    for (std::uint32_t n = 0; n < made.size(); ++n) {
      std::uint32_t c = n;
      for (int k = 0; k < 8; ++k) c = (c & 1U) != 0 ? 0xedb88320U ^ (c >> 1U) : c >> 1U;
      made[n] = c;
    }
    return made;
  }();
  std::uint32_t c = ~before;
  for (const char byte : bytes) c = table[(c ^ static_cast<unsigned char>(byte)) & 0xffU] ^ (c >> 8U);
  return ~c;
}

template <class Integer>
void append(std::string& out, Integer value) {
  std::array<char, sizeof(Integer)> bytes{};
  std::memcpy(bytes.data(), &value, sizeof(Integer));
  out.append(bytes.data(), bytes.size());
}

template <class Number>
std::string_view bytes_of(const std::vector<Number>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};  // NOLINT: the file's bytes
}

/// An archive whose sizes may exceed 32 bits; every entry has its ZIP64 record, as numpy writes them.
class Archive {
 public:
  explicit Archive(const std::function<void(std::string_view)>& write) : write_(write) {}

  void add(const std::string& name, const std::string& head, std::string_view data) {
    const std::uint32_t crc = crc32(data, crc32(head));
    const std::uint64_t size = head.size() + data.size(), offset = written_;
    std::string local = "PK\x03\x04";
    common(local, name, crc);
    append(local, std::uint16_t{20});
    local += name;
    append(local, std::uint16_t{1}), append(local, std::uint16_t{16}), append(local, size), append(local, size);
    put(local), put(head), put(data);

    directory_ += "PK\x01\x02";
    append(directory_, std::uint16_t{45});
    common(directory_, name, crc);
    append(directory_, std::uint16_t{28});
    directory_.append(10, '\0');  // comment, disk, attributes
    append(directory_, 0xffffffffU);
    directory_ += name;
    append(directory_, std::uint16_t{1}), append(directory_, std::uint16_t{24});
    append(directory_, size), append(directory_, size), append(directory_, offset);
    ++entries_;
  }

  void end() {
    const std::uint64_t begin = written_, size = directory_.size();
    put(directory_);
    std::string tail = "PK\x06\x06";
    append(tail, std::uint64_t{44}), append(tail, std::uint16_t{45}), append(tail, std::uint16_t{45});
    append(tail, std::uint64_t{0});
    append(tail, entries_), append(tail, entries_), append(tail, size), append(tail, begin);
    tail += "PK\x06\x07";
    append(tail, std::uint32_t{0}), append(tail, begin + size), append(tail, std::uint32_t{1});
    tail += "PK\x05\x06";
    append(tail, std::uint32_t{0}), append(tail, 0xffffffffU), append(tail, 0xffffffffU), append(tail, 0xffffffffU);
    append(tail, std::uint16_t{0});
    put(tail);
  }

 private:
  /// From the version that is needed to the length of the name.
  static void common(std::string& out, const std::string& name, std::uint32_t crc) {
    constexpr std::uint16_t utf8 = 1U << 11U, first_of_1980 = 33;
    append(out, std::uint16_t{45}), append(out, utf8), append(out, std::uint16_t{0});
    append(out, std::uint16_t{0}), append(out, first_of_1980);
    append(out, crc), append(out, 0xffffffffU), append(out, 0xffffffffU);
    append(out, static_cast<std::uint16_t>(name.size()));
  }
  void put(std::string_view bytes) {
    write_(bytes);
    written_ += bytes.size();
  }

  const std::function<void(std::string_view)>& write_;
  std::string directory_;
  std::uint64_t written_ = 0, entries_ = 0;
};

/// The head of a .npy file: the array's type and shape, padded to 64 bytes.
std::string npy_head(const std::string& type, const std::string& shape) {
  std::string text = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + shape + "), }";
  constexpr std::size_t before = 10, block = 64;
  text.append(block - (before + text.size() + 1) % block, ' ');
  text += '\n';
  std::string head = "\x93NUMPY";
  head += '\x01';
  head += '\0';
  append(head, static_cast<std::uint16_t>(text.size()));
  return head + text;
}

std::string npy_head(const std::string& type, std::size_t rows) { return npy_head(type, std::to_string(rows) + ","); }

/// UTF-8 as numpy's four bytes a character.
std::u32string characters(std::string_view text) {
  std::u32string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i++]);
    const int more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc0 ? 1 : 0;
    char32_t c = more == 0 ? first : first & (0x3fU >> more);
    for (int k = 0; k < more && i < text.size(); ++k) c = (c << 6U) | (static_cast<unsigned char>(text[i++]) & 0x3fU);
    out += c;
  }
  return out;
}

void add_texts(Archive& archive, const std::string& name, const std::vector<std::string>& texts, bool several) {
  std::vector<std::u32string> all;
  std::size_t longest = 1;
  for (const std::string& text : texts) {
    all.push_back(characters(text));
    longest = std::max(longest, all.back().size());
  }
  std::vector<std::uint32_t> data;
  for (std::u32string& text : all) {
    text.resize(longest, U'\0');
    data.insert(data.end(), text.begin(), text.end());
  }
  archive.add(name + ".npy",
              npy_head("<U" + std::to_string(longest), several ? std::to_string(texts.size()) + "," : ""),
              bytes_of(data));
}

void add_column(Archive& archive, const Column& column) {
  const std::string file = column.name + ".npy";
  if (const auto* words = std::get_if<Words>(&column.cells)) {
    if (words->small())
      archive.add(file, npy_head("|u1", words->size()), bytes_of(words->small_codes()));
    else
      archive.add(file, npy_head("<u4", words->size()), bytes_of(words->large_codes()));
    add_texts(archive, column.name + ".names", words->names(), true);
  } else {
    static const std::vector<double> none;
    const auto* numbers = std::get_if<std::vector<double>>(&column.cells);
    const std::vector<double>& data = numbers != nullptr ? *numbers : none;
    archive.add(file, npy_head("<f8", data.size()), bytes_of(data));
  }
  if (!column.unit.empty()) add_texts(archive, column.name + ".unit", {column.unit}, false);
}

}  // namespace

void write_npz(const ColumnTable& table, const std::function<void(std::string_view)>& write) {
  Archive archive(write);
  for (const Column& column : table.columns()) add_column(archive, column);
  for (const Attribute& attribute : table.attributes()) {
    const std::string name = "attributes." + attribute.name;
    if (const auto* text = std::get_if<std::string>(&attribute.value))
      add_texts(archive, name, {*text}, false);
    else
      archive.add(name + ".npy", npy_head("<f8", std::string()),
                  bytes_of(std::vector{std::get<double>(attribute.value)}));
  }
  archive.end();
}

}  // namespace slapstick
