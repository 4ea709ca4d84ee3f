#include "slapstick/flow/mode_table.hpp"

namespace slapstick {

const mode::Mode* ModeTable::find_locked(ModeId id) {
  const std::scoped_lock lock(mutex_);
  const auto found = all_.find(id);
  return found == all_.end() ? nullptr : &found->second;
}

const mode::Mode& ModeTable::get(ModeId id, const std::function<mode::Mode(ModeId)>& build) {
  if (const mode::Mode* known = find(id)) return *known;
  const std::scoped_lock lock(mutex_);
  auto found = all_.find(id);
  if (found == all_.end()) found = all_.emplace(id, build(id)).first;
  const auto place = static_cast<std::size_t>(id);
  if (place < flat_.size()) flat_[place].store(&found->second, std::memory_order_release);
  return found->second;
}

}  // namespace slapstick
