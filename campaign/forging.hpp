#pragma once
/// What forgeries of certificates are made of: lines of words, a record found by its first word, a number altered.
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "random.hpp"

namespace campaign::forging {

using Words = std::vector<std::string>;
using Lines = std::vector<Words>;

/// What a kind of forgery does to the lines; false if there is nothing of the sort.
using Deed = std::function<bool(Lines&, Random&)>;

struct Kind {
  const char* name;
  Deed deed;
};

[[nodiscard]] std::string hex(double x);
[[nodiscard]] double value(const std::string& word);
/// Another number: of another size, sign, or by a little. Never by as little as rounding.
[[nodiscard]] std::string altered(const std::string& word, Random& random);
[[nodiscard]] std::string raised(const std::string& count);
[[nodiscard]] Lines::iterator at(Lines& lines, std::size_t i);
/// The lines that begin with one of these words.
[[nodiscard]] std::vector<std::size_t> all(const Lines& lines, std::initializer_list<const char*> words);
/// One of them, or the number of lines.
[[nodiscard]] std::size_t one(const Lines& lines, Random& random, std::initializer_list<const char*> words);

/// One number of one such record: from word `first` on, `count` words, or all that are left.
[[nodiscard]] Deed alter(const char* word, std::size_t first, std::size_t count = 0);
[[nodiscard]] Deed drop(const char* word);
[[nodiscard]] Deed twice(const char* word);

/// What the file says of the model, of the run, and what the last bit of a state or a segment without duration says.
[[nodiscard]] std::vector<Kind> of_the_model();
[[nodiscard]] std::vector<Kind> of_the_run();
[[nodiscard]] std::vector<Kind> of_the_last_bit();

}  // namespace campaign::forging
