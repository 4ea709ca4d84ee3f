/// The program: finds the verb, runs it, and turns what goes wrong into one line and an exit status.
#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <new>
#include <string>
#include <vector>

#include "base/floating_point.hpp"
#include "base/nearest.hpp"
#include "base/ranges.hpp"
#include "interruption.hpp"
#include "output.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/io/model_file.hpp"
#include "verb.hpp"

namespace slapstick::app {
namespace {

/// A closed standard stream would give its number to the next file that is opened. Reading from or writing to what
/// stands in for it fails.
void occupy_standard_streams() {
  for (int descriptor = 0; descriptor <= 2; ++descriptor) {
    if (::fcntl(descriptor, F_GETFD) != -1) continue;
    if (::open("/dev/null", descriptor == 0 ? O_WRONLY : O_RDONLY) != descriptor) return;
  }
}

std::string overview() {
  std::string text =
      "slapstick: exact simulation of oscillators that stick, slip and hit stops\n\n"
      "  slapstick VERB MODEL [--set NAME=VALUE]... [options]\n\n"
      "Verbs:\n";
  for (const Verb& verb : verbs()) {
    const std::string name = verb.name;
    text += "  " + name + std::string(name.size() < 10 ? 12 - name.size() : 2, ' ') + verb.summary + "\n";
  }
  return text +
         "\n`slapstick VERB --help` tells what a verb takes; `slapstick --version` prints the version.\n"
         "\nTo begin with (vibro-impact is the oscillator of the paper):\n"
         "  slapstick show vibro-impact\n"
         "  slapstick simulate vibro-impact --periods 50 --plot motion.png\n"
         "  slapstick diagram vibro-impact --sweep omega=0.5:10:1000 --plot diagram.png --out impacts.csv\n"
         "\nResults go to standard output or to the file of --out, messages to standard error.\n"
         "Exit status: 0 done, 2 bad input, 3 the numerics did not succeed, 4 a file could not be read or written, 130 "
         "ended by Ctrl-C.\n";
}

int print(const std::string& text) {
  Output out("");
  out.write(text);
  out.commit();
  return done;
}

const Verb& find_verb(const std::string& word) {
  std::vector<std::string> names;
  for (const Verb& verb : verbs()) {
    if (word == verb.name) return verb;
    names.emplace_back(verb.name);
  }
  const bool option = !word.empty() && word[0] == '-';
  const bool model = word.ends_with(".toml") ||
                     ranges::any_of(builtin_models(), [&](const std::string& name) { return name == word; });
  if (model) throw InputError("a verb comes before the model: slapstick simulate " + word + " (see slapstick --help)");
  throw InputError((option ? "the verb comes first, not option " : "unknown verb ") + in_quotes(word) +
                   suggestion(word, names));
}

int run(const std::vector<std::string>& words) {
  if (words.empty()) throw InputError("no verb given (see slapstick --help)");
  if (words[0] == "--version") return print("slapstick " SLAPSTICK_VERSION "\n");
  if (words[0] == "--help" || words[0] == "-h" || words[0] == "help") {
    if (words.size() == 1) return print(overview());
    if (words[0] == "help") return run({words[1], "--help"});
    throw InputError("unexpected argument " + in_quotes(words[1]));
  }
  const Verb& verb = find_verb(words[0]);
  Arguments arguments(verb.name, verb.summary);
  const Action action = verb.add(arguments);
  if (!arguments.parse({words.begin() + 1, words.end()})) return print(arguments.help());
  arguments.check_rules();
  return action(Context{stop_requested()});
}

int fail(int status, const char* message) {
  std::string line = std::string("slapstick: ") + message;
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';  // a file's name, where it is not in quotes
  }
  std::fprintf(stderr, "%s\n", line.c_str());
  return status;
}

int guarded(const std::vector<std::string>& words) {
  try {
    return run(words);
  } catch (const InputError& error) {
    return fail(2, error.what());
  } catch (const NumericalError& error) {
    return stop_requested() ? interrupted : fail(3, error.what());  // a search that was cut short has found nothing
  } catch (const StorageError& error) {
    return fail(4, error.what());
  } catch (const std::bad_alloc&) {
    return fail(3, "out of memory; ask for fewer values or points");
  } catch (const std::exception& error) {
    return fail(70, (std::string("internal error: ") + error.what()).c_str());
  }
}

}  // namespace
}  // namespace slapstick::app

int main(int argc, char** argv) {
  const slapstick::IeeeArithmetic ieee;  // a preloaded library may have switched subnormal numbers off
  slapstick::app::occupy_standard_streams();
  slapstick::app::catch_signals();
  return slapstick::app::guarded({argv + (argc > 0 ? 1 : 0), argv + argc});
}
