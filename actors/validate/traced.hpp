// A scene compiled and traced, and what was counted, read by the names of the scene's things. Same
// scene, seed and particles: same estimates, for any number of threads. Thread rule: one caller.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "actors/source/local_run.hpp"

namespace luxodus::light {

/// Bins of one block that are judged as one: equal by symmetry, or integrated over by the
/// reference. They are added batch by batch, like the tracer's own aggregates, so that the standard
/// error is that of the sum, however its parts are correlated.
struct BinSum {
  uint32_t TallyBlocks::*block;
  std::vector<uint32_t> bins;
};
/// All that leaves the scene.
BinSum every_side();

/// Requires: a scene without mistakes.
std::shared_ptr<const CompiledScene> compile(SceneDescription scene, int cells = 1);

class Traced {
 public:
  /// Traces nothing yet.
  Traced(std::shared_ptr<const CompiledScene> scene, uint64_t seed, int threads,
         const std::vector<BinSum>& sums = {});

  const CompiledScene& scene() const { return run_->scene(); }
  const TallyBlocks& blocks() const { return scene().blocks; }
  LocalRun& local() { return *run_; }
  const LocalRun& local() const { return *run_; }
  const Ledger& ledger() const { return run_->totals().ledger(); }
  double emitted_w() const;

  /// Requires: one band.
  Estimate watts(uint32_t block, uint32_t bin, uint32_t quantity = 0) const;
  /// A plain value (probes).
  Estimate value(uint32_t block, uint32_t bin, uint32_t quantity = 0) const;
  /// Flux into, and absorbed by, the object of that name.
  Estimate into(const std::string& surface) const;
  Estimate absorbed_by(const std::string& surface) const;
  /// Flux into one patch of the object: of each triangle first those in front, then those behind.
  Estimate into_patch(const std::string& surface, uint32_t patch) const;
  Estimate into_group(uint32_t surface_group) const;
  /// Escaped through sides of the bounding box: x-, x+, y-, y+, z-, z+.
  Estimate escaped(uint32_t side) const;
  Estimate track_length(uint32_t volume_group) const;
  Estimate absorbed_in(uint32_t volume_group) const;
  Estimate absorbed_by_medium(uint32_t medium) const;
  /// The BinSum of that number, in the unit of its bins.
  Estimate sum(uint32_t number, uint32_t quantity = 0) const;

  /// Direct light at a point, computed without chance [lx]. Scene coordinates.
  double direct_lx(const glm::dvec3& point, const glm::dvec3& normal) const;

 private:
  uint32_t surface_index(const std::string& name) const;
  std::vector<uint32_t> sum_blocks_;
  std::unique_ptr<LocalRun> run_;
};

}  // namespace luxodus::light
