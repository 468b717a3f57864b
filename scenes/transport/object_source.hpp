// Where a tracer gets parts of the scene that need not be there: a node's cache, behind which lie
// other nodes and a disk. Asking may suspend the fiber that asks; whoever implements this decides.
// Thread rule: as the tracer that asks.
#pragma once

#include "scenes/intersect/embree_scene.hpp"

namespace luxodus {

class ObjectSource {
 public:
  virtual ~ObjectSource() = default;

  /// The search structure of a geometry cell, good until the caller next asks for anything.
  /// Suspends: until it is resident.
  virtual const CellScene& cell(uint32_t cell) = 0;
};

}  // namespace luxodus
