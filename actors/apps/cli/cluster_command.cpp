// luxodus cluster up: runs all processes of a cluster that belong on this machine, as children of
// this one. They have ended when it ends.
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/load_cluster.hpp"
#include "runtime/core/log.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct ClusterOptions {
  std::string config;
  std::string host;
};

/// Child processes; the destructor stops those still alive. wait() forwards Ctrl-C and SIGTERM to
/// them.
class Children {
 public:
  Children() {
    ::sigemptyset(&watched_);
    for (const int signal : {SIGCHLD, SIGINT, SIGTERM}) ::sigaddset(&watched_, signal);
    ::sigprocmask(SIG_BLOCK, &watched_, &before_);
  }
  ~Children() {
    tell_all();
    for (const Child& child : living_) ::waitpid(child.pid, nullptr, 0);
    ::sigprocmask(SIG_SETMASK, &before_, nullptr);
  }
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;

  /// Errors: the system starts no more processes.
  Result<void> start(const ClusterConfig& cluster, const ClusterProcess& process) {
    std::vector<std::string> words{"luxodus", "node", "--config",
                                   fs::absolute(cluster.file).string()};
    for (const NodeId node : process.nodes) {
      words.emplace_back("--name");
      words.push_back(cluster.node(node).name);
    }
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t pid = 0;
    // In a process group of its own, so that it gets Ctrl-C only once, from here.
    posix_spawnattr_t apart;
    ::posix_spawnattr_init(&apart);
    ::posix_spawnattr_setflags(&apart, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
    ::posix_spawnattr_setsigmask(&apart, &before_);
    const int failed =
        ::posix_spawn(&pid, "/proc/self/exe", nullptr, &apart, arguments.data(), environ);
    ::posix_spawnattr_destroy(&apart);
    if (failed != 0) return problem_in(process.name, "cannot be started", kind_of_errno(failed));
    living_.push_back({pid, process.name});
    return {};
  }

  /// Waits until all have ended. The controller's process decides: if it fails, the others are
  /// ended, and its exit code is returned; if it succeeds, the run continued without those that
  /// failed. The display's process, which may write results for longer, is the next to decide.
  /// Without a controller (it is on another host), the first failure gives the exit code.
  int wait(const std::string& controller, const std::string& display) {
    for (reap(controller, display); !living_.empty(); reap(controller, display)) {
      int signal = 0;
      if (::sigwait(&watched_, &signal) != 0 || signal == SIGCHLD) continue;
      if (told_) std::_Exit(ExitCode::interrupted);  // a second signal: do not wait
      tell_all();
    }
    return result_ != 0 ? result_ : shown_;
  }

 private:
  struct Child {
    pid_t pid;
    std::string name;
  };

  /// Collects processes that have ended.
  void reap(const std::string& controller, const std::string& display) {
    int status = 0;
    for (pid_t pid = 0; (pid = ::waitpid(-1, &status, WNOHANG)) > 0;) {
      const auto child = std::find_if(living_.begin(), living_.end(),
                                      [&](const Child& c) { return c.pid == pid; });
      if (child == living_.end()) continue;
      const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      const bool decides = controller.empty() ? result_ == 0 : child->name == controller;
      const bool all_end = code != 0 && child->name == controller;
      if (code != 0) log_error("process {} ended with {}", child->name, code);
      if (decides) result_ = code;
      if (child->name == display) shown_ = code;
      living_.erase(child);
      if (all_end) tell_all();
    }
  }

  /// Signals all to end, once: a second signal would end them without their results.
  void tell_all() {
    if (std::exchange(told_, true)) return;
    for (const Child& child : living_) ::kill(child.pid, SIGTERM);
  }

  sigset_t watched_;
  sigset_t before_;
  std::vector<Child> living_;
  bool told_ = false;
  int result_ = 0;
  int shown_ = 0;  // exit code of the display
};

Result<ExitCode> cluster_up(const ClusterOptions& options) {
  const auto [read, told] = load_cluster(options.config);
  if (!read) return exit_code_of(told);
  const ClusterConfig& cluster = *read;
  const auto host = std::find_if(
      cluster.hosts.begin(), cluster.hosts.end(),
      [&](const ClusterHost& h) { return options.host.empty() || h.name == options.host; });
  if (host == cluster.hosts.end() || (options.host.empty() && cluster.hosts.size() > 1))
    return problem_in(options.config,
                      options.host.empty()
                          ? "the cluster has several hosts: say which is this, --host"
                          : "there is no host \"" + options.host + "\"");
  Children children;
  std::string controller, display;
  for (const ClusterProcess& process : cluster.processes) {
    if (&cluster.hosts[process.host] != &*host) continue;
    if (process.nodes.back() == cluster.controller()) controller = process.name;
    const auto& nodes = process.nodes;
    if (cluster.is_run() && std::count(nodes.begin(), nodes.end(), cluster.display.node) > 0)
      display = process.name;
    if (auto ok = children.start(cluster, process); !ok) return ok.problem();
  }
  return static_cast<ExitCode>(children.wait(controller, display));
}

}  // namespace

Command cluster_command() {
  const auto o = std::make_shared<ClusterOptions>();
  Command up{
      .name = "up",
      .summary = "Start all nodes that belong on this machine",
      .options = {{"config", &o->config, "Cluster file", {.form = Form::file, .required = true}},
                  {"--host",
                   &o->host,
                   "Name of this machine among the hosts of the file",
                   {.form = Form::name, .otherwise = "the only host"}}},
      .notes =
          "Starts a process of `luxodus node` for each process of the file's host, and "
          "waits. The controller's process decides how it ends: all stop when that "
          "fails or Ctrl-C is pressed; a worker that fails is reported, and the run "
          "goes on without it.\n"
          "  luxodus cluster up actors/apps/cli/examples/one_host.toml",
      .run = [o] { return exit_code_of(cluster_up(*o)); }};
  return {.name = "cluster",
          .summary = "Start the nodes of a cluster",
          .heading = "Cluster",
          .commands = {std::move(up)}};
}

}  // namespace luxodus::cli
