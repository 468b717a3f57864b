#include <fmt/core.h>

#include <atomic>

#include "actors/results/run/local_run.hpp"
#include "tests/bench/bench_scenes.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/tables.hpp"

namespace luxodus::bench {

namespace {

constexpr double gib = 1024.0 * 1024 * 1024;

/// Bytes of one bin of a block in a batch's scores (one per thread) and in the totals (one per
/// group).
void print_bin(const CompiledScene& scene, const char* what,
               std::initializer_list<uint32_t> blocks) {
  size_t scores = 0, totals = 0;
  for (const uint32_t b : blocks) {
    const TallyBlock& block = scene.layout.block(b);
    scores += sizeof(int64_t) * block.quantities * static_cast<size_t>(scene.layout.bands());
    totals += sizeof(Total) * block.quantities * static_cast<size_t>(scene.layout.channels());
  }
  fmt::print("{:<44} {:>10} + {} a thread\n", what, totals, scores);
}

}  // namespace

void print_memory(int n) {
  fmt::print("\nMemory [bytes]\n");
  const double start = wall_seconds();
  const auto scene = landscape(n);
  const double compiled = wall_seconds();
  LocalRun run(scene, 1, 1);
  const double built = wall_seconds();
  const auto triangles = static_cast<double>(scene->triangles);
  fmt::print("{:<44} {:>10} triangles, {} patch sides\n", "scene", scene->triangles,
             scene->patch_count);
  fmt::print("{:<44} {:>10.2f} s scene, {:.2f} s search structure\n", "made in", compiled - start,
             built - compiled);
  const auto records =
      static_cast<double>(scene->cells[0].triangles.capacity() * sizeof(TriangleRecord));
  fmt::print("{:<44} {:>10.1f}\n", "per triangle: records", records / triangles);
  fmt::print("{:<44} {:>10.1f}\n", "per triangle: Embree",
             static_cast<double>(run.device().bytes()) / triangles);
  print_bin(*scene, "per patch side, one band", {scene->blocks.patches});
  const auto smoky = furnished_room(Air::homogeneous, {true, true});
  print_bin(*smoky, "per voxel, one band", {smoky->blocks.voxels, smoky->blocks.voxel_power});
  const std::atomic<bool> never{false};
  StopRule stop;
  stop.particles = 2 * scene->batch_particles;
  run.run(stop, never, [](const Progress&) {});
  const auto resident = static_cast<double>(process_bytes("VmRSS"));
  const auto highest = static_cast<double>(process_bytes("VmHWM"));
  fmt::print("{:<44} {:>10.1f} MiB, {:.2f} of 1 GiB\n", "resident after two batches, one thread",
             resident / 1048576, resident / gib);
  fmt::print("{:<44} {:>10.1f} MiB, {:.2f} of 1 GiB\n", "highest on the way", highest / 1048576,
             highest / gib);
}

}  // namespace luxodus::bench
