/// Counts every allocation of the test program. In a file of its own, or GCC inlines one half of the pair and warns of
/// the other.
#include <cstdlib>
#include <new>

long allocations = 0;

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
