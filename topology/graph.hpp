// A graph of links. It has `workers` nodes, numbered from 0, and at most one controller, which is
// then the last vertex. A Graph is valid: simple, within its limits, and connected (without the
// controller unless it forwards). It may be rotational: turning it by one part in `rotation` maps
// links to links. It has no routes (routes.hpp) and no positions (layout.hpp). Immutable values;
// any thread.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace luxodus {

namespace limits {
/// Most vertices. Tables take 3 bytes per pair of them, 3 MB at this limit; ten times as many would
/// take a hundred times that, and minutes to measure.
inline constexpr uint32_t graph_vertices = 1024;
/// Most links of one vertex. A port is one byte in the tables; the hypercube of 1024 has 10.
inline constexpr uint32_t vertex_links = 64;
}  // namespace limits

/// A node of the graph, or its controller, numbered from 0.
using Vertex = uint32_t;

/// A link in both directions; a < b.
struct GraphLink {
  Vertex a = 0;
  Vertex b = 0;

  friend auto operator<=>(const GraphLink&, const GraphLink&) = default;
};

/// The link between two vertices, in either order.
constexpr GraphLink link_between(Vertex a, Vertex b) {
  return a < b ? GraphLink{a, b} : GraphLink{b, a};
}

/// Neighbours of every vertex, in ascending order. The index of a neighbour among those of its
/// vertex is its port; all ports in sequence are the arcs (directed links).
class Adjacency {
 public:
  /// Requires: every link joins two different vertices < vertices, and none is a duplicate.
  Adjacency(uint32_t vertices, std::span<const GraphLink> links);

  uint32_t vertices() const { return static_cast<uint32_t>(first_.size() - 1); }
  uint32_t arcs() const { return first_.back(); }
  uint32_t degree(Vertex v) const { return first_[v + 1] - first_[v]; }
  std::span<const Vertex> of(Vertex v) const { return {to_.data() + first_[v], degree(v)}; }
  uint32_t arc(Vertex v, uint32_t port) const { return first_[v] + port; }
  /// The vertex at the end of an arc.
  Vertex target(uint32_t arc) const { return to_[arc]; }

 private:
  std::vector<uint32_t> first_;
  std::vector<Vertex> to_;
};

enum class ControllerRole {
  none,      // no controller
  endpoint,  // sends and receives, but forwards nothing
  forwards,  // an ordinary vertex
};

/// Input from which a graph is made.
struct GraphPlan {
  uint32_t workers = 0;
  uint32_t max_links = 0;  // per worker; the controller may have more or fewer
  ControllerRole controller = ControllerRole::none;
  uint32_t rotation = 1;
  std::vector<GraphLink> links;
};

/// Why a plan is invalid, and the first wrong link if a link is the cause.
struct GraphFault {
  std::string what;
  std::optional<size_t> link;
};

std::optional<GraphFault> fault_of(const GraphPlan& plan);

class Graph {
 public:
  /// Requires: fault_of(plan) is empty; throws std::invalid_argument otherwise.
  explicit Graph(GraphPlan plan);

  uint32_t workers() const { return plan_.workers; }
  uint32_t vertices() const { return workers() + (has_controller() ? 1 : 0); }
  uint32_t max_links() const { return plan_.max_links; }
  uint32_t rotation() const { return plan_.rotation; }
  /// Sorted.
  const std::vector<GraphLink>& links() const { return plan_.links; }

  ControllerRole controller_role() const { return plan_.controller; }
  bool has_controller() const { return plan_.controller != ControllerRole::none; }
  /// Requires: has_controller().
  Vertex controller() const { return plan_.workers; }
  uint32_t controller_links() const { return has_controller() ? all_.degree(controller()) : 0; }
  /// Whether messages between other vertices may pass through this one.
  bool forwards(Vertex v) const {
    return v != plan_.workers || plan_.controller != ControllerRole::endpoint;
  }

  /// All vertices.
  const Adjacency& all() const { return all_; }
  /// The workers and the links among them.
  Adjacency among_workers() const;

  /// Equal graphs have equal hashes in every process.
  uint64_t hash() const;

 private:
  GraphPlan plan_;
  Adjacency all_;
};

/// The links among the workers, without the controller's.
std::vector<GraphLink> links_among(uint32_t workers, std::span<const GraphLink> links);

/// `links` and all their rotations: worker v maps to v + workers / rotation, modulo workers; the
/// controller is fixed. Sorted, without duplicates. Requires: rotation divides workers.
std::vector<GraphLink> turned(uint32_t workers, uint32_t rotation,
                              std::span<const GraphLink> links);

}  // namespace luxodus
