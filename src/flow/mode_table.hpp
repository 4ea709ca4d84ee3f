#pragma once
/// The modes of a System by their ids: built when first asked for, then kept and shared by all threads.
#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "mode/mode.hpp"

namespace slapstick::flow {

class ModeTable {
 public:
  explicit ModeTable(ModeId count) : flat_(count <= most_flat ? static_cast<std::size_t>(count) : 0) {}

  /// Null if the mode was not asked for yet. Without a lock for a model with up to `most_flat` combinations.
  [[nodiscard]] const mode::Mode* find(ModeId id) {
    const auto place = static_cast<std::size_t>(id);
    return place < flat_.size() ? flat_[place].load(std::memory_order_acquire) : find_locked(id);
  }

  /// The mode, built by `build` if need be.
  const mode::Mode& get(ModeId id, const std::function<mode::Mode(ModeId)>& build);

  /// The outline of a mode that was perhaps only looked at, by `build` if need be. The first `most_outlines` are kept.
  std::shared_ptr<const mode::Outline> outline(ModeId id, const std::function<mode::Outline(ModeId)>& build);

 private:
  static constexpr ModeId most_flat = 4096;
  static constexpr std::size_t most_outlines = 1024;  ///< 36 MB for 32 coordinates

  const mode::Mode* find_locked(ModeId id);

  std::vector<std::atomic<const mode::Mode*>> flat_;
  std::map<ModeId, mode::Mode> all_;  ///< its nodes stay where they are
  std::map<ModeId, std::shared_ptr<const mode::Outline>> outlines_;
  std::mutex mutex_;
};

}  // namespace slapstick::flow
