// Programs that run beside a test. One thread.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <string>
#include <vector>

namespace luxodus::test {

/// A program that runs beside the test; its output can be read, and its input written. Killed at
/// the end if it is alive.
class Process {
 public:
  Process(const std::string& program, std::vector<std::string> words) {
    words.insert(words.begin(), program);
    int ends[2];
    int input[2];
    REQUIRE(::pipe2(ends, O_CLOEXEC) == 0);
    REQUIRE(::pipe2(input, O_CLOEXEC) == 0);
    said_ = ends[0];
    input_ = input[1];
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    REQUIRE(::posix_spawn(&id_, program.c_str(), &actions, nullptr, arguments.data(), environ) ==
            0);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    ::close(input[0]);
  }
  ~Process() {
    if (id_ > 0) {
      kill(SIGKILL);
      ::waitpid(id_, nullptr, 0);
    }
    ::close(said_);
    ::close(input_);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void kill(int signal) const { ::kill(id_, signal); }

  /// Writes a line to its standard input. Requires: it is alive.
  void tell(const std::string& line) const {
    const std::string text = line + "\n";
    REQUIRE(::write(input_, text.data(), text.size()) == static_cast<ssize_t>(text.size()));
  }

  /// Reads until its output has these words, from a position on; false: it ended before.
  bool says(const std::string& words, size_t from = 0) {
    while (text_.find(words, from) == std::string::npos)
      if (!read_more()) return false;
    return true;
  }
  /// Reads its output up to now, and returns the position where it continues.
  size_t now() {
    pollfd ready{said_, POLLIN, 0};
    while (::poll(&ready, 1, 0) > 0 && (ready.revents & POLLIN) != 0 && read_more()) {
    }
    return text_.size();
  }
  /// Reads everything until it has ended; returns its exit code, or 128 plus the signal.
  int wait() {
    while (read_more()) {
    }
    int status = 0;
    ::waitpid(id_, &status, 0);
    id_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  /// Its output so far.
  const std::string& text() const { return text_; }
  bool said(const std::string& words) const { return text_.find(words) != std::string::npos; }

 private:
  bool read_more() {
    char piece[4096];
    const ssize_t count = ::read(said_, piece, sizeof piece);
    if (count > 0) text_.append(piece, static_cast<size_t>(count));
    return count > 0 || (count < 0 && errno == EINTR);
  }

  pid_t id_ = 0;
  int said_ = -1;
  int input_ = -1;
  std::string text_;
};

}  // namespace luxodus::test
