// The program's only context switch: an execution on a stack of its own that is entered and left in
// turn. It is Boost.Context's jump plus what a jump does not save: the C++ runtime's exception
// state (it is per thread, so two executions suspended in catch blocks would rethrow each other's
// exceptions) and the sanitizers' state. Boost keeps floating-point control (MXCSR and the x87
// word) per execution; a new one starts with its maker's. Thread rule: an execution never changes
// its thread. It is not unwound when it is destroyed: let it end first.
#pragma once

#include <cxxabi.h>

#include <boost/context/detail/fcontext.hpp>
#include <cstddef>

#include "runtime/fiber/sanitizers.hpp"

namespace luxodus {

/// The bytes [low, low + bytes) that an execution runs on; it grows down from the end.
struct StackSpan {
  char* low = nullptr;
  size_t bytes = 0;
};

/// True while this thread's current execution throws, unwinds or handles an exception.
bool exception_in_flight() noexcept;

class Context {
 public:
  using Entry = void (*)(void* argument);

  Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context();

  /// Puts `entry(argument)` on the stack; the first enter() starts it. It must never return, and no
  /// exception may leave it. Requires: called once; the stack outlives this.
  void prepare(StackSpan stack, Entry entry, void* argument);

  /// Runs the execution until it leaves. Requires: called from outside of it, on its thread.
  void enter() noexcept;

  /// Returns to the caller of enter(), and continues at the next enter(). Requires: called from
  /// inside.
  void leave() noexcept;

 private:
  // What __cxa_get_globals() points to, by the Itanium C++ ABI (2.2.2): 16 bytes.
  struct ExceptionState {
    void* caught = nullptr;
    unsigned int uncaught = 0;
  };
  // What AddressSanitizer must know of the stack that is switched to.
  struct AddressSanitizerView {
    void* fake_stack = nullptr;
    const void* low = nullptr;
    size_t bytes = 0;
  };
  friend bool exception_in_flight() noexcept;

  static ExceptionState& thread_exceptions() noexcept;
  void begin() noexcept;

  // Where the next switch goes: to the execution while it rests, to its caller while it runs.
  void* inside_ = nullptr;
  void* outside_ = nullptr;
  Entry entry_ = nullptr;
  void* argument_ = nullptr;
  ExceptionState exceptions_;
  AddressSanitizerView inside_view_, outside_view_;
  void* inside_thread_ = nullptr;  // ThreadSanitizer's handles of the two
  void* outside_thread_ = nullptr;
};

// These three are inline because the processor mispredicts every return after a switch: one frame
// less on either side saves a third of its cost.

inline Context::ExceptionState& Context::thread_exceptions() noexcept {
  static_assert(sizeof(ExceptionState) == 16);
  return *reinterpret_cast<ExceptionState*>(abi::__cxa_get_globals());
}

inline bool exception_in_flight() noexcept {
  const Context::ExceptionState& state = Context::thread_exceptions();
  return state.caught != nullptr || state.uncaught != 0;
}

inline void Context::enter() noexcept {
  ExceptionState& current = thread_exceptions();
  const ExceptionState ours = current;
  current = exceptions_;
  outside_thread_ = sanitizers::this_thread();
  sanitizers::start_switch(&outside_view_.fake_stack, inside_view_.low, inside_view_.bytes);
  sanitizers::switch_thread(inside_thread_);
  inside_ = boost::context::detail::jump_fcontext(inside_, this).fctx;
  sanitizers::finish_switch(outside_view_.fake_stack, nullptr, nullptr);
  exceptions_ = current;
  current = ours;
}

inline void Context::leave() noexcept {
  sanitizers::start_switch(&inside_view_.fake_stack, outside_view_.low, outside_view_.bytes);
  sanitizers::switch_thread(outside_thread_);
  outside_ = boost::context::detail::jump_fcontext(outside_, nullptr).fctx;
  sanitizers::finish_switch(inside_view_.fake_stack, &outside_view_.low, &outside_view_.bytes);
}

}  // namespace luxodus
