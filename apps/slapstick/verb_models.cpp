/// slapstick models
#include <unistd.h>

#include "io/json.hpp"
#include "output.hpp"
#include "slapstick/io/model_file.hpp"
#include "verb.hpp"

namespace slapstick::app {

namespace {

std::string table() {
  std::string text;
  for (const std::string& name : builtin_models())
    text += name + std::string(name.size() < 28 ? 28 - name.size() : 2, ' ') + load_model(name).summary() + "\n";
  return text;
}

std::string json() {
  Json list = Json::list();
  for (const std::string& name : builtin_models()) {
    Json entry = Json::object();
    entry.set("name", name).set("summary", load_model(name).summary());
    list.push(std::move(entry));
  }
  return list.dump() + "\n";
}

}  // namespace

Action add_models(Arguments& arguments) {
  arguments.footer(
      "Prints the name and summary of each model: a table on a terminal, JSON elsewhere.\n"
      "`slapstick show NAME` prints one as a model file.");
  return [](const Context&) {
    Output out("");
    out.write(::isatty(STDOUT_FILENO) != 0 ? table() : json());
    out.commit();
    return done;
  };
}

}  // namespace slapstick::app
