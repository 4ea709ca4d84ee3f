/// slapstick completion SHELL
#include "catalogue.hpp"
#include "output.hpp"
#include "verb.hpp"

namespace slapstick::app {

Action add_completion(Arguments& arguments) {
  auto shell = std::make_shared<std::string>();
  arguments.positional("SHELL", *shell, "bash, zsh or fish");
  arguments.footer(
      "Prints a script; the names of quantities and parameters come from the model of the line.\n"
      "  source <(slapstick completion bash)\n"
      "  slapstick completion zsh >~/.zfunc/_slapstick\n"
      "  slapstick completion fish >~/.config/fish/completions/slapstick.fish");
  return [shell](const Context&) {
    const std::string script = completion(*shell);
    Output out("");
    out.write(script);
    out.commit();
    return done;
  };
}

}  // namespace slapstick::app
