/// Forgeries of what a certificate says of the run.
#include <algorithm>
#include <array>
#include <cmath>

#include "forging.hpp"

namespace campaign::forging {
namespace {

/// A segment with what happens at its end: [begin, end).
std::pair<std::size_t, std::size_t> segment(const Lines& lines, std::size_t begin) {
  std::size_t end = begin + 1;
  while (lines[end].front() != "segment" && lines[end].front() != "done") ++end;
  return {begin, end};
}

/// Segments numbered anew, so that only what they say can be wrong.
void renumber(Lines& lines) {
  long n = 0;
  for (Words& line : lines) {
    if (line.front() == "segment") line[1] = std::to_string(n++);
    if (line.front() == "done") line[1] = std::to_string(n);
  }
}

bool drop_segment(Lines& lines, std::size_t begin) {
  const auto [from, to] = segment(lines, begin);
  lines.erase(at(lines, from), at(lines, to));
  renumber(lines);
  return true;
}

bool drop_first_segment(Lines& lines, Random&) { return drop_segment(lines, all(lines, {"segment"}).front()); }
bool drop_last_segment(Lines& lines, Random&) { return drop_segment(lines, all(lines, {"segment"}).back()); }
bool drop_any_segment(Lines& lines, Random& random) { return drop_segment(lines, one(lines, random, {"segment"})); }

bool double_segment(Lines& lines, Random& random) {
  const auto [from, to] = segment(lines, one(lines, random, {"segment"}));
  const Lines copy(at(lines, from), at(lines, to));
  lines.insert(at(lines, to), copy.begin(), copy.end());
  renumber(lines);
  return true;
}

bool swap_segments(Lines& lines, Random& random) {
  const auto [from, to] = segment(lines, one(lines, random, {"segment"}));
  if (lines[to].front() == "done") return false;
  const auto next = segment(lines, to);
  std::rotate(at(lines, from), at(lines, to), at(lines, next.second));
  renumber(lines);
  return true;
}

/// Two segments as one, in the mode of the first.
bool join_segments(Lines& lines, Random& random) {
  const auto [from, to] = segment(lines, one(lines, random, {"segment"}));
  if (lines[to].front() == "done") return false;
  lines[from][4] = hex(value(lines[from][4]) + value(lines[to][4]));
  lines.erase(at(lines, from + 2), at(lines, to + 2));
  renumber(lines);
  return true;
}

/// Cut short: the run ends after some segments, at what is said of the next one.
bool truncate(Lines& lines, Random& random) {
  const std::size_t i = one(lines, random, {"segment"});
  if (lines[i][1] == "0") return false;
  Words done{"done", lines[i][1], lines[i][2], lines[i][3]};
  done.insert(done.end(), lines[i + 1].begin() + 1, lines[i + 1].end());
  lines.resize(i);
  lines.push_back(done);
  return true;
}

bool another_contact(Lines& lines, Random& random) {
  const std::size_t i = one(lines, random, {"segment"});
  if (lines[i].size() == 5) return false;
  std::string& state = lines[i][5 + static_cast<std::size_t>(random.below(static_cast<int>(lines[i].size()) - 5))];
  const std::string before = state;
  constexpr std::array frictions = {"slip-", "stick", "slip+"}, springs = {"off", "on", "detached"};
  const auto pick = static_cast<std::size_t>(random.below(3));
  if (state == "open" || state == "closed")
    state = state == "open" ? "closed" : "open";
  else if (state == "off" || state == "on" || state == "detached")
    state = springs[pick];
  else if (state.find_first_not_of("0123456789") == std::string::npos)
    state = raised(state);
  else
    state = frictions[pick];
  return state != before;
}

bool another_end(Lines& lines, Random& random) {
  const std::size_t i = one(lines, random, {"end"});
  const bool event = lines[i][1] == "event";
  lines[i] = {"end", event ? "cut" : "event"};
  return true;
}

/// A blow written as another: `pile-up` or `chatter` for `blow`, its impacts left out.
Deed rename_blow(const char* to) {
  return [=](Lines& lines, Random& random) {
    const std::size_t i = one(lines, random, {"blow", "pile-up", "chatter"});
    if (i == lines.size() || lines[i].front() == to) return false;
    lines[i].front() = to;
    while (lines[i + 1].front() == "impact") lines.erase(at(lines, i + 1));
    return true;
  };
}

bool another_stop(Lines& lines, Random& random) {
  const std::size_t i = one(lines, random, {"blow", "impact", "chatter", "pile-up"});
  if (i == lines.size()) return false;
  const long stops = static_cast<long>(all(lines, {"stop"}).size());
  const std::string before = lines[i][1];
  lines[i][1] = std::to_string(random.below(static_cast<int>(stops)));
  return lines[i][1] != before;
}

bool blow_from_nowhere(Lines& lines, Random& random) {
  const auto stops = all(lines, {"stop"});
  if (stops.empty()) return false;
  const std::size_t i = one(lines, random, {"end"});
  lines.insert(at(lines, i + 1), {"blow", std::to_string(random.below(static_cast<int>(stops.size())))});
  return true;
}

/// An impact that is not told: the blow and its impacts left out.
bool hide_impact(Lines& lines, Random& random) {
  const std::size_t i = one(lines, random, {"blow"});
  if (i == lines.size()) return false;
  std::size_t end = i + 1;
  while (lines[end].front() == "impact") ++end;
  lines.erase(at(lines, i), at(lines, end));
  return true;
}

/// Every blow written three times, with all its impacts, for a restitution that three of them would explain.
bool threefold_blows(Lines& lines, Random&) {
  if (all(lines, {"blow"}).empty()) return false;
  Lines forged;
  for (Words& line : lines) {
    const bool more = line.front() == "blow" || line.front() == "impact";
    if (line.front() == "stop") line[4] = hex(std::cbrt(value(line[4])));
    for (int k = more ? 3 : 1; k > 0; --k) forged.push_back(line);
  }
  lines = forged;
  return true;
}

/// Every blow called a rest, its impacts left out, for a restitution that was not that of the run.
Deed all_blows_as(const char* word) {
  return [=](Lines& lines, Random&) {
    if (all(lines, {"blow"}).empty()) return false;
    Lines forged;
    for (Words& line : lines) {
      if (line.front() == "impact") continue;
      if (line.front() == "blow") line.front() = word;
      if (line.front() == "stop") line[4] = hex(0.8);
      forged.push_back(line);
    }
    lines = forged;
    return true;
  };
}

/// All of the run by a phase later.
bool other_phase(Lines& lines, Random& random) {
  const double by = random.uniform(0.01, 0.4);
  for (Words& line : lines) {
    const std::size_t k = line.front() == "start" ? 2 : line.front() == "segment" || line.front() == "done" ? 3 : 0;
    if (k == 0) continue;
    const double fraction = value(line[k]) + by;
    line[k] = hex(fraction < 1.0 ? fraction : fraction - 1.0);
    if (fraction >= 1.0) line[k - 1] = raised(line[k - 1]);
  }
  return true;
}

}  // namespace

std::vector<Kind> of_the_run() {
  return {
      {"start", alter("start", 3)},
      {"start of the clock", alter("start", 2, 1)},
      {"phase of the whole run", other_phase},
      {"first segment left out", drop_first_segment},
      {"last segment left out", drop_last_segment},
      {"segment left out", drop_any_segment},
      {"segment twice", double_segment},
      {"segments swapped", swap_segments},
      {"segments joined", join_segments},
      {"run cut short", truncate},
      {"duration", alter("segment", 4, 1)},
      {"instant", alter("segment", 3, 1)},
      {"state of a contact", another_contact},
      {"state", alter("state", 1)},
      {"end of the run", alter("done", 3)},
      {"end of a segment", another_end},
      {"blow left out", drop("blow")},
      {"blow twice", twice("blow")},
      {"blow from nowhere", blow_from_nowhere},
      {"blow called a pile-up", rename_blow("pile-up")},
      {"blow called a chatter", rename_blow("chatter")},
      {"rest called a blow", rename_blow("blow")},
      {"other stop struck", another_stop},
      {"impact left out", drop("impact")},
      {"impact twice", twice("impact")},
      {"speed of an impact", alter("impact", 2, 1)},
      {"impact hidden", hide_impact},
      {"every blow three times", threefold_blows},
      {"every blow a pile-up", all_blows_as("pile-up")},
      {"every blow a chatter", all_blows_as("chatter")},
  };
}

}  // namespace campaign::forging
