/// slapstick-verify: checks a certificate (docs/reference/certificate.md) in ball arithmetic, sharing no code.
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>

#include "verdict.hpp"

namespace verify {
namespace {

enum Status { proved = 0, not_proved = 1, unreadable = 2, proved_but_for = 3 };

constexpr char usage[] =
    "slapstick-verify FILE    checks a certificate that `slapstick simulate --certify FILE` has written; `-` reads it "
    "from standard input\n\n"
    "The motion is checked against the model in the file, in ball arithmetic of 256 bits; the rules are in "
    "docs/reference/certificate.md.\n"
    "Standard output gets one line for each claim that does not hold (the first 20) and a report.\n"
    "Exit status: 0 proved, 1 not proved, 2 unreadable or incomplete, 3 proved but for what the last line names.\n";

constexpr long most_shown = 20;

int run(std::istream& in) {
  long refused = 0;
  const Verdict verdict = check(in, [&](long line, const std::string& what) {
    if (++refused <= most_shown) std::printf("line %ld: %s\n", line, what.c_str());
  });
  std::printf("%s%s\n", report(verdict).c_str(), sentence(verdict).c_str());
  if (verdict.refusals > 0) return not_proved;
  return verdict.proved() ? proved : proved_but_for;
}

}  // namespace
}  // namespace verify

int main(int count, char** arguments) {
  using namespace verify;
  if (count == 2 && (std::strcmp(arguments[1], "--help") == 0 || std::strcmp(arguments[1], "-h") == 0))
    return std::fputs(usage, stdout), proved;
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
