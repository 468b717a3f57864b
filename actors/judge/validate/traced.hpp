// A scene compiled and traced, whose results are read by the names in the scene. Same scene, seed
// and particles: same estimates, for any number of threads. Thread rule: one caller.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "actors/results/run/local_run.hpp"

namespace luxodus::light {

/// Bins of one block that are judged as one: equal by symmetry, or integrated over by the
/// reference. They are added batch by batch, like the tracer's own aggregates, so that the standard
/// error is that of the sum, whatever their correlation.
struct BinSum {
  uint32_t TallyBlocks::*block;
  std::vector<uint32_t> bins;
};
/// All light that leaves the scene.
BinSum every_side();

/// Scores of one block with weights of any sign, added in every batch after it was traced, so that
/// the standard error is that of the sum: an integral over bins, or an extrapolation from them.
struct WeightedSum {
  struct Term {
    uint32_t bin = 0;
    uint32_t quantity = 0;
    double weight = 0;
  };
  uint32_t TallyBlocks::*block = nullptr;
  std::vector<Term> terms;
};

/// Direct light at a point, computed deterministically: direct_light_at, except in tests.
using DirectLightAt =
    std::function<DirectLight(const CompiledScene&, const GeometryAccess&, const Vec3& point,
                              const Vec3& normal, const DirectOptions&)>;

/// Requires: a scene without mistakes.
std::shared_ptr<const CompiledScene> compile(SceneDescription scene, int cells = 1);

class Traced {
 public:
  /// Does not trace yet.
  Traced(std::shared_ptr<const CompiledScene> scene, uint64_t seed, int threads,
         const std::vector<BinSum>& sums = {}, const std::vector<WeightedSum>& weighted = {});
  Traced(const Traced&) = delete;
  Traced& operator=(const Traced&) = delete;
  /// Replaces the program's loop that traces batches.
  void trace_with(const LocalRun::MakeTracer& make);

  const CompiledScene& scene() const { return run_->scene(); }
  const TallyBlocks& blocks() const { return scene().blocks; }
  LocalRun& local() { return *run_; }
  const LocalRun& local() const { return *run_; }
  const EnergyBalance& balance() const { return run_->totals().balance(); }
  double emitted_w() const;

  /// Requires: one band.
  Estimate watts(uint32_t block, uint32_t bin, uint32_t quantity = 0) const;
  /// A dimensional value (probes).
  Estimate value(uint32_t block, uint32_t bin, uint32_t quantity = 0) const;
  /// Flux into, and absorbed by, the object with this name.
  Estimate into(const std::string& surface) const;
  Estimate absorbed_by(const std::string& surface) const;
  /// Flux into one patch of the object: for each triangle first those in front, then those behind.
  Estimate into_patch(const std::string& surface, uint32_t patch) const;
  Estimate into_group(uint32_t surface_group) const;
  /// Light that escaped through sides of the bounding box: x-, x+, y-, y+, z-, z+.
  Estimate escaped(uint32_t side) const;
  Estimate track_length(uint32_t volume_group) const;
  Estimate absorbed_in(uint32_t volume_group) const;
  Estimate absorbed_by_medium(uint32_t medium) const;
  /// The BinSum with this number, in the unit of its bins.
  Estimate sum(uint32_t number, uint32_t quantity = 0) const;
  /// The WeightedSum with this number, in the unit of its bins times that of its weights.
  Estimate weighted_sum(uint32_t number) const;

  /// Direct light at a point, computed deterministically [lx]. Scene coordinates.
  double direct_lx(const glm::dvec3& point, const glm::dvec3& normal,
                   const DirectLightAt& direct_light = direct_light_at) const;

 private:
  uint32_t surface_index(const std::string& name) const;
  std::vector<uint32_t> sum_blocks_;
  std::vector<WeightedSum> weighted_;  // weights at most 1
  std::vector<double> scales_;         // divisors of the weights
  std::vector<uint32_t> weighted_blocks_;
  std::unique_ptr<LocalRun> run_;
};

/// A scene ready for computing direct light.
std::shared_ptr<const Traced> lit(SceneDescription scene);

}  // namespace luxodus::light
