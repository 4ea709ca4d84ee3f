/// slapstick describe
#include "catalogue.hpp"
#include "output.hpp"
#include "slapstick/base/error.hpp"
#include "verb.hpp"

namespace slapstick::app {
namespace {

struct Options {
  bool json = false, markdown = false;
  std::string page, out;
};

int run(const Options& options) {
  const std::string text = options.markdown       ? catalogue_markdown()
                           : options.page.empty() ? catalogue_json()
                                                  : manual(options.page);
  Output out(options.out);
  out.write(text);
  out.commit();
  return done;
}

}  // namespace

Action add_describe(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  arguments.flag("--json", options->json, "as JSON, for programs (this is what is written without an option, too)")
      .without({"--markdown", "--man"});
  arguments.flag("--markdown", options->markdown, "as a page of tables").without({"--man"});
  arguments.text("--man", options->page, "VERB", "the manual page of a verb, or of slapstick itself, as man reads it");
  arguments.text("--out", options->out, "FILE", "write there instead of to standard output");
  arguments.footer(
      "Every verb with its arguments, the quantities of every kind of part, the statistics and the built-in models.\n"
      "  slapstick describe --json\n"
      "  slapstick describe --man map | man -l -");
  return [options](const Context&) { return run(*options); };
}

}  // namespace slapstick::app
