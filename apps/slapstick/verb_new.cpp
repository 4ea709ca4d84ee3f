/// slapstick new NAME
#include <filesystem>

#include "base/text.hpp"
#include "io/json.hpp"
#include "output.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/io/model_file.hpp"
#include "verb.hpp"

namespace slapstick::app {
namespace {

namespace fs = std::filesystem;

/// NAME as a path that ends in .toml.
fs::path file_of(const std::string& name) {
  fs::path file(name);
  if (file.extension() != ".toml") file += ".toml";
  return file;
}

int write_new(const std::string& name) {
  const fs::path file = file_of(name);
  std::string text;
  try {
    text = new_model(file.stem().string());
  } catch (const InputError& error) {
    throw InputError(std::string("NAME: ") + error.what());
  }
  std::error_code error;
  if (fs::symlink_status(file, error).type() != fs::file_type::not_found && !error)
    throw StorageError("cannot write " + in_quotes(file.string()) + ": the file exists, and `new` overwrites nothing");
  write_atomically(file, text);
  Json next = Json::list();
  for (const char* verb : {"check ", "simulate "}) next.push("slapstick " + (verb + file.string()));
  Json result = Json::object();
  result.set("written", file.string()).set("next", std::move(next));
  Output out("");
  out.write(result.dump() + "\n");
  out.commit();
  return done;
}

}  // namespace

Action add_new(Arguments& arguments) {
  auto name = std::make_shared<std::string>();
  arguments.positional("NAME", *name, "the model's name; the file is NAME.toml");
  arguments.footer(
      "Writes a commented model file that works as it is, with an example of every key. Overwrites nothing.\n"
      "  slapstick new mine\n"
      "  slapstick check mine.toml");
  return [name](const Context&) { return write_new(*name); };
}

}  // namespace slapstick::app
