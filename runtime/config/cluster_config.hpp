// A cluster as its file says it (cluster_file.hpp reads one): machines, nodes, processes, who is
// linked to whom, what each may hold; and what follows from that, such as where a node listens.
// It is whole: names are unique, ports do not clash, there is one controller. It opens nothing:
// that files, keys and addresses exist is found where they are used. What graph the topology names
// is for others to make. Plain values; any thread.
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
/// Things that happen, by a cluster's file.
inline constexpr size_t cluster_faults = 4096;
/// Machines of a cluster; every one costs a connection of whoever deploys to it.
inline constexpr size_t cluster_hosts = 256;
/// Nodes of a cluster, the controller included: as many as a graph has vertices.
inline constexpr size_t cluster_nodes = 1024;
/// Characters of a name. A local socket's name holds that of the run and that of the node, and the
/// system allows 107 in all.
inline constexpr size_t cluster_name_chars = 32;
}  // namespace limits

struct ClusterHost {
  std::string name;
  std::string address;  // that others connect to
  std::string listen;   // address of its own to listen on, or "*"
  uint16_t first_port = 0;
};

/// What a node may hold.
struct NodeBudget {
  uint64_t object_bytes = 0;
  uint64_t tally_bytes = 0;
  uint32_t fibers = 0;
  uint32_t prefetch = 0;
  uint32_t stack_bytes = 0;  // of one fiber
  uint32_t max_maps = 0;     // 0: its part of max_process_maps()
};

enum class NodeRole : uint8_t { worker, controller };

/// Its number is its place among ClusterConfig::nodes.
struct ClusterNode {
  std::string name;
  NodeRole role = NodeRole::worker;
  bool traces = true;  // a controller: by a worker in its process; see tracer_of()
  bool stores = true;  // its host has the scene's objects, so it holds its part of them for all
  size_t host = 0;     // among ClusterConfig::hosts
  size_t process = 0;  // among ClusterConfig::processes
  uint16_t port = 0;   // TCP, of the control lane; bulk has the next
  NodeBudget budget;
};

/// Nodes that share memory, started by one command.
struct ClusterProcess {
  std::string name;
  size_t host = 0;
  std::vector<NodeId> nodes;
  uint16_t metrics_port = 0;  // 0: none
};

/// Who is linked to whom: named, not yet made.
struct TopologyChoice {
  enum class Kind : uint8_t { amp, file, links };
  enum class Controller : uint8_t {
    endpoint,  // the graph's controller, which passes nothing on
    forwards,  // the graph's controller, which does
    node       // a vertex as all others: the graph has no controller
  };

  Kind kind = Kind::amp;
  std::filesystem::path file;  // of kind file, which says itself what follows
  std::vector<Edge> edges;     // of kind links
  uint32_t max_links = 0;      // of a worker
  Controller controller = Controller::endpoint;
  uint32_t max_controller_links = 0;  // not above the number of workers; 0 for `node`
};

struct RunChoice {
  std::string name;
  uint64_t id = 0;
  Level level = Level::bit;
  std::filesystem::path scene;
  std::string scenario;        // "": the scene's first
  std::optional<double> at_s;  // of the scene's clock; none: the scene's own time
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
  uint32_t fan_out = 0;  // 0: as usual for so many workers
};

struct Timeouts {
  Nanoseconds start = 0;  // until all nodes are there
  Nanoseconds lost = 0;   // without a way to a node, until it is given up
  Nanoseconds fetch_floor = 0;
  uint32_t fetch_attempts = 0;  // at one holder
  Nanoseconds shutdown_phase = 0;
  Nanoseconds stall = 0;
};

/// Where the totals lie.
struct TallyChoice {
  std::vector<NodeId> shards;  // workers that hold a share each, beside the controller
};

struct KeysChoice {
  std::filesystem::path folder;  // empty: no keys
  bool insecure = false;
};

struct ObserveChoice {
  std::string metrics_address;
  std::string allow_host;    // under which the page may be asked for; "": none
  uint64_t trace_every = 0;  // 0: none
  std::string log_level;     // debug, info, warn, error
};

/// Where the run is shown and its results are written.
struct DisplayChoice {
  NodeId node;
  bool pictures = false;  // of every camera, when the run has ended
  double preview_s = 0;   // between previews while it goes on; 0: none
};

/// Whether nodes trace for a live view, which the controller's process serves.
struct ViewChoice {
  bool live = false;
  std::string address;
  uint16_t port = 0;                  // 0: any that is free
  std::string allow_host;             // under which the page may be asked for; "": none
  std::filesystem::path save_folder;  // of variants, on the controller's host
};

/// Whether nodes trace for an assessment, which the controller's process makes.
struct AssessChoice {
  bool asked = false;
  std::vector<std::string> rules, deviations;  // none: those of the scene
  int rounds = 4;
  std::vector<double> smoke_scale;  // factors of a sweep
};

/// Whether nodes trace pictures of a finished run, which the controller's process writes.
struct RenderChoice {
  bool asked = false;
  std::string view;                     // of all cameras where it is empty
  std::optional<int64_t> paths;         // a pixel, at most
  std::optional<double> time_s, error;  // at which they end
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
  /// What the nodes' network has in common; see net_config().
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
  FaultPlan faults;  // on purpose; none in most files

  const ClusterNode& node(NodeId id) const { return nodes[id.value]; }
  const ClusterHost& host_of(NodeId id) const { return hosts[node(id).host]; }
  NodeId controller() const { return NodeId{static_cast<uint16_t>(nodes.size() - 1)}; }
  size_t workers() const { return nodes.size() - 1; }
  /// Whether the nodes trace one run, which a display shows; else what the controller's process
  /// asks for, piece by piece.
  bool is_run() const { return !view.live && !assess.asked && !render.asked; }
};

/// The worker by which a controller of this name traces, where it does.
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

/// A node's network but for what a start adds: incarnation, edges, what is hashed and built.
NetConfig net_config(const ClusterConfig& cluster, NodeId self);

/// What carries a link.
enum class Carrier : uint8_t {
  memory,  // within a process
  local,   // a socket of the host, by name (no file: it ends with its owner)
  tcp
};
Carrier carrier_between(const ClusterConfig& cluster, NodeId a, NodeId b);

/// Whether any two nodes might be linked by TCP, and whether that may leave their host.
bool uses_tcp(const ClusterConfig& cluster);
bool leaves_host(const ClusterConfig& cluster);

/// Where a node listens, and whom it connects to: of two neighbours the larger number connects.
struct NodeLinks {
  std::vector<Endpoints> listen;  // one for each carrier that is needed
  std::vector<std::pair<NodeId, Endpoints>> connect;
};
/// Requires: edges between nodes of the cluster.
NodeLinks links_of(const ClusterConfig& cluster, NodeId self, std::span<const Edge> edges);

/// The files of a node's keys, as `luxodus keygen` writes them.
std::filesystem::path key_path(const std::filesystem::path& folder, std::string_view node);
std::filesystem::path public_key_path(const std::filesystem::path& folder, std::string_view node);

}  // namespace luxodus
