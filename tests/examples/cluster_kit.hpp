// What tests of clusters share: processes that run beside the test, and small clusters for them.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/examples/program_kit.hpp"

namespace luxodus::program {

/// A program that runs beside the test; what it says can be read. Killed at the end if it lives.
class Process {
 public:
  Process(const std::string& program, std::vector<std::string> words) {
    words.insert(words.begin(), program);
    int ends[2];
    REQUIRE(::pipe2(ends, O_CLOEXEC) == 0);
    said_ = ends[0];
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    REQUIRE(::posix_spawn(&id_, program.c_str(), &actions, nullptr, arguments.data(), environ) ==
            0);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
  }
  ~Process() {
    if (id_ > 0) {
      kill(SIGKILL);
      ::waitpid(id_, nullptr, 0);
    }
    ::close(said_);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void kill(int signal) const { ::kill(id_, signal); }

  /// Reads on until it has said these words; false: it ended before.
  bool says(const std::string& words) {
    while (text_.find(words) == std::string::npos)
      if (!read_more()) return false;
    return true;
  }
  /// Reads all until it has ended; its exit code, or 128 and the signal.
  int wait() {
    while (read_more()) {
    }
    int status = 0;
    ::waitpid(id_, &status, 0);
    id_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  /// What it has said so far.
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
  std::string text_;
};

inline std::string smoke_tank() {
  return (fs::path(LUX_SOURCE_DIR) / "scenes/library/smoke_tank.toml").string();
}

/// What of a small cluster's file tests change.
struct ClusterText {
  int workers = 1;
  std::string scene = smoke_tank();
  std::string run = "particles = 400_000\n";  // more of [run]
  std::string more = "[timeouts]\nstart_s = 2\nlost_s = 1\n";
};

/// Writes FOLDER/FILE.toml: workers n0, n1, ... and a controller, each a process, on this machine.
/// All of a folder are the same run, whatever their files are called.
inline std::string write_cluster(const Folder& folder, const ClusterText& text,
                                 const std::string& file = "cluster") {
  const fs::path path = folder.path / (file + ".toml");
  std::ofstream out(path);
  out << "[run]\nname = \"" << folder.path.filename().string().substr(8) << "\"\nscene = \""
      << text.scene << "\"\nout = \"" << (folder.path / "out").string() << "\"\n"
      << text.run << "[[host]]\nname = \"here\"\n";
  for (int i = 0; i < text.workers; ++i) out << "[[node]]\nname = \"n" << i << "\"\n";
  out << "[[node]]\nname = \"controller\"\nrole = \"controller\"\n" << text.more;
  return path.string();
}

/// A node of a cluster, as `luxodus node` starts it.
inline std::unique_ptr<Process> node(const std::string& cluster, const std::string& name) {
  return std::make_unique<Process>(
      LUX_PROGRAM, std::vector<std::string>{"node", "--config", cluster, "--name", name});
}

}  // namespace luxodus::program
