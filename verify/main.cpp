/// slapstick-verify: checks a certificate (docs/reference/certificate.md) in ball arithmetic, sharing no code.
#include <cstdio>
#include <fstream>
#include <iostream>

#include "usage.hpp"
#include "verdict.hpp"

namespace verify {
namespace {

enum Status { proved = 0, not_proved = 1, unreadable = 2, proved_but_for = 3 };

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
  if (count != 2) return std::fputs(usage().c_str(), stderr), unreadable;
  const std::string name = arguments[1];
  if (name == "--help" || name == "-h") return std::fputs(usage().c_str(), stdout), proved;
  if (name == "--man") return std::fputs(manual().c_str(), stdout), proved;
  if (name == "--version") return std::puts("slapstick-verify " SLAPSTICK_VERSION), proved;
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
