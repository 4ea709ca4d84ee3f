/// Finds a model by its name or reads it from a file.
#include <filesystem>
#include <system_error>

#include "base/nearest.hpp"
#include "io/builtin.hpp"
#include "io/read_file.hpp"
#include "io/toml_tree.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick {
namespace {

bool is_path(const std::string& text) { return text.ends_with(".toml"); }

}  // namespace

std::vector<std::string> builtin_models() {
  std::vector<std::string> names;
  for (const auto& model : builtin_model_files()) names.emplace_back(model.name);
  return names;
}

ModelDefinition load_model(const std::string& name_or_path) {
  if (is_path(name_or_path))
    return ModelDefinition::parse(read_file(name_or_path, "model file ", toml_size_limit), name_or_path);
  for (const auto& model : builtin_model_files())
    if (model.name == name_or_path) return ModelDefinition::parse(model.text, name_or_path + " (built in)");
  std::error_code error;
  if (std::filesystem::is_directory(name_or_path, error))
    throw StorageError("model file " + in_quotes(name_or_path) + ": a folder, not a file");
  if (std::filesystem::is_regular_file(name_or_path, error))
    throw InputError("model file " + in_quotes(name_or_path) + ": its name must end in .toml");
  throw InputError("unknown model " + in_quotes(name_or_path) + suggestion(name_or_path, builtin_models()) +
                   " (a model file's path ends in .toml)");
}

}  // namespace slapstick
