/// Forgeries by what a reader may overlook: segments that last no time, states that are zero apart from the last bit,
/// impacts without speed, numbers that no contact needs.
#include <cmath>

#include "forging.hpp"

namespace campaign::forging {
namespace {

/// A segment, with its state, that lasts no time, before itself.
bool insert_nothing(Lines& lines, std::size_t i, const char* end) {
  Words nothing = lines[i];
  nothing[4] = hex(0.0);
  const Words state = lines[i + 1];
  const Lines copy = {nothing, state, {"end", end}};
  lines.insert(at(lines, i), copy.begin(), copy.end());
  long n = 0;
  for (Words& line : lines) {
    if (line.front() == "segment") line[1] = std::to_string(n++);
    if (line.front() == "done") line[1] = std::to_string(n);
  }
  return true;
}

bool event_made_up(Lines& lines, Random& random) {
  return insert_nothing(lines, one(lines, random, {"segment"}), "event");
}

/// One of the words of a segment that say `from`, or 0.
std::size_t contact_that_is(const Words& line, const std::string& from, Random& random) {
  std::vector<std::size_t> found;
  for (std::size_t k = 5; k < line.size(); ++k)
    if (line[k] == from) found.push_back(k);
  return found.empty() ? 0 : found[static_cast<std::size_t>(random.below(static_cast<int>(found.size())))];
}

/// What sticks slips instead, behind a segment that lasts no time.
bool slip_behind_nothing(Lines& lines, Random& random) {
  const std::size_t i = one(lines, random, {"segment"});
  const std::size_t k = contact_that_is(lines[i], "stick", random);
  if (k == 0) return false;
  lines[i][k] = random.one_in(2) ? "slip+" : "slip-";
  return insert_nothing(lines, i, "cut");
}

/// A zero of a state becomes 2^-60 or so, and a contact that is held is let go.
bool rest_off_by_a_bit(Lines& lines, Random& random) {
  const std::size_t i = one(lines, random, {"segment"});
  const bool slips = random.one_in(2);
  const std::size_t k = contact_that_is(lines[i], slips ? "stick" : "closed", random);
  if (k == 0) return false;
  lines[i][k] = !slips ? "open" : random.one_in(2) ? "slip+" : "slip-";
  Words& state = lines[i + 1];
  std::vector<std::size_t> zeros;
  for (std::size_t j = 1; j < state.size(); ++j)
    if (value(state[j]) == 0.0) zeros.push_back(j);
  if (zeros.empty()) return false;
  state[zeros[static_cast<std::size_t>(random.below(static_cast<int>(zeros.size())))]] =
      hex(random.sign() * std::ldexp(1.0, -60));
  return true;
}

/// A stop of a blow, or any, is said to have an impact without speed, or one that moves apart.
bool impact_made_up(Lines& lines, Random& random) {
  const std::size_t i = one(lines, random, {"impact"});
  if (i == lines.size()) return false;
  const int stops = static_cast<int>(all(lines, {"stop"}).size());
  constexpr double none = 0.0, apart = -0.25;
  lines.insert(at(lines, i + 1), {"impact", std::to_string(random.below(stops)), hex(random.one_in(2) ? none : apart)});
  return true;
}

/// A stop is brought to rest beside the blow of another.
bool pile_up_made_up(Lines& lines, Random& random) {
  const std::size_t i = one(lines, random, {"blow"});
  if (i == lines.size()) return false;
  std::size_t end = i + 1;
  while (lines[end].front() != "segment" && lines[end].front() != "done") ++end;
  const int stops = static_cast<int>(all(lines, {"stop"}).size());
  lines.insert(at(lines, end), {"pile-up", std::to_string(random.below(stops))});
  return true;
}

/// A number of coordinate 0 with a great shift, told truly to rounding: its rounding would explain anything.
bool number_without_need(Lines& lines, Random& random) {
  const double shift = std::ldexp(1.0, 20 + random.below(30));
  const auto numbers = all(lines, {"number"});
  const std::size_t d = numbers.size();
  lines.insert(at(lines, numbers.back() + 1), {"number", "0", "-1", hex(shift), hex(0.0)});
  for (Words& line : lines) {
    const std::size_t begin = line.front() == "state" ? 1 : line.front() == "done" ? 4 : 0;
    if (begin == 0) continue;
    line.insert(line.begin() + static_cast<std::ptrdiff_t>(begin + d), hex(-shift));
    line.push_back(hex(0.0));
  }
  return true;
}

}  // namespace

std::vector<Kind> of_the_last_bit() {
  return {
      {"event made up", event_made_up},         {"slip behind a segment without duration", slip_behind_nothing},
      {"rest off by a bit", rest_off_by_a_bit}, {"impact made up", impact_made_up},
      {"pile-up made up", pile_up_made_up},     {"number without need", number_without_need},
  };
}

}  // namespace campaign::forging
