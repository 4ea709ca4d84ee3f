/// slapstick show MODEL
#include "model_options.hpp"
#include "output.hpp"
#include "verb.hpp"

namespace slapstick::app {

Action add_show(Arguments& arguments) {
  struct Options {
    ModelOptions model;
    std::string out;
  };
  auto options = std::make_shared<Options>();
  options->model.declare(arguments);
  arguments.text("--out", options->out, "FILE", "write there instead of to standard output");
  arguments.footer(
      "The result is a complete model file; with --set, the values become its defaults:\n"
      "  slapstick show vibro-impact --set omega=4.9 --out mine.toml\n"
      "  slapstick simulate mine.toml");
  return [options](const Context&) {
    FileRoles roles;
    roles.add("MODEL", options->model.source);
    roles.add("--out", options->out);
    const ChosenModel chosen = options->model.load();
    const std::string text = chosen.definition.to_toml(chosen.overrides);
    Output out(options->out);
    out.write(text);
    out.commit();
    return done;
  };
}

}  // namespace slapstick::app
