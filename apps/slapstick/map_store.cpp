/// Opens stores, and reads the options of `map` out of one.
#include "map_store.hpp"

#include <filesystem>
#include <system_error>

#include "base/text.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::app {

Store open_store(const std::string& path, const StoreFacts& facts, bool resume) {
  std::error_code ignored;
  if (!resume && std::filesystem::exists(path, ignored))
    throw InputError("--store: " + in_quotes(path) + " is there already; --resume goes on with it");
  try {
    return Store::to_write(path, facts, resume);
  } catch (const InputError& error) {
    throw InputError("--" + error.message());  // "--store: 'a.db' is of another run: .."
  }
}

std::unique_ptr<MapWish> wish_of(const Store& store) {
  if (store.fact("verb") != "map")
    throw InputError("store export: the store is of " + in_quotes(store.fact("verb")) +
                     ", not of a map; the verb itself with --store and --resume writes its tables");
  MapOptions options;
  Arguments arguments("map", "");
  options.declare(arguments);
  std::vector<std::string> words{"MODEL"};
  for (const std::string& word : split(store.fact("options"), '\n')) words.push_back(word);
  static_cast<void>(arguments.parse(words));
  options.shard = store.fact("shard");
  return map_wish(options, options.model.with_sets(ModelDefinition::parse(store.fact("model"), "the store's model")));
}

}  // namespace slapstick::app
