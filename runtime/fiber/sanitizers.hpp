// Sanitizer annotations of stacks and switches; the functions are empty in a build without
// sanitizers. For this room only. Thread rule: they act on the calling thread.
#pragma once

#include <cstddef>

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#include <sanitizer/common_interface_defs.h>
#endif
#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace luxodus::sanitizers {

#if defined(__SANITIZE_ADDRESS__)
inline void start_switch(void** fake_stack, const void* low, size_t bytes) noexcept {
  __sanitizer_start_switch_fiber(fake_stack, low, bytes);
}
inline void finish_switch(void* fake_stack, const void** left_low, size_t* left_bytes) noexcept {
  __sanitizer_finish_switch_fiber(fake_stack, left_low, left_bytes);
}
/// Frames that never returned leave their red zones behind; the next owner of the stack must not
/// hit them.
inline void forget_frames(const void* low, size_t bytes) noexcept {
  __asan_unpoison_memory_region(low, bytes);
}
#else
inline void start_switch(void**, const void*, size_t) noexcept {}
inline void finish_switch(void*, const void**, size_t*) noexcept {}
inline void forget_frames(const void*, size_t) noexcept {}
#endif

#if defined(__SANITIZE_THREAD__)
inline void* make_thread() noexcept {
  return __tsan_create_fiber(0);
}
inline void end_thread(void* thread) noexcept {
  if (thread != nullptr) __tsan_destroy_fiber(thread);
}
inline void* this_thread() noexcept {
  return __tsan_get_current_fiber();
}
inline void switch_thread(void* to) noexcept {
  __tsan_switch_to_fiber(to, 0);
}
#else
inline void* make_thread() noexcept {
  return nullptr;
}
inline void end_thread(void*) noexcept {}
inline void* this_thread() noexcept {
  return nullptr;
}
inline void switch_thread(void*) noexcept {}
#endif

/// Frames are larger with red zones, or without an optimiser to share stack slots.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__OPTIMIZE__)
inline constexpr size_t stack_factor = 4;
#else
inline constexpr size_t stack_factor = 1;
#endif

}  // namespace luxodus::sanitizers
