// A rotational graph during the search: `base` vertices and one copy of their links, rotated
// `turns` times. Each base vertex has `links` darts (ends of links). A dart may be joined to
// another with a turn t: then (b, i) is linked to (c, i + t) for every i. Or it is joined to the
// controller. Or to none: then it links (b, i) with (b, i + turns / 2) if turns are even, and stays
// free if they are odd. (These are the voltage graphs of Gross and Tucker, "Topological Graph
// Theory", with semi-edges.) Links that coincide are wasted, not forbidden: the search avoids them
// by itself. Plain values; one thread per object.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "runtime/core/random.hpp"
#include "topology/graph.hpp"

namespace luxodus {

/// Uniform in 0 .. end - 1. Requires: end > 0.
inline uint32_t random_below(Random& random, uint32_t end) {
  return static_cast<uint32_t>(uint64_t{random.bits()} * end >> 32);
}

struct LiftShape {
  uint32_t base = 0;
  uint32_t turns = 1;
  uint32_t links = 0;
  /// Requires: a multiple of turns, at most links * base * turns.
  uint32_t controller_links = 0;

  uint32_t workers() const { return base * turns; }
};

class Lift {
 public:
  using Dart = uint32_t;
  static constexpr Dart to_controller = 0xFFFF'FFFF;

  /// The other end of a dart.
  struct Joint {
    Dart mate = 0;
    uint32_t base = 0;  // the mate's base vertex
    uint32_t turn = 0;
  };

  /// Joined at random, as a pure function of the draws.
  Lift(const LiftShape& shape, Random& random);

  const LiftShape& shape() const { return shape_; }
  /// Dart d belongs to the base vertex d / shape().links.
  const std::vector<Joint>& joints() const { return joints_; }

  /// Changes a few joints at random, and remembers the previous ones.
  void change(Random& random);
  /// Undoes the last change; does nothing if it was undone already.
  void take_back();

  /// All links, each once, in a Graph's numbering: (b, i) is i * base + b.
  std::vector<GraphLink> links() const;

 private:
  struct Former {
    Dart dart;
    Joint joint;
  };

  Dart darts() const { return static_cast<Dart>(joints_.size()); }
  void set(Dart dart, Dart mate, uint32_t turn);
  void join(Dart a, Dart b, uint32_t turn);
  void leave_alone(Dart dart);
  void exchange(Dart a, Dart b, Random& random);

  LiftShape shape_;
  std::vector<Joint> joints_;
  std::vector<Former> former_;
};

/// Counts hops in lifts of one shape, some million times a second. One thread at a time; allocates
/// only on construction.
class HopCounter {
 public:
  virtual ~HopCounter() = default;
  /// Hops from the base vertices to all workers without the controller, plus twice those from the
  /// controller to the base vertices: the hops of all ordered pairs, divided by turns. A
  /// disconnected pair counts as more hops than any path has. If the result exceeds `enough`, only
  /// that fact is reliable, not its value.
  virtual uint64_t hops(const Lift& lift, uint64_t enough) = 0;
};

std::unique_ptr<HopCounter> make_hop_counter(const LiftShape& shape);

}  // namespace luxodus
