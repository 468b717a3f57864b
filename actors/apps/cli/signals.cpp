#include "actors/apps/cli/signals.hpp"

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <ctime>

#include "actors/apps/cli/command.hpp"

namespace luxodus::cli {

namespace {

std::atomic<bool> interrupted_flag{false};
std::atomic<int64_t> interrupted_at{0};
static_assert(std::atomic<int64_t>::is_always_lock_free);

/// A deliberate second signal ends the program at once: one Ctrl-C may arrive twice, at the process
/// and at its group.
void on_interrupt(int) {
  constexpr int64_t one_press_ns = 300'000'000;
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  const int64_t now_ns = int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
  if (!interrupted_flag.exchange(true)) {
    interrupted_at = now_ns;
  } else if (now_ns - interrupted_at > one_press_ns) {
    std::_Exit(ExitCode::interrupted);
  }
}

std::atomic<bool> preview_wanted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void on_preview(int) {
  preview_wanted = true;
}

}  // namespace

std::atomic<bool>& preview_flag() {
  return preview_wanted;
}

void install_preview_handler() {
  std::signal(SIGUSR1, on_preview);
}

const std::atomic<bool>& interrupt_flag() {
  return interrupted_flag;
}

void install_interrupt_handler() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}

}  // namespace luxodus::cli
