// Metrics of one node: its parts register their counters before it starts, and a timer of the node
// publishes them four times a second. Derived numbers are computed just before: samples of links,
// and rates. Thread rule: the node's thread.
#pragma once

#include <functional>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "actors/cast/node/observation.hpp"
#include "runtime/node/node_shell.hpp"

namespace luxodus {

class NodeMetrics {
 public:
  /// Registers what every node has. `names` are those of all nodes, by number; `role` is one word.
  /// Requires: the shell outlives this; all its actors have been added.
  NodeMetrics(const std::vector<std::string>& names, NodeId self, const std::string& role,
              NodeShell& shell);

  /// Registry for the node's other parts. Requires: not started.
  Metrics& registry() { return *registered_; }
  /// A gauge of a counter's growth [1/s], over the last one to two seconds.
  void add_rate(const MetricInfo& info, const uint64_t& counter);
  /// `sample` is called before each publication.
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
  std::list<Rate> rates_;  // a list, since the registry refers to its elements
  Nanoseconds mark_;
  uint64_t info_ = 1;
};

}  // namespace luxodus
