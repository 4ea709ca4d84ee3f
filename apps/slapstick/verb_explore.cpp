/// slapstick explore [MODEL]
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <iterator>

#include "base/ranges.hpp"
#include "page_server.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/io/model_file.hpp"
#include "verb.hpp"

namespace slapstick::app {
namespace {

struct Options {
  std::string model = "vibro-impact", page;
  long long port = 0;
  bool no_browser = false;
};

/// Asks the desktop to open an address; a machine without one is no error, because the address is printed too.
void open_browser(const std::string& address) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (::fork() == 0) {  // nobody waits for the browser
      std::freopen("/dev/null", "w", stdout);
      std::freopen("/dev/null", "w", stderr);
      ::execlp("xdg-open", "xdg-open", address.c_str(), nullptr);
      ::_exit(1);
    }
    ::_exit(0);
  }
  if (child > 0) ::waitpid(child, nullptr, 0);
}

/// Read anew for each request, so that the page shows what an editor has saved.
std::string text_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

int run(const Options& options, const Context& context) {
  (void)load_model(options.model);  // what is wrong with it is said before a browser opens
  const std::vector<std::string> names = builtin_models();
  const bool built_in = ranges::find(names, options.model) != names.end();
  Served served{page_folder(options.page), nullptr};
  if (!built_in) served.model = [path = options.model] { return text_of(path); };
  serve_page(served, static_cast<int>(options.port), context.stop, [&](const std::string& address) {
    const std::string whole = address + (built_in ? "#model=" + options.model : "");
    std::printf("%s\n", whole.c_str());
    std::fflush(stdout);
    std::fprintf(stderr, "slapstick: the explorer is served to this machine; Ctrl-C ends it\n");
    if (!options.no_browser) open_browser(whole);
  });
  return done;
}

}  // namespace

Action add_explore(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  arguments.optional_positional("MODEL", options->model, "a built-in model or a .toml file (vibro-impact)");
  arguments.text("--page", options->page, "FOLDER",
                 "the explorer's files, as ./dev web builds them; else beside the program");
  arguments.count("--port", options->port, 0, 65535, "of 127.0.0.1; 0: any that is free");
  arguments.flag("--no-browser", options->no_browser, "print the address only");
  arguments.footer(
      "Serves the explorer on the loopback and opens the browser. Other machines and other host names are refused.\n"
      "  slapstick explore shaken-table\n"
      "  slapstick explore mine.toml --no-browser");
  return [options](const Context& context) { return run(*options, context); };
}

}  // namespace slapstick::app
