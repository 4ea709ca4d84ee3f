#pragma once
/// Tells ThreadSanitizer where a oneTBB loop forks and joins. Compiles to nothing in any other build.
///
///     auto task = group.defer([&] {
///       fork_join::enter();  // first, before any capture is read
///       ...
///       fork_join::leave();  // last
///     });
///     fork_join::fork();     // after the task was made: its captures are shared too
///     group.run(std::move(task));
///     group.wait();
///     fork_join::join();
///
/// (Not for parallel_for, which copies its body from task to task later on.)
/// Debian's libtbb.so is not instrumented, so that ThreadSanitizer sees neither that a body starts after the loop was
/// called nor that the loop returns after its bodies. These four say just that. The four order no two bodies with each
/// other: races between them are found.

// GCC 12 is asked first: Eigen defines a __has_feature for it, which is 0 for everything.
#if defined(__SANITIZE_THREAD__)
#define SLAPSTICK_THREAD_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define SLAPSTICK_THREAD_SANITIZER 1
#endif
#endif

#ifdef SLAPSTICK_THREAD_SANITIZER
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace slapstick::fork_join {

#ifdef SLAPSTICK_THREAD_SANITIZER
inline char forked, joined;  // only their addresses matter
inline void fork() { __tsan_release(&forked); }
inline void enter() { __tsan_acquire(&forked); }
inline void leave() { __tsan_release(&joined); }
inline void join() { __tsan_acquire(&joined); }
#else
inline void fork() {}
inline void enter() {}
inline void leave() {}
inline void join() {}
#endif

}  // namespace slapstick::fork_join
