// From totals to physical values: watts, lumens, lux, cd/m2, each with its standard error over
// batches. Values of several source groups add; groups are independent samples, so their variances
// add too.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/light/tally/totals.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

struct Estimate {
  double value = 0;
  double standard_error = 0;  // NaN with fewer than two batches

  double relative_error() const;
  Estimate operator*(double k) const { return {value * k, standard_error * (k < 0 ? -k : k)}; }
};

/// Integer weights of the photopic channel, per group and band; see Totals.
std::vector<std::vector<int64_t>> photopic_weights(const CompiledScene& scene);

class Readout {
 public:
  Readout(const CompiledScene& scene, const Totals& totals) : scene_(scene), totals_(totals) {}

  /// Watts in a band; with a length score watts x metres. All groups, or one.
  Estimate watts(uint32_t block, uint32_t bin, int band, uint32_t quantity, int group = -1) const;
  /// Lumens (lumen metres). All groups, or one.
  Estimate lumens(uint32_t block, uint32_t bin, uint32_t quantity, int group = -1) const;
  /// A value score in its own unit.
  Estimate value(uint32_t block, uint32_t bin, uint32_t quantity) const;

  /// What a run is judged by and all its batches of a group tell of: fluxes, of which lumens()
  /// gives the estimate. Probes and signs are seen from the eye, whatever the group.
  struct TargetFlux {
    uint32_t block = 0, bin = 0, quantity = 0;
    double sure_lm = 0;  // direct light beside it, computed without chance
  };
  std::vector<TargetFlux> target_planes() const;
  /// Of one plane, a number in the description.
  std::vector<TargetFlux> target_cells(uint32_t plane) const;
  /// Those into which at least a hundredth of all light goes.
  std::vector<TargetFlux> target_surfaces() const;
  std::vector<TargetFlux> target_patches() const;

  /// The relative standard error that a run is judged by: the worst of what CompiledScene::judged
  /// names, of mean illuminances of planes, indirect illuminances of probes, luminances of signs at
  /// the eye, flux into surfaces; of cells of a plane, and of patches, that which 95 % of those
  /// that get light do not exceed. Infinite where nothing of it has any light yet.
  double worst_relative_error() const;
  /// What is judged but has no light, and so no part in that error: "sign NAME", "3 of 40 patches".
  std::vector<std::string> unlit() const;

 private:
  struct TargetValue {
    std::string name;  // "plane NAME"
    Estimate value;
  };
  /// Those that are judged each by itself.
  std::vector<TargetValue> target_values() const;
  /// Those of which the 95th percentile is judged.
  struct TargetPercentile {
    std::string name;  // "patches"
    std::vector<TargetFlux> fluxes;
  };
  std::vector<TargetPercentile> target_percentiles() const;
  Estimate flux(const TargetFlux& judged) const;
  std::optional<double> percentile_error(const std::vector<TargetFlux>& fluxes) const;
  Estimate sum_groups(uint32_t block, uint32_t bin, int channel, uint32_t quantity,
                      int group) const;
  double scale(int group, int channel, ScoreUnit unit) const;

  const CompiledScene& scene_;
  const Totals& totals_;
};

}  // namespace luxodus
