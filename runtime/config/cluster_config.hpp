// A cluster as described by its file (cluster_file.hpp reads it): machines, nodes, processes,
// links, limits; and what follows from them, such as where a node listens. It is consistent: names
// are unique, ports do not clash, there is one controller. It opens nothing: whether files, keys
// and addresses exist is checked where they are used. It does not build the graph that the topology
// names. Plain values; any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/core/clock.hpp"
#include "runtime/core/faults.hpp"
#include "runtime/core/result.hpp"
#include "runtime/net/net_config.hpp"
#include "runtime/net/zmq_transport.hpp"

namespace luxodus {

namespace limits {
/// Most fault events in a cluster file.
inline constexpr size_t cluster_faults = 4096;
/// Most machines of a cluster; each costs a connection during deployment.
inline constexpr size_t cluster_hosts = 256;
/// Most nodes of a cluster, including the controller: the most vertices of a graph.
inline constexpr size_t cluster_nodes = 1024;
/// Longest name. A local socket's name contains the run's name and the node's, and the system
/// allows 107 characters in total.
inline constexpr size_t cluster_name_chars = 32;
}  // namespace limits

struct ClusterHost {
  std::string name;
  std::string address;  // to which others connect
  std::string listen;   // own address to listen on, or "*"
  uint16_t first_port = 0;
};

/// Limits of a node.
struct NodeBudget {
  uint64_t object_bytes = 0;
  uint64_t tally_bytes = 0;
  uint32_t fibers = 0;
  uint32_t prefetch = 0;
  uint32_t stack_bytes = 0;  // per fiber
  uint32_t max_maps = 0;     // 0: its share of max_process_maps()
};

enum class NodeRole : uint8_t { worker, controller };

/// A node; its number is its index in ClusterConfig::nodes.
struct ClusterNode {
  std::string name;
  NodeRole role = NodeRole::worker;
  bool traces = true;  // a controller traces by a worker in its process; see tracer_of()
  bool stores = true;  // its host has the scene's objects, so it holds its share of them for all
  size_t host = 0;     // index in ClusterConfig::hosts
  size_t process = 0;  // index in ClusterConfig::processes
  uint16_t port = 0;   // TCP, control lane; the bulk lane uses the next
  NodeBudget budget;
};

/// Nodes that share memory and are started by one command.
struct ClusterProcess {
  std::string name;
  size_t host = 0;
  std::vector<NodeId> nodes;
  uint16_t metrics_port = 0;  // 0: none
};

/// The choice of links; the graph itself is made elsewhere.
struct TopologyChoice {
  enum class Kind : uint8_t { amp, file, links };
  enum class Controller : uint8_t {
    endpoint,  // the graph's controller, which forwards nothing
    forwards,  // the graph's controller, which forwards
    node       // an ordinary vertex: the graph has no controller
  };

  Kind kind = Kind::amp;
  std::filesystem::path file;  // for kind `file`; that file defines the rest
  std::vector<Edge> edges;     // for kind `links`
  uint32_t max_links = 0;      // per worker
  Controller controller = Controller::endpoint;
  uint32_t max_controller_links = 0;  // at most the number of workers; 0 for `node`
};

struct RunChoice {
  std::string name;
  uint64_t id = 0;
  Level level = Level::bit;
  std::filesystem::path scene;
  std::string scenario;        // "": the scene's first
  std::optional<double> at_s;  // on the scene's clock; none: the scene's own time
  std::filesystem::path out;
  std::filesystem::path profile;  // empty: none
  bool sharing = true;            // nodes of one process share what they build
  std::optional<uint64_t> particles;
  std::optional<double> relative_error;
  std::optional<double> time_s;
};

struct LeaseChoice {
  uint32_t batches = 0;
  Nanoseconds duration = 0;
  uint32_t fan_out = 0;  // 0: the default for this number of workers
};

struct Timeouts {
  Nanoseconds start = 0;  // until all nodes are present
  Nanoseconds lost = 0;   // a node without a route for this long is given up
  Nanoseconds fetch_floor = 0;
  uint32_t fetch_attempts = 0;  // per holder
  Nanoseconds shutdown_phase = 0;
  Nanoseconds stall = 0;
};

/// Which nodes hold the totals.
struct TallyChoice {
  std::vector<NodeId> shards;  // workers that hold a share each, beside the controller
};

struct KeysChoice {
  std::filesystem::path folder;  // empty: no keys
  bool insecure = false;
};

struct ObserveChoice {
  std::string metrics_address;
  std::string allow_host;    // name under which the page may be requested; "": none
  uint64_t trace_every = 0;  // 0: none
  std::string log_level;     // debug, info, warn, error
};

/// Which node displays the run and writes its results.
struct DisplayChoice {
  NodeId node;
  bool pictures = false;  // of every camera, at the end
  double preview_s = 0;   // interval of previews; 0: none
};

/// Whether nodes trace for a live view, which the controller's process serves.
struct ViewChoice {
  bool live = false;
  std::string address;
  uint16_t port = 0;                  // 0: any that is free
  std::string allow_host;             // name under which the page may be requested; "": none
  std::filesystem::path save_folder;  // of variants, on the controller's host
};

/// Whether nodes trace for an assessment, which the controller's process makes.
struct AssessChoice {
  bool asked = false;
  std::vector<std::string> rules, deviations;  // empty: those of the scene
  int rounds = 4;
  std::vector<double> smoke_scale;  // factors of a sweep
};

/// Whether nodes trace pictures of a finished run, which the controller's process writes.
struct RenderChoice {
  bool asked = false;
  std::string view;                     // name of a camera; empty: all cameras
  std::optional<int64_t> paths;         // per pixel, at most
  std::optional<double> time_s, error;  // limits at which they end
  bool full_paths = false, raw = false;
};

struct ClusterConfig {
  std::filesystem::path file;
  RunChoice run;
  std::vector<ClusterHost> hosts;
  std::vector<ClusterNode> nodes;  // by number; the controller is the last
  std::vector<ClusterProcess> processes;
  TopologyChoice topology;
  bool tcp_within_host = false;
  /// Network settings common to all nodes; see net_config().
  NetConfig links;
  LeaseChoice lease;
  Timeouts timeouts;
  TallyChoice tally;
  DisplayChoice display;
  KeysChoice keys;
  ObserveChoice observe;
  ViewChoice view;
  AssessChoice assess;
  RenderChoice render;
  FaultPlan faults;  // injected faults; none in most files

  const ClusterNode& node(NodeId id) const { return nodes[id.value]; }
  const ClusterHost& host_of(NodeId id) const { return hosts[node(id).host]; }
  NodeId controller() const { return NodeId{static_cast<uint16_t>(nodes.size() - 1)}; }
  size_t workers() const { return nodes.size() - 1; }
  /// Whether the nodes trace one run, which a display shows; otherwise they trace pieces of work on
  /// request of the controller's process.
  bool is_run() const { return !view.live && !assess.asked && !render.asked; }
};

/// Name of the worker by which a controller of this name traces, if it does.
inline std::string tracer_of(const std::string& controller) {
  return controller + "-tracer";
}

/// The node of this name.
std::optional<NodeId> find_node(const ClusterConfig& cluster, std::string_view name);

/// Whether this can be the name of a run, host, node or process. Names become parts of files',
/// units' and sockets' names.
Result<void> check_name(std::string_view name);
/// Whether this is an IPv4 address or a host's name.
Result<void> check_address(const std::string& address);
bool is_ipv4(const std::string& address);

/// A node's network configuration without what the start adds: incarnation, edges, hash of the
/// scene, build.
NetConfig net_config(const ClusterConfig& cluster, NodeId self);

/// The medium of a link.
enum class Carrier : uint8_t {
  memory,  // within a process
  local,   // a socket of the host, by name (no file: it ends with its owner)
  tcp
};
Carrier carrier_between(const ClusterConfig& cluster, NodeId a, NodeId b);

/// Whether any two nodes might be linked by TCP, and whether such a link may leave its host.
bool uses_tcp(const ClusterConfig& cluster);
bool leaves_host(const ClusterConfig& cluster);

/// Where a node listens and to whom it connects: of two neighbours the larger number connects.
struct NodeLinks {
  std::vector<Endpoints> listen;  // one for each medium needed
  std::vector<std::pair<NodeId, Endpoints>> connect;
};
/// Requires: edges between nodes of the cluster.
NodeLinks links_of(const ClusterConfig& cluster, NodeId self, std::span<const Edge> edges);

/// Paths of a node's key files, as `luxodus keygen` writes them.
std::filesystem::path key_path(const std::filesystem::path& folder, std::string_view node);
std::filesystem::path public_key_path(const std::filesystem::path& folder, std::string_view node);

}  // namespace luxodus
