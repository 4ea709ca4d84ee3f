/// Bytes as the words of a command line. A line break ends a word, and a NUL byte stands for a line break in one.
///
/// The words are read as the program reads them. After a '!' in front the verb also acts, if no option names a file,
/// with Ctrl-C pressed before it starts: it reads MODEL, checks --set, --state, --sweep and the like against it, makes
/// the System, and stops.
#include "arguments.hpp"

#include <algorithm>

#include "lines.hpp"
#include "target.hpp"
#include "verb.hpp"

namespace slapstick::fuzz {
namespace {

using Words = std::vector<std::string>;

/// Writes no file, and does nothing that cannot be stopped.
bool harmless(const Words& words) {
  static const Words verbs = {"check",   "show",  "simulate", "classify", "poincare",
                              "diagram", "orbit", "continue", "curve"};
  static const Words options = {
      "--set",         "--state",     "--sweep", "--periods",   "--time",   "--samples",    "--physical",
      "--section",     "--phase",     "--event", "--transient", "--points", "--impacts",    "--most-periods",
      "--most-n",      "--direction", "--start", "--stop",      "--orbit",  "--starts",     "--seed",
      "--all",         "--max-n",     "--max-p", "--param",     "--params", "--range",      "--step",
      "--same-events", "--branches",  "--table", "--from",      "--which",  "--sensitivity"};
  const auto known = [](const Words& list, const std::string& word) {
    return std::find(list.begin(), list.end(), word) != list.end();
  };
  return known(verbs, words[0]) && std::all_of(words.begin() + 1, words.end(), [&](const std::string& word) {
           return word.empty() || word[0] != '-' || known(options, word.substr(0, word.find('=')));
         });
}

void read(const Words& words, bool acts) {
  static const std::atomic<bool> stop{true};
  for (const app::Verb& verb : app::verbs()) {
    if (words[0] != verb.name) continue;
    app::Arguments arguments(verb.name, verb.summary);
    const app::Action action = verb.add(arguments);
    const bool reads = arguments.parse({words.begin() + 1, words.end()});
    if (reads && acts && harmless(words)) (void)action(app::Context{stop});
  }
}

}  // namespace
}  // namespace slapstick::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slapstick::fuzz;
  static const bool silent = std::freopen("/dev/null", "w", stdout) != nullptr;
  demand(silent, "results can be thrown away");
  std::string_view text = text_of(data, size);
  const bool acts = text.substr(0, 1) == "!";
  if (acts) text.remove_prefix(1);
  const Words words = lines_of(text);
  (void)succeeds([&] { read(words, acts); });
  return 0;
}
