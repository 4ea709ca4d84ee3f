/// Checks a whole certificate, and says what came of it.
#include "verdict.hpp"

#include <array>
#include <cstdio>

namespace verify {

Verdict check(std::istream& in, const Refuse& refuse) {
  Verdict verdict;
  Reader reader(in);
  Checker checker(reader.model(), reader.start(), [&](long line, const std::string& what) {
    ++verdict.refusals;
    refuse(line, what);
  });
  for (Segment segment; reader.next(segment);) checker.segment(segment);
  checker.done(reader.done());
  verdict.model = reader.model().name;
  verdict.from = reader.start().at;
  verdict.to = reader.done().at;
  verdict.tally = checker.tally();
  verdict.tally.open.undecided += verdict.tally.flight.touches;
  return verdict;
}

namespace {

std::string counted(long n, const std::string& what) { return std::to_string(n) + " " + what + (n == 1 ? "" : "s"); }

template <class... Numbers>
std::string line(const char* form, Numbers... numbers) {
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), form, numbers...);
  return text.data();
}

std::string instant_of(const Clock& clock) { return line("%.17g", static_cast<double>(clock.period) + clock.fraction); }

std::string jumps_of(const char* name, const JumpTally& jumps) {
  return line("%-17s%.2g the largest, %.2g all together, of the coordinate's sizes\n", name, jumps.largest, jumps.sum);
}

}  // namespace

std::string sentence(const Verdict& verdict) {
  if (verdict.refusals > 0) return "not proved: " + counted(verdict.refusals, "refusal");
  const Open& open = verdict.tally.open;
  std::string text;
  const auto add = [&](long n, const std::string& what, const std::string& of) {
    if (n > 0) text += (text.empty() ? "proved but for " : ", ") + counted(n, what) + of;
  };
  add(open.pile_ups, "pile-up", "");
  add(open.undecided, "undecided sign", "");
  add(open.choices, "choice", " among lawful modes");
  add(open.still, "coordinate", " moved by rounding alone");
  return text.empty() ? "proved" : text;
}

std::string report(const Verdict& verdict) {
  const Tally& t = verdict.tally;
  std::string text = "model            " + verdict.model + "\n";
  text += "periods          " + instant_of(verdict.from) + " to " + instant_of(verdict.to) + "\n";
  text += line("segments         %ld, in their modes by %ld conditions, %ld at rest\n", t.segments, t.flight.conditions,
               t.flight.rests);
  text += line("events           %ld, %ld impacts\n", t.events, t.impacts);
  text += line("chatter limits   %ld, their times within %.2g periods\n", t.chatters, t.limit_error);
  text += line("pile-ups         %ld (rest after impacts without end at one instant: assumed)\n", t.open.pile_ups);
  text += line("undecided signs  %ld (rounding decides whether there is an event)\n", t.open.undecided);
  text += line("choices          %ld (the laws allow another motion from there too)\n", t.open.choices);
  text += line("still            %ld (coordinates that rounding alone moves)\n", t.open.still);
  text += line(
      "bands            %.2g periods the longest in which a condition is no more than rounding, %ld beyond 2^-30\n",
      t.flight.band, t.flight.flats);
  text += jumps_of("displacements", t.displacement) + jumps_of("velocities", t.velocity);
  text += line("largest jump     %.2g of what rounding is allowed, %.2g periods of the clock (%.2g all together)\n",
               t.of_allowed, t.clock.largest, t.clock.sum);
  return text;
}

}  // namespace verify
