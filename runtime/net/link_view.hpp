// What this node knows of all links of the graph: for each a version, even while it is up and odd
// while it is down, raised by the ends that notice. The newest version wins, so views that have
// received the same changes are equal, in whatever order they came. The epoch is the sum of
// versions, for people; different views may have the same epoch, so they are compared by their
// hash. It computes no routes: these are made from down(). Thread rule: one node's thread.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "proto/messages.hpp"
#include "runtime/net/net_config.hpp"

namespace luxodus {

class LinkView {
 public:
  /// All links are up in version 0.
  explicit LinkView(std::vector<Edge> edges);

  /// Reports the state of an adjacent link. Returns true if it is new, and raises the version.
  bool set(Edge edge, bool up);
  /// Merges a report of another node. Returns true if it is new; links outside the graph are
  /// ignored.
  bool merge(const LinkChange& change);

  /// Requires: a link of the graph.
  uint32_t version(Edge edge) const;
  uint64_t epoch() const { return epoch_; }
  /// Hash of all versions; 0 at the start.
  uint64_t hash() const { return hash_; }
  std::vector<Edge> down() const;
  /// All changes since the start: they bring another view up to this one.
  LinkChanges changes() const;

 private:
  struct Known {
    Edge edge;
    uint32_t version = 0;
  };
  const Known* find(Edge edge) const;
  void raise(Known& known, uint32_t version);
  Known* find(Edge edge) { return const_cast<Known*>(std::as_const(*this).find(edge)); }

  std::vector<Known> links_;  // sorted by edge
  uint64_t epoch_ = 0;
  uint64_t hash_ = 0;
};

}  // namespace luxodus
