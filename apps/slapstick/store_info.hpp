#pragma once
/// What a store holds, in words and numbers.
#include "io/json.hpp"
#include "map_store.hpp"

namespace slapstick::app {

/// {"verb", "version", "kernel", "options", "shard", "cells", "done", "failed", "complete", "hash"}; reads every cell.
/// @throws StorageError for a damaged one
[[nodiscard]] Json store_info(const Store& store);

}  // namespace slapstick::app
