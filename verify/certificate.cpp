/// Reads a certificate segment by segment.
#include "certificate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace verify {
namespace {

constexpr long most = 1'000'000'000'000'000;  ///< of a count; exact as a double, and no sum overflows
constexpr long most_numbers = 1000;           ///< of a state
constexpr std::array kinds = {"gap", "slip", "stick", "press", "engage", "leave", "let-go", "push"};

}  // namespace

Reader::Reader(std::istream& in) : in_(in) {
  advance();
  read_head();
}

void Reader::advance() {
  std::string text;
  ++line_;
  words_.clear();
  next_word_ = 1;
  if (!std::getline(in_, text)) fail(in_.eof() ? "the file ends here, without `done`" : "cannot be read");
  for (std::size_t begin = 0, end; begin <= text.size(); begin = end + 1) {
    end = std::min(text.find(' ', begin), text.size());
    words_.push_back(text.substr(begin, end - begin));
    if (words_.back().empty()) fail("words and numbers are separated by one space");
  }
}

void Reader::expect(const char* word) {
  if (!at(word)) fail("expected `" + std::string(word) + "`, found `" + words_[0].substr(0, 40) + "`");
}

std::string Reader::word() {
  if (next_word_ >= words_.size()) fail("`" + words_[0] + "` is too short");
  return words_[next_word_++];
}

std::string Reader::rest_of_line() {
  std::string text = word();
  while (next_word_ < words_.size()) text += " " + word();
  return text;
}

/// As `%a` writes it, and no other way: so nothing is rounded, and nan and inf are refused.
double Reader::real() {
  const std::string text = word();
  char* end = nullptr;
  const double x = std::strtod(text.c_str(), &end);
  std::array<char, 40> again{};
  std::snprintf(again.data(), again.size(), "%a", x);
  if (!std::isfinite(x) || text != again.data())
    fail("`" + text.substr(0, 40) + "` is not a finite number as %a writes it");
  return x;
}

long Reader::count(long least, long greatest) {
  const std::string text = word();
  char* end = nullptr;
  const long n = std::strtol(text.c_str(), &end, 10);
  if (text != std::to_string(n)) fail("`" + text.substr(0, 40) + "` is not an integer");
  if (n < least || n > greatest)
    fail(text + " is not in the range " + std::to_string(least) + " .. " + std::to_string(greatest));
  return n;
}

Entries Reader::entries() {
  Entries row;
  for (long n = count(0, head_.m); n > 0; --n) {
    const int index = static_cast<int>(count(row.empty() ? 0 : row.back().first + 1, head_.m - 1));
    row.emplace_back(index, real());
  }
  return row;
}

void Reader::finish_line() {
  if (next_word_ < words_.size()) fail("`" + words_[next_word_].substr(0, 40) + "` is too much here");
}

void Reader::read_head() {
  expect("slapstick-certificate");
  count(1, 1);
  finish_line(), advance(), expect("model");
  head_.model = rest_of_line();
  advance(), expect("sizes");
  head_.m = static_cast<int>(count(3, most_numbers));
  head_.d = static_cast<int>(count(1, (head_.m - 1) / 2));
  if ((head_.m - 2 * head_.d) % 2 != 1) fail("a state has 2 d + 2 harmonics + 1 numbers");
  finish_line(), advance(), expect("period");
  head_.period = real();
  if (!(head_.period > 0.0)) fail("the period is not positive");
  for (finish_line(), advance(); at("stop"); advance()) {
    const long k = static_cast<long>(head_.stops.size());
    count(k, k);
    Stop stop{static_cast<int>(count(0, head_.d - 1)), real(), real(), {}};
    stop.name = rest_of_line();
    if (std::abs(stop.sign) != 1.0) fail("the sign of a stop is 1 or -1");
    if (!(stop.restitution >= 0.0 && stop.restitution <= 1.0)) fail("the restitution is not in [0, 1]");
    head_.stops.push_back(stop);
  }
  read_inertia();
}

void Reader::read_inertia() {
  auto& V = head_.inertia;
  for (std::size_t i = 0; i < static_cast<std::size_t>(head_.d); ++i) {
    expect("inertia"), count(static_cast<long>(i), static_cast<long>(i));
    V.emplace_back();
    for (int j = 0; j < head_.d; ++j) V.back().push_back(real());
    for (std::size_t j = 0; j < i; ++j)
      if (!(std::abs(V[i][j] - V[j][i]) <= 0x1p-40 * (V[i][i] + V[j][j]))) fail("the inertia is not symmetric");
    finish_line(), advance();
  }
}

void Reader::read_mode() {
  const long id = count(0, most);
  if (modes_.contains(id)) fail("mode " + std::to_string(id) + " is there already");
  rest_of_line();
  Mode mode{line_, std::vector<Entries>(static_cast<std::size_t>(head_.m)), {}};
  long row = -1;
  for (advance(); at("row"); finish_line(), advance()) {
    row = count(row + 1, head_.m - 1);
    mode.rows[static_cast<std::size_t>(row)] = entries();
  }
  for (; at("guard"); finish_line(), advance()) {
    const long g = static_cast<long>(mode.guards.size());
    count(g, g);
    const std::string kind = word();
    if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) fail("there is no guard `" + kind + "`");
    mode.guards.push_back({kind, entries()});
  }
  modes_.emplace(id, std::move(mode));
}

bool Reader::next(Segment& segment) {
  while (at("mode")) read_mode();
  if (at("done")) {
    count(segments_, segments_);
    finish_line();
    if (in_.peek() != std::istream::traits_type::eof()) fail("something follows `done`");
    return false;
  }
  expect("segment");
  segment = Segment{};
  segment.line = line_;
  segment.number = count(0, most);
  segment.mode = count(0, most);
  if (!modes_.contains(segment.mode)) fail("mode " + std::to_string(segment.mode) + " is not there");
  segment.period = count(-most, most);
  segment.fraction = real();
  segment.duration = real();
  if (!(segment.fraction >= 0.0 && segment.fraction < 1.0)) fail("FRACTION is not in [0, 1)");
  if (!(segment.duration >= 0.0)) fail("DURATION is negative");
  finish_line(), advance(), expect("state");
  for (int i = 0; i < head_.m; ++i) segment.state.push_back(real());
  finish_line(), advance();
  read_claims(segment);
  if (at("tail")) read_tail(segment);
  read_end(segment);
  ++segments_;
  return true;
}

void Reader::read_claims(Segment& segment) {
  const int guards = static_cast<int>(modes_.at(segment.mode).guards.size());
  for (; at("prove") || at("rest");) {
    const bool rest = at("rest");
    Claim claim{line_, static_cast<int>(count(0, guards - 1)), rest};
    if (!rest) claim.order = static_cast<int>(count(0, 64));
    if (!rest) claim.limit = real();
    for (finish_line(), advance(); !rest && at("step"); finish_line(), advance()) {
      Step step{line_, real(), real(), real(), real(), real()};
      claim.steps.push_back(step);
    }
    segment.claims.push_back(std::move(claim));
  }
}

void Reader::read_tail(Segment& segment) {
  Tail& tail = segment.tail;
  tail.line = line_;
  for (long* id : {&tail.rise, &tail.back, &tail.hold}) {
    *id = count(0, most);
    if (!modes_.contains(*id)) fail("mode " + std::to_string(*id) + " is not there");
  }
  for (double* x : {&tail.duration, &tail.rise_least, &tail.rise_most, &tail.fall_least, &tail.fall_most}) *x = real();
  finish_line(), advance();
}

void Reader::read_end(Segment& segment) {
  expect("end");
  End& end = segment.end;
  end.line = line_;
  const std::string kind = word();
  if (kind == "zero" || kind == "touch") {
    end.kind = kind == "zero" ? EndKind::zero : EndKind::touch;
    end.index = static_cast<int>(count(0, static_cast<long>(modes_.at(segment.mode).guards.size()) - 1));
  } else if (kind == "chatter") {
    end.kind = EndKind::chatter;
    end.index = static_cast<int>(count(0, static_cast<long>(head_.stops.size()) - 1));
  } else if (kind != "cut") {
    fail("there is no end `" + kind + "`");
  }
  if ((segment.tail.line != 0) != (end.kind == EndKind::chatter)) fail("`tail` and `end chatter` belong together");
  if (kind != "cut") end.size = real();
  if (!(end.size >= 0.0)) fail("a bound is negative");
  for (finish_line(), advance(); at("blow") || at("event"); finish_line(), advance()) {
    if (at("event")) {
      Event event{line_, word(), word(), 0.0};
      while (next_word_ + 1 < words_.size()) event.contact += " " + word();
      event.w = real();
      segment.events.push_back(event);
      continue;
    }
    Blow blow{line_, count(0, 1) == 1, {}};
    do {
      const long least = blow.stops.empty() ? 0 : blow.stops.back() + 1;
      blow.stops.push_back(static_cast<int>(count(least, static_cast<long>(head_.stops.size()) - 1)));
    } while (next_word_ < words_.size());
    segment.blows.push_back(blow);
  }
}

}  // namespace verify
