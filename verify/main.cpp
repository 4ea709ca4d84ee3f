/// slapstick-verify: checks a certificate (docs/certificate.md) in ball arithmetic, and shares no code with slapstick.
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>

#include "check.hpp"

namespace verify {
namespace {

enum Status { proved = 0, not_proved = 1, unreadable = 2 };

constexpr char usage[] =
    "slapstick-verify FILE    checks a certificate that `slapstick simulate --certify FILE` has written; `-` reads it "
    "from standard input\n\n"
    "Every claim of the file is checked in ball arithmetic of 256 bits; the rules are in docs/certificate.md. Standard "
    "output gets one line\n"
    "for each claim that is not proved (the first 20) and a report. Exit status: 0 proved, 1 not proved, 2 unreadable "
    "or incomplete.\n";

constexpr long most_shown = 20;

void report(const Head& head, const Tally& t, long refused) {
  std::printf("model            %s\n", head.model.c_str());
  std::printf("segments         %ld\n", t.segments);
  std::printf("guards           %ld proved free of zeros by %ld steps, %ld at rest\n", t.guards, t.steps, t.rests);
  std::printf("events           %ld, of them %ld impacts\n", t.events, t.impacts);
  std::printf("touches          %ld (whether there is a zero cannot be decided)\n", t.touches);
  std::printf("chatter limits   %ld proved\n", t.chatters);
  std::printf("ties             %ld, within %.2g periods\n", t.ties, t.tie);
  std::printf("flat zeros       %ld, within %.2g periods (there, the guard is no more than rounding)\n", t.flats,
              t.flat);
  std::printf("largest DELTA    %.2g periods\n", t.delta);
  std::printf("largest jump     %.2g of what rounding is allowed\n", t.jump);
  if (refused == 0)
    std::printf("proved\n");
  else
    std::printf("not proved: %ld refusals\n", refused);
}

int run(std::istream& in) {
  long refused = 0;
  const Refuse refuse = [&](long line, const std::string& what) {
    if (++refused <= most_shown) std::printf("line %ld: %s\n", line, what.c_str());
  };
  Reader reader(in);
  Checker checker(reader.head(), reader.modes(), refuse);
  for (Segment segment; reader.next(segment);) checker.segment(segment);
  report(reader.head(), checker.tally(), refused);
  return refused == 0 ? proved : not_proved;
}

}  // namespace
}  // namespace verify

int main(int count, char** arguments) {
  using namespace verify;
  if (count == 2 && (std::strcmp(arguments[1], "--help") == 0 || std::strcmp(arguments[1], "-h") == 0))
    return std::fputs(usage, stdout), 0;
  if (count != 2) return std::fputs(usage, stderr), unreadable;
  const std::string name = arguments[1];
  try {
    if (name == "-") return run(std::cin);
    std::ifstream file(name);
    if (!file) throw Unreadable(1, "cannot be opened");
    return run(file);
  } catch (const std::exception& error) {
    std::fflush(stdout);
    std::fprintf(stderr, "slapstick-verify: %s: %s\n", name.c_str(), error.what());
    return unreadable;
  }
}
