/// Finds and alters records of certificates (docs/reference/certificate.md).
#include "forging.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace campaign::forging {

std::string hex(double x) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%a", x);
  return text.data();
}

double value(const std::string& word) { return std::strtod(word.c_str(), nullptr); }

std::string altered(const std::string& word, Random& random) {
  constexpr std::array factors = {-1.0, 0.0, 0.5, 2.0, 0.9, 1.1, 1.0 + 0x1p-7, 1.0 - 0x1p-10, 1.0 + 0x1p-14};
  const double x = value(word);
  if (x == 0.0) return hex(random.sign() * std::ldexp(1.0, -random.below(12)));
  return hex(x * factors[static_cast<std::size_t>(random.below(static_cast<int>(factors.size())))]);
}

std::string raised(const std::string& count) { return std::to_string(std::stol(count) + 1); }

std::vector<std::size_t> all(const Lines& lines, std::initializer_list<const char*> words) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const char* word : words)
      if (lines[i].front() == word) found.push_back(i);
  return found;
}

std::size_t one(const Lines& lines, Random& random, std::initializer_list<const char*> words) {
  const auto found = all(lines, words);
  return found.empty() ? lines.size() : found[static_cast<std::size_t>(random.below(static_cast<int>(found.size())))];
}

Deed alter(const char* word, std::size_t first, std::size_t count) {
  return [=](Lines& lines, Random& random) {
    const std::size_t i = one(lines, random, {word});
    if (i == lines.size()) return false;
    const std::size_t many = count == 0 ? lines[i].size() - first : count;
    std::string& number = lines[i][first + static_cast<std::size_t>(random.below(static_cast<int>(many)))];
    const std::string before = number;
    number = altered(number, random);
    return number != before;
  };
}

Deed drop(const char* word) {
  return [=](Lines& lines, Random& random) {
    const std::size_t i = one(lines, random, {word});
    if (i == lines.size()) return false;
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(i));
    return true;
  };
}

Deed twice(const char* word) {
  return [=](Lines& lines, Random& random) {
    const std::size_t i = one(lines, random, {word});
    if (i == lines.size()) return false;
    lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(i), Words(lines[i]));
    return true;
  };
}

Lines::iterator at(Lines& lines, std::size_t i) { return lines.begin() + static_cast<std::ptrdiff_t>(i); }

}  // namespace campaign::forging
