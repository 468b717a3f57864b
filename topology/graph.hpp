// A graph: who has a link to whom. `workers` nodes, numbered from 0, and at most one controller,
// which then is the last vertex. A Graph is whole: simple, within its limits, and connected,
// without the controller's help unless it forwards. It may be rotational: turning its picture by
// one part in `rotation` maps links to links. It knows no routes (routes.hpp) and no places
// (layout.hpp). Immutable values; any thread.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace luxodus {

namespace limits {
/// Vertices of a graph. Tables take 3 bytes a pair of them, 3 MB here, and so many words to send at
/// most; ten times as many take a hundred times that, and minutes to measure.
inline constexpr uint32_t graph_vertices = 1024;
/// Links of one vertex. A port is one byte in the tables; the hypercube of 1024 has 10.
inline constexpr uint32_t vertex_links = 64;
}  // namespace limits

/// A node of the graph, or its controller: from 0.
using Vertex = uint32_t;

/// A link in both directions; a < b.
struct GraphLink {
  Vertex a = 0;
  Vertex b = 0;

  friend auto operator<=>(const GraphLink&, const GraphLink&) = default;
};

/// The link between two vertices, whichever is named first.
constexpr GraphLink link_between(Vertex a, Vertex b) {
  return a < b ? GraphLink{a, b} : GraphLink{b, a};
}

/// Neighbours of every vertex, in ascending order, without any further meaning. The place of a
/// neighbour among those of its vertex is its port; all ports in a row are the arcs, directed
/// links.
class Adjacency {
 public:
  /// Requires: every link between two different vertices < vertices, none twice.
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
  none,      // there is none
  endpoint,  // sends and receives, but passes nothing on
  forwards,  // a vertex as all others
};

/// What a graph is made from.
struct GraphPlan {
  uint32_t workers = 0;
  uint32_t max_links = 0;  // of a worker; the controller may have more or fewer
  ControllerRole controller = ControllerRole::none;
  uint32_t rotation = 1;
  std::vector<GraphLink> links;
};

/// Why a plan is no graph, and the first link that is wrong, where it is a link's fault.
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
  /// Whether messages of others may pass through this vertex.
  bool forwards(Vertex v) const {
    return v != plan_.workers || plan_.controller != ControllerRole::endpoint;
  }

  /// All vertices.
  const Adjacency& all() const { return all_; }
  /// The workers and the links among them.
  Adjacency among_workers() const;

  /// Equal graphs, equal hashes, in every process: of all that is asked above.
  uint64_t hash() const;

 private:
  GraphPlan plan_;
  Adjacency all_;
};

/// The links among the workers of a plan or graph, that is, without the controller.
std::vector<GraphLink> links_among(uint32_t workers, std::span<const GraphLink> links);

/// `links` and all their turned copies: worker v goes to v + workers / rotation, modulo workers,
/// and the controller stays. Sorted, none twice. Requires: rotation divides workers.
std::vector<GraphLink> turned(uint32_t workers, uint32_t rotation,
                              std::span<const GraphLink> links);

}  // namespace luxodus
