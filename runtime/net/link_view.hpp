// What this node knows of all links of the graph: for each a version, even while it is up and odd
// while it is down, raised by the ends that notice. The newest version wins, so views that have
// heard the same are the same, in whatever order they heard it. The epoch is the sum of versions,
// for people; two views may have the same and differ, so that they are told apart by their hash.
// Nothing here routes: routes are made from down(). Thread rule: one node's thread.
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

  /// What an end of a link sees of it. True: that is news, and the version was raised.
  bool set(Edge edge, bool up);
  /// What another node says. True: that is news. A link that the graph has not is no news.
  bool merge(const LinkChange& change);

  /// Requires: a link of the graph.
  uint32_t version(Edge edge) const;
  uint64_t epoch() const { return epoch_; }
  /// Of all versions; 0 at the start.
  uint64_t hash() const { return hash_; }
  std::vector<Edge> down() const;
  /// All that is not as it was at the start: what brings another view up to this one.
  LinkChanges changes() const;

 private:
  struct Known {
    Edge edge;
    uint32_t version = 0;
  };
  const Known* find(Edge edge) const;
  void raise(Known& known, uint32_t version);
  Known* find(Edge edge) { return const_cast<Known*>(std::as_const(*this).find(edge)); }

  std::vector<Known> links_;  // by edge
  uint64_t epoch_ = 0;
  uint64_t hash_ = 0;
};

}  // namespace luxodus
