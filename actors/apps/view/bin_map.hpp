// Bins of two states of one building, which may have other signs and bodies of luminaires: surfaces
// are found by what they are of, their patches one by one. Pure; any thread.
#pragma once

#include <optional>
#include <vector>

#include "scenes/light/tally/totals.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

class BinMap {
 public:
  /// None where totals of the two cannot be compared: another origin, other units, bands or voxels.
  static std::optional<BinMap> between(const CompiledScene& before, const CompiledScene& now);

  /// Whether each bin of the one is the same bin of the other.
  bool is_same() const { return same_; }
  /// Totals of before in the bins of now; zero in those that are new.
  Totals::GroupState moved(const Totals::GroupState& before) const;
  /// The patch of before that a patch of now was, or none_index.
  uint32_t patch_before(uint32_t patch) const;

 private:
  /// [from, from + count) of before are [to, to + count) of now.
  struct Run {
    int64_t from = 0, to = 0, count = 0;
  };
  bool same_ = true;
  int64_t size_ = 0;          // totals of now
  std::vector<Run> patches_;  // bins of patches, by `to`
  std::vector<Run> totals_;   // places in totals
};

}  // namespace luxodus
