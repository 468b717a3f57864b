// How the nodes of a run are, for a person: one line each, made of the pages of numbers that their
// processes serve. A node is what its process says of it and what its neighbours think of it; where
// a process does not answer, its nodes are said to be down, with the reason.
// Pure functions of pages but for ask(); any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/config/cluster_config.hpp"
#include "runtime/http/http_get.hpp"

namespace luxodus {

/// A process, where it is asked, and which nodes it should have; no nodes: those it tells of.
struct AskedProcess {
  std::string name;
  HttpUrl url;
  std::vector<std::string> nodes;
};

/// The processes of a cluster. Errors: it serves no metrics.
Result<std::vector<AskedProcess>> processes_of(const ClusterConfig& cluster);

/// The page of each, or why there is none; several are asked at once.
std::vector<Result<std::string>> ask(const std::vector<AskedProcess>& processes,
                                     Nanoseconds patience);

enum class NodeState : uint8_t {
  up,
  suspect,   // a neighbour that hears nothing of it for a while, or has given it up
  starting,  // its process answers, and does not know it yet
  down       // its process does not answer
};
const char* name_of(NodeState state);

/// Numbers are absent where the node does not tell them.
struct NodeStatus {
  std::string node;
  std::string process;
  NodeState state = NodeState::down;
  std::string role;
  std::string led_by;                      // whose coordinator leads it
  std::optional<double> fibers;            // that live
  std::optional<double> waiting;           // of those
  std::optional<double> letters;           // that wait in the mailboxes of its actors
  std::optional<double> letters_rejected;  // since it began, by full mailboxes
  std::optional<double> restarts;          // of its actors, since it began
  std::optional<double> hit_rate;          // of the cache of cells
  std::optional<double> credit_bytes;      // over all links
  std::optional<double> batches;           // merged, or counted by the controller
  std::optional<double> particles_per_s;   // of the last second or so
  std::optional<double> resident_bytes;    // cells
  std::optional<double> process_bytes;     // of the whole process
  std::string problem;                     // why it is down
};

/// A row for each node, in the order of processes. Requires: as many pages as processes.
std::vector<NodeStatus> status_of(const std::vector<AskedProcess>& processes,
                                  const std::vector<Result<std::string>>& pages);

/// A line per node under a line of headings.
std::string status_table(const std::vector<NodeStatus>& rows);

}  // namespace luxodus
