// Fibers: the concurrent tasks of a node. Each has a stack of its own and runs until it suspends,
// on the node's one thread, so nothing else changes between two suspends. They are made at start
// and reused; starting, suspending, waking and ending allocate nothing. A WaitList is a list
// through the fibers themselves. The fiber woken first runs first.
// A fiber is never destroyed from outside: when it is cancelled, its next suspend says so and its
// body returns, so destructors run as usual. Thread rule: all calls are made on the node's thread.
//
//    resting --start--> ready --run_next--> running --suspend--> suspended
//       ^                ^ ^                 |   |                   |
//       |                | +------yield------+   |                   |
//       |                +----- wake, cancel ----|-------------------+
//       +--------------------- body returns -----+
#pragma once

#include <optional>
#include <string>

#include "runtime/core/fixed_pool.hpp"
#include "runtime/core/ids.hpp"
#include "runtime/core/intrusive_list.hpp"
#include "runtime/core/task.hpp"
#include "runtime/fiber/context.hpp"
#include "runtime/fiber/stack_pool.hpp"

namespace luxodus {

/// A fiber for as long as its body runs; the same fiber started again has another id.
using FiberId = Id<struct FiberTag, uint64_t>;

/// Why a suspended fiber runs again.
enum class Wake {
  woken,      // what it waited for has happened
  timed_out,  // its deadline came first (Scheduler::wait_until)
  cancelled,  // it should release what it holds, and return
};

enum class FiberState { resting, ready, running, suspended };

class Fiber : public ListHook {
 public:
  FiberId id() const { return id_; }
  FiberState state() const { return state_; }
  /// Kind of fiber, a literal: "reader".
  const char* tag() const { return tag_; }
  /// Where it last suspended, a literal: "fetch"; "start" if it never did.
  const char* reason() const { return reason_; }
  /// What it works on, set by its body: the id of an order.
  uint64_t subject() const { return subject_; }

 private:
  friend class Fibers;

  Context context_;
  Task body_;
  FiberId id_{};
  FiberState state_ = FiberState::resting;
  Wake wake_ = Wake::woken;
  bool cancelled_ = false;
  int refusals_ = 0;  // attempts to suspend since then
  const char* tag_ = "";
  const char* reason_ = "";
  uint64_t subject_ = 0;
};

/// Fibers that wait for one event. Its source wakes one or all, in the order of waiting.
class WaitList {
 public:
  bool empty() const { return waiting_.empty(); }

 private:
  friend class Fibers;
  IntrusiveList<Fiber> waiting_;
};

struct FiberLimits {
  size_t count = 256;                          // at once
  size_t stack_bytes = default_stack_bytes();  // each
  size_t max_maps = 16'384;  // of the process's 65 530, for guards: four such nodes in a process
};

/// All fibers of a node.
class Fibers {
 public:
  /// Allocates everything it will need. Throws std::runtime_error if the system refuses.
  explicit Fibers(const FiberLimits& limits);

  /// Makes a fiber ready that runs `body`. Returns nothing if all are in use: load can cause it, so
  /// the caller waits or refuses. `tag` is a literal. The body may throw nothing.
  [[nodiscard]] std::optional<FiberId> start(const char* tag, const Task& body);

  // ---- called on a fiber -------------------------------------------------------------------

  /// Suspends until wake() or cancel(); returns `cancelled` at once if it was cancelled before.
  /// `reason` is a literal. Requires: on a fiber; no exception in flight, since a handler belongs
  /// to one stack; no NoSuspend alive. Suspends.
  [[nodiscard]] Wake suspend(const char* reason);
  /// Suspends in a list, until one of its wakes. Suspends.
  [[nodiscard]] Wake wait(WaitList& list, const char* reason);
  /// Lets all ready fibers run first. Suspends.
  [[nodiscard]] Wake yield();
  /// Whether the running fiber was cancelled.
  bool cancelled() const;
  /// Sets what the running fiber works on, for the stall report.
  void set_subject(uint64_t subject);

  // ---- called anywhere on the node's thread ------------------------------------------------

  /// The running fiber; null on the scheduler's stack.
  const Fiber* current() const { return current_; }
  /// Makes a fiber ready that is in suspend(); otherwise returns false. A fiber in a WaitList is
  /// woken only through the list, since the wake may hand something over.
  bool wake(FiberId id);
  /// Ends any suspension of a fiber with `timed_out` and removes it from its list; returns false if
  /// it is not suspended. For a timer that the fiber set, and cancels when it runs again.
  bool time_out(FiberId id);
  bool wake_one(WaitList& list);
  void wake_all(WaitList& list);
  /// Asks a fiber to end at its next suspend, or now if it is suspended. An earlier wake still
  /// counts, so that what was handed over with it is not lost. Returns false if the fiber has
  /// ended.
  bool cancel(FiberId id);
  void cancel_all();

  // ---- the scheduler -----------------------------------------------------------------------

  bool any_ready() const { return !ready_.empty(); }
  /// Runs the fiber that has been ready longest until it suspends or ends. Requires: any_ready();
  /// not on a fiber. The returned fiber may have ended: it keeps its tag and reason.
  const Fiber& run_next();

  // ---- counts ------------------------------------------------------------------------------

  size_t capacity() const { return pool_.capacity(); }
  size_t live() const { return pool_.in_use(); }
  size_t max_live() const { return pool_.max_in_use(); }
  size_t suspended() const { return suspended_; }
  const StackPool& stacks() const { return stacks_; }
  /// Bytes of a fiber without its stack, for a memory plan.
  static constexpr size_t bytes_each = sizeof(Fiber) + FixedPool<Fiber>::bytes_beside;
  /// Number of live fibers, and the first few of them: "3 fibers: reader in fetch, ...".
  std::string describe_live() const;

 private:
  friend class NoSuspend;

  static void run_bodies(void* fiber);
  static void run_body(const Fiber& fiber) noexcept;
  Wake park(IntrusiveList<Fiber>* list, FiberState state, const char* reason);
  void make_ready(Fiber& fiber, Wake how);

  StackPool stacks_;
  FixedPool<Fiber> pool_;
  IntrusiveList<Fiber> ready_;
  Fiber* current_ = nullptr;
  size_t suspended_ = 0;
  int no_suspend_ = 0;
};

/// While one exists, a suspend aborts the process: between finding an object resident and using it,
/// within a callback of another library, with a lock held.
class NoSuspend {
 public:
  explicit NoSuspend(Fibers& fibers) : fibers_(fibers) { ++fibers_.no_suspend_; }
  NoSuspend(const NoSuspend&) = delete;
  NoSuspend& operator=(const NoSuspend&) = delete;
  ~NoSuspend() { --fibers_.no_suspend_; }

 private:
  Fibers& fibers_;
};

}  // namespace luxodus
