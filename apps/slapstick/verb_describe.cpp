/// slapstick describe
#include "catalogue.hpp"
#include "output.hpp"
#include "slapstick/base/error.hpp"
#include "verb.hpp"

namespace slapstick::app {
namespace {

struct Options {
  bool json = false, markdown = false;
  std::string out;
};

int run(const Options& options) {
  if (options.json && options.markdown) throw InputError("--json and --markdown both say how: choose one");
  Output out(options.out);
  out.write(options.markdown ? catalogue_markdown() : catalogue_json());
  out.commit();
  return done;
}

}  // namespace

Action add_describe(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  arguments.flag("--json", options->json, "as JSON, for programs (this is what is written without an option, too)");
  arguments.flag("--markdown", options->markdown, "as a page of tables");
  arguments.text("--out", options->out, "FILE", "write there instead of to standard output");
  arguments.footer(
      "Every verb with its arguments, the quantities of every kind of part, the statistics and the built-in models.\n"
      "  slapstick describe --json");
  return [options](const Context&) { return run(*options); };
}

}  // namespace slapstick::app
