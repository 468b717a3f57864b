#include "runtime/fiber/overflow_report.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <string>

#include "runtime/fiber/stack_pool.hpp"

namespace luxodus {

namespace {

// A signal handler is given nothing but an address, so this room keeps the program's only global
// state: which mappings are stacks. Slots are claimed by compare-and-swap, since nodes of a process
// start concurrently; the handler only reads.
constexpr size_t max_pools = 1024;  // nodes of one process, simulated ones included
std::array<std::atomic<const StackPool*>, max_pools> watched_pools{};

// The previous handler, for faults elsewhere. Written before ours is installed.
struct sigaction handler_before {};

void report_overflow(const StackPool::Place& place) noexcept {
  std::array<char, 160> line{};
  const int length = std::snprintf(
      line.data(), line.size(),
      "luxodus: fiber %zu (%s) overflowed its stack of %zu bytes; raise stack_kb\n", place.index,
      place.owner == nullptr ? "unnamed" : place.owner, place.stack_bytes);
  if (length > 0 && write(STDERR_FILENO, line.data(), static_cast<size_t>(length)) < 0) return;
}

// Ends by returning: the faulting instruction runs again and meets the handler installed here. A
// signal sent by a process has no such instruction, and is raised again.
void on_fault(int number, siginfo_t* info, void*) noexcept {
  for (const auto& watched : watched_pools) {
    const StackPool* pool = watched.load(std::memory_order_acquire);
    if (pool == nullptr) continue;
    const StackPool::Place place = pool->place_of(info->si_addr);
    if (!place.in_guard) continue;
    report_overflow(place);
    signal(number, SIG_DFL);
    return;
  }
  sigaction(number, &handler_before, nullptr);
  if (info->si_code <= 0) raise(number);
}

void install_handler() {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  struct sigaction current {};
  struct sigaction ours {};
  ours.sa_sigaction = on_fault;
  ours.sa_flags = SA_SIGINFO | SA_ONSTACK;
  sigemptyset(&ours.sa_mask);
  bool done = sigaction(SIGSEGV, nullptr, &current) == 0;
  if (done && current.sa_sigaction == on_fault) return;
  handler_before = current;
  done = done && sigaction(SIGSEGV, &ours, nullptr) == 0;
  if (!done)
    throw std::runtime_error(std::string("cannot watch for stack overflows: ") +
                             std::strerror(errno));
}

}  // namespace

namespace overflow_watch {

void add(const StackPool& pool) {
  for (auto& slot : watched_pools) {
    const StackPool* free = nullptr;
    if (slot.compare_exchange_strong(free, &pool)) return;
  }
  throw std::runtime_error("more than 1024 pools of fiber stacks in one process");
}

void remove(const StackPool& pool) noexcept {
  for (auto& slot : watched_pools) {
    const StackPool* ours = &pool;
    if (slot.compare_exchange_strong(ours, nullptr)) return;
  }
}

}  // namespace overflow_watch

// Enough for the handler and the C library's formatting.
struct OverflowReport::AlternateStack {
  alignas(16) std::array<char, 64 * 1024> bytes;
  stack_t before{};
};

OverflowReport::OverflowReport() : stack_(new AlternateStack) {
  stack_t mine{};
  mine.ss_sp = stack_->bytes.data();
  mine.ss_size = stack_->bytes.size();
  if (sigaltstack(&mine, &stack_->before) != 0)
    throw std::runtime_error(std::string("cannot set a stack for signals: ") +
                             std::strerror(errno));
  install_handler();
}

OverflowReport::~OverflowReport() {
  sigaltstack(&stack_->before, nullptr);
}

}  // namespace luxodus
