/// The help of slapstick-verify, and its manual page of the same sentences.
#include "usage.hpp"

#include <array>

namespace verify {
namespace {

constexpr const char* summary = "checks a certificate that `slapstick simulate --certify FILE` has written";
constexpr const char* input = "`-` reads the certificate from standard input.";
constexpr std::array<const char*, 3> notes = {
    "The motion is checked against the model in the file, in ball arithmetic of 256 bits.",
    "docs/reference/certificate.md has the rules.",
    "Standard output gets one line for each claim that does not hold (the first 20) and a report."};

struct Option {
  const char *name, *meaning;
};
constexpr std::array<Option, 3> options = {{{"--help", "print this text"},
                                            {"--man", "print the manual page, as man reads it"},
                                            {"--version", "print the version"}}};

struct Status {
  int value;
  const char* meaning;
};
constexpr std::array<Status, 4> statuses = {{{0, "proved"},
                                             {1, "not proved"},
                                             {2, "unreadable or incomplete"},
                                             {3, "proved but for what the last line names"}}};

/// Hyphens and grave accents of running text can be copied.
std::string roff(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '-' ? std::string("\\-") : c == '`' ? std::string("\\(ga") : std::string(1, c);
  return safe;
}

}  // namespace

std::string usage() {
  std::string text = std::string("slapstick-verify FILE    ") + summary + "\n\n" + input + "\n";
  for (const char* line : notes) text += std::string(line) + "\n";
  text += "\n";
  for (const Option& option : options)
    text += std::string("  ") + option.name + std::string(12 - std::string(option.name).size(), ' ') + option.meaning +
            "\n";
  text += "\nExit status:";
  for (const Status& status : statuses)
    text += (status.value == 0 ? " " : ", ") + std::to_string(status.value) + " " + status.meaning;
  return text + ".\n";
}

std::string manual() {
  std::string text = ".TH SLAPSTICK\\-VERIFY 1 \"\" \"slapstick " SLAPSTICK_VERSION
                     "\" \"User Commands\"\n.SH NAME\nslapstick\\-verify \\- " +
                     roff(summary) + "\n.SH SYNOPSIS\n.B slapstick\\-verify\n.I FILE\n.SH DESCRIPTION\n" + roff(input) +
                     "\n";
  for (const char* line : notes) text += roff(line) + "\n";
  text += ".SH OPTIONS\n";
  for (const Option& option : options) text += ".TP\n.B " + roff(option.name) + "\n" + roff(option.meaning) + "\n";
  text += ".SH EXIT STATUS\n";
  for (const Status& status : statuses)
    text += ".TP\n" + std::to_string(status.value) + "\n" + roff(status.meaning) + "\n";
  return text + ".SH SEE ALSO\n.BR slapstick (1),\n.BR slapstick\\-simulate (1)\n";
}

}  // namespace verify
