/// Finds a model by its name or reads it from a file.
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "io/builtin.hpp"
#include "io/toml_tree.hpp"
#include "slapstick/base/error.hpp"
#include "base/nearest.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick {
namespace {

bool is_path(const std::string& text) {
  constexpr std::string_view ending = ".toml";
  return text.size() >= ending.size() && text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

/// Only regular files are opened: a pipe or a device could block or never end. @throws StorageError
std::string read_file(const std::string& path) {
  const std::string where = "model file " + in_quotes(path) + ": ";
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) throw StorageError(where + "no such file");
  if (error) throw StorageError(where + error.message());
  if (std::filesystem::is_directory(status)) throw StorageError(where + "this is a folder");
  if (!std::filesystem::is_regular_file(status)) throw StorageError(where + "not a regular file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw StorageError(where + std::generic_category().message(errno));
  std::string text(toml_size_limit + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) throw StorageError(where + "cannot be read");
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

}  // namespace

std::vector<std::string> builtin_models() {
  std::vector<std::string> names;
  for (const auto& model : builtin_model_files()) names.emplace_back(model.name);
  return names;
}

ModelDefinition load_model(const std::string& name_or_path) {
  if (is_path(name_or_path)) return ModelDefinition::parse(read_file(name_or_path), name_or_path);
  for (const auto& model : builtin_model_files())
    if (model.name == name_or_path) return ModelDefinition::parse(model.text, name_or_path + " (built in)");
  std::error_code error;
  if (std::filesystem::is_directory(name_or_path, error))
    throw StorageError("model file " + in_quotes(name_or_path) + ": this is a folder");
  if (std::filesystem::is_regular_file(name_or_path, error))
    throw InputError("model file " + in_quotes(name_or_path) + ": its name must end in .toml");
  throw InputError("unknown model " + in_quotes(name_or_path) + suggestion(name_or_path, builtin_models()) +
                   " (a model file's path ends in .toml)");
}

}  // namespace slapstick
