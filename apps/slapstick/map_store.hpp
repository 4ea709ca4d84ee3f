#pragma once
/// What a store is of, in the words of `map`.
#include <memory>

#include "map_options.hpp"
#include "slapstick/store/store.hpp"

namespace slapstick::app {

using store::Store;
using store::StoredCell;
using store::StoreFacts;

/// Store::to_write by --store and --resume. @throws InputError naming --store
[[nodiscard]] Store open_store(const std::string& path, const StoreFacts& facts, bool resume);

/// The map that a store is of: its model, options and problem. @throws InputError if it is of another verb.
/// The version is not looked at
[[nodiscard]] std::unique_ptr<MapWish> wish_of(const Store& store);

}  // namespace slapstick::app
