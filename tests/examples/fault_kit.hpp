// Shared by tests of faults: free ports, a controllable network (tests/tools/fault_proxy), and a
// row for each fault with the times of detection and recovery, from the controller's log.
// `tests/tools/fault_table.sh` makes a table of the rows.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include "tests/examples/cluster_kit.hpp"

namespace luxodus::program {

/// Unused ports, each with the following one. They are below those that the system assigns, and, as
/// far as possible, apart from those of tests that run in parallel.
inline std::vector<uint16_t> free_ports(size_t count) {
  const auto is_free = [](int port) {
    const int probe = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(static_cast<uint16_t>(port));
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const bool bound = ::bind(probe, reinterpret_cast<sockaddr*>(&place), sizeof place) == 0;
    ::close(probe);
    return bound;
  };
  constexpr int first = 18000, max_ports = 9000, of_a_test = 60;
  static int next = ::getpid() % (max_ports / of_a_test) * of_a_test;
  std::vector<uint16_t> ports;
  for (int tried = 0; tried < max_ports && ports.size() < count; tried += 2) {
    const int port = first + next;
    next = (next + 2) % max_ports;
    if (is_free(port) && is_free(port + 1)) ports.push_back(static_cast<uint16_t>(port));
  }
  REQUIRE(ports.size() == count);
  return ports;
}

/// A network between nodes that exists as long as this object.
class FaultProxy {
 public:
  /// Ports of links, and their targets; for each also the following port.
  explicit FaultProxy(const std::vector<std::pair<uint16_t, uint16_t>>& links)
      : process_(LUX_FAULT_PROXY, words(links)) {
    REQUIRE(process_.says("ready"));
  }
  /// Commands: see fault_proxy.cpp. In force when this returns.
  void order(const std::string& command) {
    const size_t from = process_.now();
    process_.tell(command);
    REQUIRE(process_.says(command + "\n", from));
  }

 private:
  static std::vector<std::string> words(const std::vector<std::pair<uint16_t, uint16_t>>& links) {
    std::vector<std::string> words;
    for (const auto& [port, target] : links)
      for (int lane = 0; lane < 2; ++lane)
        words.push_back(std::to_string(port + lane) + ":" + std::to_string(target + lane));
    return words;
  }
  Process process_;
};

/// A cluster over TCP in which one worker connects to all others through a proxy.
struct ProxiedCluster {
  std::string others;  // files
  std::string its;
  std::vector<uint16_t> ports;
  std::unique_ptr<FaultProxy> proxy;
};

inline ProxiedCluster behind_proxy(const TemporaryFolder& folder, ClusterText text, size_t worker) {
  ProxiedCluster cluster;
  const auto nodes = static_cast<size_t>(text.workers) + 1;
  cluster.ports = free_ports(nodes);
  const std::vector<uint16_t> way = free_ports(nodes);
  std::vector<std::pair<uint16_t, uint16_t>> links;
  text.ports = cluster.ports;
  text.ports[worker] = way[worker];
  links.emplace_back(way[worker], cluster.ports[worker]);
  cluster.others = write_cluster(folder, text, "others");
  text.ports = cluster.ports;
  for (size_t i = 0; i < nodes; ++i) {
    if (i == worker) continue;
    text.ports[i] = way[i];
    links.emplace_back(way[i], cluster.ports[i]);
  }
  cluster.its = write_cluster(folder, text, "its");
  cluster.proxy = std::make_unique<FaultProxy>(links);
  return cluster;
}

inline RunningCluster start(const ProxiedCluster& cluster, int workers, int worker) {
  RunningCluster nodes;
  nodes.controller = node(cluster.others, "controller");
  for (int i = 0; i < workers; ++i)
    nodes.workers.push_back(
        node(i == worker ? cluster.its : cluster.others, "n" + std::to_string(i)));
  nodes.await_begin();
  return nodes;
}

/// One fault, as logged by a process. Constructed directly before the fault.
class FaultRow {
 public:
  FaultRow(std::string what, Process& log)
      : what_(std::move(what)), log_(log), from_(log.now()), since_(wall_s()) {}

  /// The fault begins now; the log is read from where it was before, since this test may be late.
  void begins() { since_ = wall_s(); }
  /// Waits until the log has these words.
  void noticed(const std::string& words) { noticed_ = await(words); }
  void given_up(const std::string& words) { given_up_ = await(words); }
  /// The fault has ended; times count from here, and the log is read from here on.
  void healed() {
    from_ = log_.now();
    since_ = wall_s();
    healed_ = true;
  }
  void well(const std::string& words) { well_ = await(words); }
  /// Prints the row.
  void end(const std::string& how) const {
    std::printf("fault | %s | %s | %s | %s%s | %s\n", what_.c_str(), text(noticed_).c_str(),
                text(given_up_).c_str(), text(well_).c_str(),
                healed_ && well_ ? " after the end of it" : "", how.c_str());
    std::fflush(stdout);
  }

 private:
  static double wall_s() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
        .count();
  }
  static std::string text(const std::optional<double>& s) {
    char words[32] = "-";
    if (s) std::snprintf(words, sizeof words, "%.2f s", *s);
    return words;
  }
  /// Time of the line with these words [s], which begins the line.
  double await(const std::string& words) {
    const bool came = log_.says(words, from_);
    INFO(what_ << ": waited for \"" << words << "\" in\n" << log_.text().substr(from_));
    REQUIRE(came);
    const std::string& all = log_.text();
    const size_t at = all.find(words, from_);
    from_ = at;
    const size_t line = all.rfind('\n', at) + 1;  // 0 where there is none
    std::tm moment{};
    double second = 0;
    REQUIRE(std::sscanf(all.c_str() + line, "%d-%d-%dT%d:%d:%lf", &moment.tm_year, &moment.tm_mon,
                        &moment.tm_mday, &moment.tm_hour, &moment.tm_min, &second) == 6);
    moment.tm_year -= 1900;
    moment.tm_mon -= 1;
    return static_cast<double>(::timegm(&moment)) + second - since_;
  }

  const std::string what_;
  Process& log_;
  size_t from_;
  double since_;
  bool healed_ = false;
  std::optional<double> noticed_, given_up_, well_;
};

}  // namespace luxodus::program
