// One node's numbers: what its parts count, registered before it starts, and published four times a
// second by a timer of the node. Numbers that nobody counts are made just before: samples of links,
// and rates.
// Thread rule: the node's thread.
#pragma once

#include <functional>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "actors/cast/node/node_shell.hpp"
#include "actors/cast/node/observation.hpp"

namespace luxodus {

class NodeMetrics {
 public:
  /// Registers what every node has. `names` are those of all nodes, by number; `role` is a word.
  /// Requires: the shell outlives this; all its actors have been added.
  NodeMetrics(const std::vector<std::string>& names, NodeId self, const std::string& role,
              NodeShell& shell);

  /// Where the node's other parts register theirs. Requires: not started.
  Metrics& registry() { return *registered_; }
  /// A gauge of how fast a counter grows [1/s], over the last second or two.
  void add_rate(const MetricInfo& info, const uint64_t& counter);
  /// Is called before each publication.
  void add_sample(std::function<void()> sample) { samples_.push_back(std::move(sample)); }

  /// Begins to publish. Requires: all numbers are registered; `seen` outlives the node.
  void start(Observation& seen);

 private:
  struct Rate {
    const uint64_t& counter;
    uint64_t at_mark = 0;
    uint64_t per_second = 0;
  };
  void publish();
  void renew_rates(Nanoseconds now);

  Scheduler& scheduler_;
  std::unique_ptr<Metrics> registered_;
  Metrics* shown_ = nullptr;
  std::vector<std::function<void()>> samples_;
  std::list<Rate> rates_;  // their places are registered
  Nanoseconds mark_;
  uint64_t info_ = 1;
};

}  // namespace luxodus
