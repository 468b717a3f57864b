// Source of scene parts that may not be in memory: a node's cache, backed by other nodes and a
// disk. A request may suspend the calling fiber; the implementation decides. Thread rule: that of
// the calling tracer.
#pragma once

#include <cstdint>
#include <span>

namespace luxodus {

class CellScene;
struct Candidate;
struct Brick;
struct ImageTile;

class ObjectSource {
 public:
  virtual ~ObjectSource() = default;

  /// The search structure of a geometry cell, valid until the caller's next request; null if it is
  /// not available, and then the caller's results are invalid: see spoilt(). `next` are the cells
  /// that the ray enters afterwards, unless it ends before: they may be prefetched. Suspends: until
  /// it is resident.
  virtual const CellScene* cell(uint32_t cell, std::span<const Candidate> next) = 0;

  /// A brick of a data set, likewise.
  virtual const Brick* brick(int medium, int brick) = 0;
  /// A tile of a reflectance picture, likewise.
  virtual const ImageTile* tile(uint32_t image, uint32_t tile) = 0;

  /// Whether a request of the calling fiber has failed since its last call of this.
  virtual bool spoilt() = 0;
};

}  // namespace luxodus
