// Signals that a command handles: Ctrl-C (and SIGTERM), and SIGUSR1. Handlers and flags are the
// process'; any thread may read them.
#pragma once

#include <atomic>

namespace luxodus::cli {

/// Set by Ctrl-C (and SIGTERM) once installed; the second Ctrl-C ends the program at once.
const std::atomic<bool>& interrupt_flag();
void install_interrupt_handler();

/// Set by SIGUSR1 once installed: requests pictures now.
std::atomic<bool>& preview_flag();
void install_preview_handler();

}  // namespace luxodus::cli
