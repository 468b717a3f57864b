// What each batch of a scene brings, bin by bin, for comparing builds that differ in rounding: sums
// over surfaces, cells of planes, regions of smoke, what eyes and probes receive. Batch k of one
// build traces the same histories from the same random numbers as batch k of another.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus::precision {

/// One bin that is compared: a sum of scores of a batch.
struct Column {
  std::string kind;  // what its line of the table is about: "surfaces", "plane_cells", ...
  std::string name;
  std::vector<int64_t> scores;
};

/// Everything worth comparing; patches only as the surfaces they make up, voxels 4 x 4 x 4 of them.
std::vector<Column> columns_of(const CompiledScene& scene);

/// [batch][column], in units of scores: whole numbers, exact in double.
std::vector<std::vector<double>> trace_batches(const CompiledScene& scene,
                                               const std::vector<Column>& columns, int64_t batches,
                                               uint64_t seed, int threads);

}  // namespace luxodus::precision
