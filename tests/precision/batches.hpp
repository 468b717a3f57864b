// Scores of each batch of a scene, bin by bin, to compare builds that differ in rounding: sums over
// surfaces, cells of planes, regions of smoke, results of eyes and probes. Batch k of one build
// traces the same histories from the same random numbers as batch k of another. Test helper; one
// caller at a time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus::precision {

/// A compared bin: a sum of scores of a batch.
struct Column {
  std::string kind;  // the line of the table it belongs to: "surfaces", "plane_cells", ...
  std::string name;
  std::vector<int64_t> scores;
};

/// All bins worth comparing; patches only as sums over surfaces, voxels as 4 x 4 x 4 parts of the
/// grid.
std::vector<Column> columns_of(const CompiledScene& scene);

/// [batch][column], in units of scores: whole numbers, exact in double.
std::vector<std::vector<double>> trace_batches(const CompiledScene& scene,
                                               const std::vector<Column>& columns, int64_t batches,
                                               uint64_t seed, int threads);

}  // namespace luxodus::precision
