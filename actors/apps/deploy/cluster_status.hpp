// The status of a run's nodes as a table, one line each, from the metrics pages of their processes.
// A node's state combines what its process reports and what its neighbours report about it; if a
// process does not answer, its nodes are shown as down, with the reason.
// Pure functions of pages except ask(); any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/config/cluster_config.hpp"
#include "runtime/http/http_get.hpp"

namespace luxodus {

/// A process, its address, and the nodes it should have; without nodes: those it reports.
struct AskedProcess {
  std::string name;
  HttpUrl url;
  std::vector<std::string> nodes;
};

/// The processes of a cluster. Errors: it serves no metrics.
Result<std::vector<AskedProcess>> processes_of(const ClusterConfig& cluster);

/// The page of each, or why there is none; several are asked in parallel.
std::vector<Result<std::string>> ask(const std::vector<AskedProcess>& processes,
                                     Nanoseconds patience);

enum class NodeState : uint8_t {
  up,
  suspect,   // a neighbour has not heard from it for a while, or has given it up
  starting,  // its process answers, but does not know it yet
  down       // its process does not answer
};
const char* name_of(NodeState state);

/// Numbers are absent if the node does not report them.
struct NodeStatus {
  std::string node;
  std::string process;
  NodeState state = NodeState::down;
  std::string role;
  std::string led_by;                      // the node whose coordinator leads it
  std::optional<double> fibers;            // alive
  std::optional<double> waiting;           // of those, waiting
  std::optional<double> letters;           // waiting in the mailboxes of its actors
  std::optional<double> letters_rejected;  // since its start, by full mailboxes
  std::optional<double> restarts;          // of its actors, since its start
  std::optional<double> hit_rate;          // of the cache of geometry cells
  std::optional<double> credit_bytes;      // over all links
  std::optional<double> batches;           // merged, or counted by the controller
  std::optional<double> particles_per_s;   // over about the last second
  std::optional<double> resident_bytes;    // of cells
  std::optional<double> process_bytes;     // of the whole process
  std::string problem;                     // why it is down
};

/// A row for each node, in the order of processes. Requires: as many pages as processes.
std::vector<NodeStatus> status_of(const std::vector<AskedProcess>& processes,
                                  const std::vector<Result<std::string>>& pages);

/// A line per node under a line of headings.
std::string status_table(const std::vector<NodeStatus>& rows);

}  // namespace luxodus
