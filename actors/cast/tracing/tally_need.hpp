// Memory of a worker's tally: scores of batches in work, totals of which one half is filled while
// the other is emptied, and the flush packed from them. At most all bins of a scene; with a smaller
// budget, the pages that batches touch are counted while they run, and the tally flushes when it is
// full. Pure functions; any thread.
#pragma once

#include <algorithm>
#include <cstdint>

#include "actors/cast/tally/flush_codec.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

/// Bytes if every bin were touched.
struct TallyNeed {
  uint64_t scores = 0;
  uint64_t totals = 0;
  uint64_t flush = 0;
  uint64_t all() const { return scores + totals + flush; }
};

inline TallyNeed tally_need(const CompiledScene& scene, uint64_t open_batches) {
  const uint64_t bins = static_cast<uint64_t>(scene.layout.totals()) * scene.groups.size();
  return {open_batches * static_cast<uint64_t>(scene.layout.scores()) * sizeof(int64_t),
          2 * bins * sizeof(Total), bins * flush_bytes_of_bin};
}

/// The smallest budget with which a run begins: for packing flushes, the marks of pages, and a few
/// pages of each kind. Whether a batch fits beside that shows when one is traced.
inline uint64_t min_tally_bytes(const CompiledScene& scene) {
  constexpr uint64_t packing = 2 << 20;
  const TallyNeed need = tally_need(scene, 1);
  return packing + (need.scores + need.totals) / ZeroedMemory::page_bytes +
         64 * ZeroedMemory::page_bytes;
}

/// Share of a budget that does not hold all bins: merged batches may take this much before they are
/// flushed; as much again is being emptied meanwhile, and the rest is for scores and the flush.
inline uint64_t totals_share(uint64_t tally_bytes) {
  return tally_bytes / 4;
}

}  // namespace luxodus
