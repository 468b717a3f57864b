// Observes how a piece of code ends the process: it runs in a forked child, whose standard error
// and exit status are returned. For tests of assertions that abort. One thread.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <string>

namespace luxodus::test {

struct End {
  bool by_signal = false;
  int signal = 0;
  std::string standard_error;
};

/// Runs `piece` in a child; if it returns, the child exits normally.
template <class Piece>
End end_of(Piece&& piece) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return {};
  const pid_t child = fork();
  if (child == 0) {
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    for (const int fatal : {SIGABRT, SIGSEGV}) std::signal(fatal, SIG_DFL);  // Catch2's are not
    dup2(ends[1], STDERR_FILENO);
    close(ends[0]);
    piece();
    _exit(0);
  }
  close(ends[1]);
  End end;
  std::array<char, 4096> part{};
  for (ssize_t n = 0; (n = read(ends[0], part.data(), part.size())) > 0;)
    end.standard_error.append(part.data(), static_cast<size_t>(n));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  end.by_signal = WIFSIGNALED(status);
  end.signal = end.by_signal ? WTERMSIG(status) : 0;
  return end;
}

}  // namespace luxodus::test
