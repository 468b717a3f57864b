#include "tests/precision/batches.hpp"

#include <fmt/core.h>

#include <atomic>
#include <map>
#include <set>
#include <thread>

#include "runtime/core/denormals.hpp"
#include "scenes/light/transport/trace.hpp"

namespace luxodus::precision {

namespace {

/// The scores of one quantity of a bin, over all bands.
void add_bands(const TallyLayout& layout, uint32_t block, uint32_t bin, uint32_t quantity,
               Column& column) {
  const int width = layout.block(block).banded ? layout.bands() : 1;
  for (int band = 0; band < width; ++band)
    column.scores.push_back(layout.score_index(block, bin, band, quantity));
}

void add_aggregates(const TallyLayout& layout, std::vector<Column>& out) {
  std::set<uint32_t> made;
  for (const Aggregate& a : layout.aggregates()) made.insert(a.to_block);
  for (const Aggregate& a : layout.aggregates()) {
    if (made.contains(a.from_block)) continue;  // sums of sums: groups of surfaces
    const TallyBlock& from = layout.block(a.from_block);
    for (uint32_t q = 0; q < from.quantities; ++q) {
      const std::string& kind = layout.block(a.to_block).name;
      Column column{kind, fmt::format("{} {}.{}", kind, a.to_bin, q), {}};
      for (uint32_t i = 0; i < a.bin_count; ++i)
        add_bands(layout, a.from_block, a.first_bin + i, q, column);
      out.push_back(std::move(column));
    }
  }
}

void add_bins(const TallyLayout& layout, uint32_t block, std::vector<Column>& out) {
  if (block == none_index) return;
  const TallyBlock& b = layout.block(block);
  for (uint32_t bin = 0; bin < b.bins; ++bin) {
    for (uint32_t q = 0; q < b.quantities; ++q) {
      Column column{b.name, fmt::format("{} {}.{}", b.name, bin, q), {}};
      add_bands(layout, block, bin, q, column);
      out.push_back(std::move(column));
    }
  }
}

/// Fluence, absorption and scattering in 4 x 4 x 4 parts of the grid.
void add_voxels(const CompiledScene& scene, std::vector<Column>& out) {
  const VoxelGrid& grid = scene.voxels;
  if (!(grid.edge > 0)) return;
  std::map<int, Column> parts;
  const auto part = [](int cell, int cells) { return 4 * cell / cells; };
  for (int z = 0; z < grid.nz; ++z) {
    for (int y = 0; y < grid.ny; ++y) {
      for (int x = 0; x < grid.nx; ++x) {
        const auto voxel = static_cast<uint32_t>((z * grid.ny + y) * grid.nx + x);
        const int n = (part(z, grid.nz) * 4 + part(y, grid.ny)) * 4 + part(x, grid.nx);
        const auto add = [&](int key, const char* kind, uint32_t block, uint32_t quantity) {
          Column& column = parts[key];
          column.kind = kind;
          column.name = fmt::format("{} {}", kind, n);
          add_bands(scene.layout, block, voxel, quantity, column);
        };
        add(n, "voxels, fluence", scene.blocks.voxels, 0);
        add(64 + n, "voxels, absorbed", scene.blocks.voxel_power, 0);
        add(128 + n, "voxels, scattered", scene.blocks.voxel_power, 1);
      }
    }
  }
  for (auto& [key, column] : parts) out.push_back(std::move(column));
}

}  // namespace

std::vector<Column> columns_of(const CompiledScene& scene) {
  std::vector<Column> out;
  add_aggregates(scene.layout, out);
  const TallyBlocks& b = scene.blocks;
  for (const uint32_t block : {b.plane_cells, b.counting, b.volume_length, b.volume_power,
                               b.media_power, b.escape, b.probes, b.views}) {
    add_bins(scene.layout, block, out);
  }
  add_voxels(scene, out);
  return out;
}

std::vector<std::vector<double>> trace_batches(const CompiledScene& scene,
                                               const std::vector<Column>& columns, int64_t batches,
                                               uint64_t seed, int threads) {
  const EmbreeDevice device;
  const SceneIndex index(device, scene);
  std::vector<std::vector<double>> rows(static_cast<size_t>(batches));
  std::atomic<int64_t> next{0};
  const auto work = [&] {
    flush_denormals();
    const auto tracer = make_batch_tracer(scene, GeometryAccess::resident(index), seed);
    BatchScores batch;
    for (int64_t k = next++; k < batches; k = next++) {
      batch.reset(scene.layout);
      tracer->trace(0, static_cast<uint64_t>(k * scene.batch_particles), scene.batch_particles,
                    batch);
      for (uint32_t unit = 0; unit < tracer->look_units(); ++unit) tracer->look(k, unit, batch);
      std::vector<double>& row = rows[static_cast<size_t>(k)];
      for (const Column& column : columns) {
        int64_t sum = 0;
        for (const int64_t at : column.scores) sum += batch.scores[static_cast<size_t>(at)];
        row.push_back(static_cast<double>(sum));
      }
    }
  };
  std::vector<std::thread> workers;
  for (int t = 0; t < threads; ++t) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();
  return rows;
}

}  // namespace luxodus::precision
