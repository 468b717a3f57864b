#include "actors/results/formats/run_program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "runtime/core/regular_file.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

/// How much of a program's output is repeated [bytes], and read from the end of its file.
constexpr size_t repeated_bytes = 4000;
constexpr uint64_t max_said_bytes = uint64_t{1} << 20;
/// Exit code of a shell, and of some libraries, if there is no such program.
constexpr int not_found = 127;

}  // namespace

Result<int> run_program(const std::vector<std::string>& words, const fs::path& said,
                        const fs::path& folder) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const std::string kept = fs::absolute(said).string();
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, kept.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  if (!folder.empty()) ::posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  pid_t pid = 0;
  const int failed =
      ::posix_spawnp(&pid, arguments[0], &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failed == ENOENT) return -1;
  if (failed != 0) return system_problem({}, "cannot begin " + words[0], failed);
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0)
    if (errno != EINTR) return system_problem({}, "cannot wait for " + words[0], errno);
  if (!WIFEXITED(status)) return problem(words[0] + " was ended by a signal", ProblemKind::system);
  return WEXITSTATUS(status) == not_found ? -1 : WEXITSTATUS(status);
}

std::string last_words(const fs::path& said) {
  const auto bytes = read_whole_file(said, max_said_bytes);
  if (!bytes || bytes->empty()) return "";
  const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  return ", which said: " +
         text.substr(text.size() - std::min<size_t>(text.size(), repeated_bytes));
}

}  // namespace luxodus
