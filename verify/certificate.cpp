/// Reads a certificate: the model, then segment by segment.
#include "certificate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace verify {
namespace {

constexpr long most = 1'000'000'000'000'000;  ///< of a count; exact as a double, and no sum overflows
constexpr long most_coordinates = 400, most_harmonic = 1'000'000, most_corners = 1000;

}  // namespace

bool Model::forced() const {
  return std::any_of(forces.begin(), forces.end(), [](const Force& force) { return force.harmonic > 0; });
}

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
  for (std::size_t begin = 0, end = 0; begin <= text.size(); begin = end + 1) {
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
  if (std::any_of(text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }))
    fail("a name has characters that are not printable ASCII");
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

double Reader::real_from(double least) {
  const double x = real();
  if (!(x >= least)) fail("`" + words_[next_word_ - 1] + "` is too small");
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

std::vector<double> Reader::reals(int n) {
  std::vector<double> numbers;
  for (int i = 0; i < n; ++i) numbers.push_back(real());
  return numbers;
}

Pair Reader::pair() {
  Pair pair;
  pair.a = static_cast<int>(count(ground, model_.n - 1));
  pair.b = static_cast<int>(count(ground, model_.n - 1));
  if (pair.a == pair.b) fail("a pair of one body");
  return pair;
}

Clock Reader::clock() {
  Clock clock{count(-most, most), real()};
  if (!(clock.fraction >= 0.0 && clock.fraction < 1.0)) fail("FRACTION is not in [0, 1)");
  return clock;
}

void Reader::finish_line() {
  if (next_word_ < words_.size()) fail("`" + words_[next_word_].substr(0, 40) + "` is too much here");
}

void Reader::read_head() {
  expect("slapstick-certificate");
  count(3, 3);
  finish_line(), advance(), expect("model");
  model_.name = rest_of_line();
  advance(), expect("size");
  model_.n = static_cast<int>(count(1, most_coordinates));
  finish_line(), advance(), expect("omega");
  model_.omega = real_from(0.0);
  finish_line(), advance(), expect("law");
  const std::string law = word();
  if (law != "moreau" && law != "sequence") fail("there is no law `" + law.substr(0, 40) + "`");
  model_.in_sequence = law == "sequence";
  finish_line(), advance();
  read_masses();
  read_table("mass", model_.mass);
  read_table("damping", model_.damping);
  read_table("stiffness", model_.stiffness);
  read_elements("spring", model_.springs);
  read_elements("damper", model_.dampers);
  read_forces();
  if (model_.forced() && !(model_.omega > 0.0)) fail("a harmonic force needs omega > 0");
  read_stops();
  read_frictions();
  read_compliant();
  read_normals();
  read_polylines();
  read_numbers();
  read_start();
}

void Reader::read_masses() {
  for (int i = 0; i < model_.n; ++i) {
    expect("coordinate");
    count(i, i);
    model_.masses.push_back(real_from(0.0));
    rest_of_line();
    advance();
  }
}

void Reader::read_table(const char* word, Table& table) {
  for (int i = 0; (i == 0 && at(word)) || (i > 0 && i < model_.n); ++i) {
    expect(word), count(i, i);
    table.push_back(reals(model_.n));
    for (std::size_t j = 0; j < table.size(); ++j)
      if (table.back()[j] != table[j][table.size() - 1]) fail("the matrix is not symmetric");
    finish_line(), advance();
  }
}

void Reader::read_elements(const char* word, std::vector<Element>& elements) {
  for (; at(word); finish_line(), advance()) {
    const Pair of = pair();
    elements.push_back({of, real()});
  }
}

void Reader::read_forces() {
  for (; at("force"); finish_line(), advance()) {
    Force force{static_cast<int>(count(0, model_.n - 1)), static_cast<int>(count(0, most_harmonic)), real(), real()};
    model_.forces.push_back(force);
  }
  for (; at("tone"); finish_line(), advance()) {
    const int coordinate = static_cast<int>(count(0, model_.n - 1));
    const double frequency = real();
    if (!(frequency > 0.0)) fail("the frequency of a tone must be positive");
    const double amplitude = real(), phase = real();
    model_.forces.push_back({coordinate, 0, amplitude, phase, frequency});
  }
}

/// A count, and as many pairs of numbers, the first ones ascending.
std::vector<Corner> Reader::corners(long least) {
  std::vector<Corner> all;
  for (long n = count(least, most_corners); n > 0; --n) {
    const double place = real();
    if (!all.empty() && !(place > all.back().at)) fail("corners do not ascend");
    all.push_back({place, real()});
  }
  return all;
}

void Reader::read_stops() {
  for (; at("stop"); advance()) {
    const Pair of = pair();
    Stop stop{of, real(), real_from(0.0), corners(0), rest_of_line()};
    bool possible = stop.restitution <= 1.0;
    for (const Corner& corner : stop.corners)
      possible = possible && corner.at > 0.0 && corner.force >= 0.0 && corner.force <= 1.0;
    if (!possible) fail("the restitution is not in [0, 1], or a corner is not at a positive speed");
    if (!stop.corners.empty() && stop.corners.front().force != stop.restitution)
      fail("the restitution is not that of the first corner");
    model_.stops.push_back(stop);
  }
}

void Reader::read_frictions() {
  for (; at("friction"); advance()) {
    const Pair of = pair();
    Friction friction{of, real(), real_from(0.0), real_from(0.0), rest_of_line()};
    if (!(friction.kinetic <= friction.static_limit)) fail("kinetic friction is greater than static friction");
    model_.frictions.push_back(friction);
  }
}

void Reader::read_compliant() {
  for (; at("compliant"); advance()) {
    const Pair of = pair();
    Compliant stop{of, real(), real_from(0.0), real_from(0.0), Compliant::Law(count(0, 2)), rest_of_line()};
    if (!(stop.stiffness > 0.0)) fail("the stiffness is not positive");
    model_.compliant.push_back(stop);
  }
}

void Reader::read_normals() {
  for (int least = 0; at("normal"); finish_line(), advance()) {
    const int of = static_cast<int>(count(least, static_cast<long>(model_.frictions.size()) - 1));
    least = of + 1;
    const double constant = real();
    Normal normal{constant, static_cast<int>(count(-1, static_cast<long>(model_.compliant.size()) - 1)), {}};
    for (long n = count(0, most_corners); n > 0; --n) {
      const int coordinate = static_cast<int>(count(0, model_.n - 1));
      const double stiffness = real();
      normal.terms.push_back({coordinate, stiffness, real()});
    }
    model_.frictions[static_cast<std::size_t>(of)].normal = normal;
  }
}

void Reader::read_polylines() {
  using Over = Polyline::Over;
  for (; at("polyline"); advance()) {
    Polyline line{pair(), Over::displacement, 0.0, 0.0, {}, {}};
    const std::string over = word();
    if (over != "displacement" && over != "velocity" && over != "zones")
      fail("there is no polyline over `" + over.substr(0, 40) + "`");
    line.over = over == "zones" ? Over::zones : over == "velocity" ? Over::velocity : Over::displacement;
    line.slope_below = real();
    line.slope_above = real();
    line.corners = corners(1);
    line.name = rest_of_line();
    model_.polylines.push_back(line);
  }
}

void Reader::read_numbers() {
  for (; at("number"); finish_line(), advance()) {
    const Pair of = pair();
    model_.numbers.push_back({of, real(), real()});
    if (model_.d() > 2 * most_coordinates) fail("there are too many numbers");
  }
  if (model_.d() < model_.n) expect("number");
}

void Reader::read_start() {
  expect("start");
  start_.line = line_;
  start_.at = clock();
  for (int i = 0; i < model_.n; ++i) {
    start_.q.push_back(real());
    start_.v.push_back(real());
  }
  finish_line(), advance();
}

ContactStates Reader::contact_states() {
  ContactStates states;
  const auto choose = [&](std::initializer_list<const char*> words) {
    const std::string text = word();
    int k = 0;
    for (const char* each : words) {
      if (text == each) return k;
      ++k;
    }
    fail("`" + text.substr(0, 40) + "` is no state of this contact");
  };
  for (std::size_t i = 0; i < model_.stops.size(); ++i) states.closed.push_back(choose({"open", "closed"}) == 1);
  for (const Friction& friction : model_.frictions) {
    states.slip.push_back(choose({"slip-", "stick", "slip+", "unloaded"}) - 1);
    if (!friction.normal && states.slip.back() == ContactStates::unloaded)
      fail("friction contact " + friction.name + " has no normal force, and is never unloaded");
  }
  using Spring = ContactStates::Spring;
  for (const Compliant& stop : model_.compliant) {
    const Spring state = states.compliant.emplace_back(Spring(choose({"off", "on", "detached", "bounded"})));
    if (state == Spring::detached && stop.law == Compliant::Law::pulls)
      fail("compliant stop " + stop.name + " pulls, and is never detached");
    if (state == Spring::bounded && stop.law != Compliant::Law::bounded)
      fail("compliant stop " + stop.name + " has no bound");
  }
  for (const Polyline& line : model_.polylines)
    states.pieces.push_back(static_cast<int>(count(0, static_cast<long>(line.corners.size()))));
  return states;
}

bool Reader::next(Segment& segment) {
  if (at("done")) return read_done(), false;
  expect("segment");
  segment = Segment{};
  segment.line = line_;
  segment.number = count(segments_, segments_);
  segment.start = clock();
  segment.duration = real_from(0.0);
  segment.states = contact_states();
  finish_line(), advance(), expect("state");
  segment.p = reals(model_.d());
  segment.u = reals(model_.d());
  finish_line(), advance();
  read_end(segment);
  ++segments_;
  return true;
}

void Reader::read_end(Segment& segment) {
  expect("end");
  segment.end_line = line_;
  const std::string kind = word();
  if (kind == "event") {
    segment.end = EndKind::event;
  } else if (kind == "chatter") {
    segment.end = EndKind::chatter;
    segment.chatter = stops_in_order();
  } else if (kind != "cut") {
    fail("there is no end `" + kind.substr(0, 40) + "`");
  }
  finish_line(), advance();
  read_what_happens(segment);
}

/// The rest of a line.
std::vector<int> Reader::stops_in_order() {
  std::vector<int> stops;
  do {
    const long least = stops.empty() ? 0 : stops.back() + 1;
    stops.push_back(static_cast<int>(count(least, static_cast<long>(model_.stops.size()) - 1)));
  } while (next_word_ < words_.size());
  return stops;
}

void Reader::read_what_happens(Segment& segment) {
  using Kind = Blow::Kind;
  const long stops = static_cast<long>(model_.stops.size());
  for (; at("blow") || at("pile-up") || at("chatter") || at("impact"); finish_line(), advance()) {
    if (at("impact")) {
      const int stop = static_cast<int>(count(0, stops - 1));
      segment.impacts.push_back({line_, stop, real()});
      continue;
    }
    Blow blow{line_, at("blow") ? Kind::impact : at("pile-up") ? Kind::pile_up : Kind::chatter, {}};
    blow.stops = stops_in_order();
    segment.blows.push_back(blow);
  }
}

void Reader::read_done() {
  done_.line = line_;
  count(segments_, segments_);
  done_.at = clock();
  done_.p = reals(model_.d());
  done_.u = reals(model_.d());
  finish_line();
  if (in_.peek() != std::istream::traits_type::eof()) fail("something follows `done`");
}

}  // namespace verify
