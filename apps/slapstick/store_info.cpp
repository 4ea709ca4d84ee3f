/// Says what a store holds.
#include "store_info.hpp"

#include <algorithm>

#include "arguments.hpp"
#include "base/text.hpp"
#include "map_store.hpp"

namespace slapstick::app {
namespace {

/// The cells of the whole map that a shard is a part of count only where the store is of the whole.
bool is_whole(const Store& store) { return store.fact("shard") == "1/1"; }

/// A refined map has what its own rounds ask for.
bool is_refined_to_the_end(const Store& store) {
  if (store.fact("verb") != "map") return false;
  const std::unique_ptr<MapWish> wish = wish_of(store);
  return wish->problem.refine > 0 && chart::read_map(store, wish->problem).complete;
}

}  // namespace

Json store_info(const Store& store) {
  long cells = 0, failed = 0;
  store.for_each([&](const StoredCell& cell) {
    ++cells;
    failed += cell.failure.empty() ? 0 : 1;
  });
  Json json = Json::object();
  for (const char* name : {"verb", "version", "kernel", "shard"}) json.set(name, store.fact(name));
  std::string options = store.fact("options");
  std::replace(options.begin(), options.end(), '\n', ' ');
  const long long whole = parse_integer("cells", store.fact("cells"), 0, 1'000'000'000'000);
  json.set("options", options).set("cells", whole).set("done", cells).set("failed", failed);
  if (is_whole(store)) json.set("complete", cells == whole || is_refined_to_the_end(store));
  return json.set("hash", store.hash());
}

}  // namespace slapstick::app
