// Maps bins between two states of one building, which may differ in signs and bodies of luminaires:
// surfaces are matched by their owner, then their patches one by one. Immutable; any thread.
#pragma once

#include <optional>
#include <vector>

#include "scenes/light/tally/totals.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

class BinMap {
 public:
  /// None if totals of the two cannot be compared: another origin, other units, bands or voxels.
  static std::optional<BinMap> between(const CompiledScene& before, const CompiledScene& now);

  /// Whether all bins have the same numbers in both.
  bool is_same() const { return same_; }
  /// Totals of before in the bins of now; zero in new ones.
  Totals::GroupState moved(const Totals::GroupState& before) const;
  /// The patch of before that corresponds to a patch of now, or none_index.
  uint32_t patch_before(uint32_t patch) const;

 private:
  /// [from, from + count) of before correspond to [to, to + count) of now.
  struct Run {
    int64_t from = 0, to = 0, count = 0;
  };
  bool same_ = true;
  int64_t size_ = 0;          // size of the totals of now
  std::vector<Run> patches_;  // bins of patches, by `to`
  std::vector<Run> totals_;   // ranges in totals
};

}  // namespace luxodus
