// A callable to run later, stored in place: a few words copied as bytes, so that setting a timer or
// starting a fiber allocates nothing. It captures pointers and numbers; its maker ensures that the
// pointers stay valid. A plain value; any thread.
#pragma once

#include <cstddef>
#include <cstring>
#include <new>
#include <type_traits>

namespace luxodus {

class Task {
 public:
  /// Six words: an object, what it is about, and a few numbers.
  static constexpr size_t max_capture_bytes = 48;

  Task() = default;

  template <class Callable, class = std::enable_if_t<!std::is_same_v<Callable, Task>>>
  Task(Callable callable)  // NOLINT: implicit on purpose, `start("reader", [this] { ... })`
      : call_([](const void* capture) { (*static_cast<const Callable*>(capture))(); }) {
    static_assert(std::is_trivially_copyable_v<Callable>, "capture pointers and numbers only");
    static_assert(sizeof(Callable) <= max_capture_bytes, "capture a pointer to what is larger");
    static_assert(alignof(Callable) <= alignof(std::max_align_t));
    new (capture_) Callable(callable);
  }

  explicit operator bool() const { return call_ != nullptr; }

  /// Requires: not empty.
  void operator()() const { call_(capture_); }

 private:
  void (*call_)(const void* capture) = nullptr;
  alignas(std::max_align_t) std::byte capture_[max_capture_bytes]{};
};

}  // namespace luxodus
