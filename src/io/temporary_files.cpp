/// Keeps a list of temporary files that a signal handler may read.
#include "io/temporary_files.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>

#include "io/atomic_file.hpp"

namespace slapstick {
namespace {

enum SlotState : int { free_slot, filling, noted, being_removed };

struct Slot {
  std::atomic<int> state{free_slot};
  std::array<char, 4096> path{};
};
static_assert(std::atomic<int>::is_always_lock_free);

std::array<Slot, 64> slots;

}  // namespace

int note_temporary(const std::filesystem::path& path) noexcept {
  const std::string& name = path.native();
  if (name.size() >= slots[0].path.size()) return -1;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    int expected = free_slot;
    if (!slots[i].state.compare_exchange_strong(expected, filling)) continue;
    std::memcpy(slots[i].path.data(), name.c_str(), name.size() + 1);
    slots[i].state.store(noted);
    return static_cast<int>(i);
  }
  return -1;
}

/// A slot that the signal handler has taken stays with it: its path must not change while it is read.
void forget_temporary(int note) noexcept {
  if (note < 0) return;
  int expected = noted;
  slots[static_cast<std::size_t>(note)].state.compare_exchange_strong(expected, free_slot);
}

void remove_temporary_files() noexcept {
  for (Slot& slot : slots) {
    int expected = noted;
    if (slot.state.compare_exchange_strong(expected, being_removed)) ::unlink(slot.path.data());
  }
}

}  // namespace slapstick
