/// Keeps modes by their ids, under a lock where that is needed.
#include "flow/mode_table.hpp"

namespace slapstick::flow {

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

std::shared_ptr<const mode::Outline> ModeTable::outline(ModeId id, const std::function<mode::Outline(ModeId)>& build) {
  {
    const std::scoped_lock lock(mutex_);
    if (const auto found = outlines_.find(id); found != outlines_.end()) return found->second;
  }
  auto made = std::make_shared<const mode::Outline>(build(id));
  const std::scoped_lock lock(mutex_);
  if (outlines_.size() < most_outlines) outlines_.emplace(id, made);
  return made;
}

}  // namespace slapstick::flow
