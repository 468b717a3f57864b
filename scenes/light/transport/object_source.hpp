// Where a tracer gets parts of the scene that need not be there: a node's cache, behind which lie
// other nodes and a disk. Asking may suspend the fiber that asks; whoever implements this decides.
// Thread rule: as the tracer that asks.
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

  /// The search structure of a geometry cell, good until the caller next asks for anything; null
  /// where it cannot be had, and then what the caller traces is worth nothing: see spoilt().
  /// `next` are cells that the ray enters after it, unless it ends before: they may be asked for
  /// ahead of time. Suspends: until it is resident.
  virtual const CellScene* cell(uint32_t cell, std::span<const Candidate> next) = 0;

  /// A brick of a data set, likewise.
  virtual const Brick* brick(int medium, int brick) = 0;
  /// A tile of a reflectance picture, likewise.
  virtual const ImageTile* tile(uint32_t image, uint32_t tile) = 0;

  /// Whether the fiber that calls was refused anything since it last asked this.
  virtual bool spoilt() = 0;
};

}  // namespace luxodus
