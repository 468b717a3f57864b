// Converts totals to physical values: watts, lumens, lux, cd/m2, each with its standard error over
// batches. Values of several source groups add; groups are independent samples, so their variances
// add, too. Reads its totals; not while they are changed by other threads.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"
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

  /// Watts in a band; for a length score watts x metres. All groups, or one.
  Estimate watts(uint32_t block, uint32_t bin, int band, uint32_t quantity, int group = -1) const;
  /// Lumens (lumen metres). All groups, or one.
  Estimate lumens(uint32_t block, uint32_t bin, uint32_t quantity, int group = -1) const;
  /// A value score in its own unit; infinite if a batch's was out of range.
  Estimate value(uint32_t block, uint32_t bin, uint32_t quantity) const;

  /// A flux whose error is a target, and that all batches of a group contribute to; lumens()
  /// estimates it. Probes and signs are estimated from the eye, independently of the group.
  struct TargetFlux {
    uint32_t block = 0, bin = 0, quantity = 0;
    double sure_lm = 0;  // deterministic direct light in addition
  };
  std::vector<TargetFlux> target_planes() const;
  /// The cells of one plane, given by its index in the description.
  std::vector<TargetFlux> target_cells(uint32_t plane) const;
  /// The surfaces that receive at least a hundredth of all light.
  std::vector<TargetFlux> target_surfaces() const;
  std::vector<TargetFlux> target_patches() const;

  /// The relative standard error that a run is judged by: the largest among
  /// CompiledScene::error_target, i.e. mean illuminances of planes, indirect illuminances of
  /// probes, luminances of signs at the eye, flux into surfaces; for cells of a plane and for
  /// patches, the 95th percentile of those that receive light. Infinite if no target has any light
  /// yet.
  double worst_relative_error() const;
  /// Targets without light, which that error excludes: "sign NAME", "3 of 40 patches".
  std::vector<std::string> unlit() const;
  /// Errors: a value of a probe, or of a sign from an observer, that is out of range.
  Result<void> check_range() const;

 private:
  /// Whether a value of this bin is out of range.
  bool is_beyond(uint32_t block, uint32_t bin) const;
  struct TargetValue {
    std::string name;  // "plane NAME"
    Estimate value;
  };
  /// Targets that are judged individually.
  std::vector<TargetValue> target_values() const;
  /// Targets that are judged by their 95th percentile.
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
